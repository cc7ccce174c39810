// The links that docs/live.js puts into the pages: the studio opens each with the shapes of its page, certified. Needs
// STUDIO, LIVE (docs/live.js), CHROMIUM and SHOTS.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { drag, open, settle } from './browser.js';

const { STUDIO, LIVE, CHROMIUM, SHOTS } = process.env;
const KINDS = {
  fish: ['outline'], eye: ['outline', 'line', 'line', 'line'], character: ['outline', ...Array(5).fill('line')],
  county: ['outline', 'hole', 'hole', 'line', ...Array(7).fill('point')], parish: ['outline', ...Array(4).fill('point')],
  island: ['outline'], square: ['outline'], tripus: ['outline'], star: ['outline'], pins: ['outline'],
};
const MODES = { tripus: 'stages', star: 'handles', pins: 'handles' };
let browser, page, wrong, links;

before(async () => {
  const folder = fs.mkdtempSync(path.join(SHOTS, 'links-'));
  for (const name of Object.keys(KINDS)) fs.writeFileSync(`${folder}/${name}.html`, `<iframe src="studio.html#${name}"></iframe>`);
  execFileSync('node', [LIVE, folder]);
  links = Object.fromEntries(Object.keys(KINDS).map((name) =>
    [name, /studio\.html(#[^"]*)/.exec(fs.readFileSync(`${folder}/${name}.html`, 'utf8'))[1]]));
  fs.rmSync(folder, { recursive: true });
  ({ browser, page, wrong } = await open(STUDIO, CHROMIUM));
});
after(async () => browser?.close());

for (const [name, kinds] of Object.entries(KINDS))
  test(`${name}: as in its page`, async (t) => {
    if (links[name] === '#cage') { t.skip('left out: NumPy is missing'); return; }
    await page.goto('about:blank');
    await page.goto(`file://${path.resolve(STUDIO)}${links[name]}`);
    await page.waitForFunction('globalThis.studio?.cage.stats.frames > 0', { timeout: 120000 });
    await settle(page);
    const mode = MODES[name];
    if (mode) await page.waitForFunction(`studio.modes.${mode}?.stats.frames > 0`, { timeout: 120000 });
    await settle(page);
    const seen = await page.evaluate(() => ({ shapes: studio.cage.shapes, frames: studio.cage.stats.frames,
      uncertified: studio.cage.stats.uncertified, width: studio.cage.image.width,
      handles: studio.modes.handles?.state.handles.length }));
    assert.deepEqual(seen.shapes.source.map((part) => part.kind), kinds);
    assert.deepEqual(seen.shapes.target.map((part) => part.points.length), seen.shapes.source.map((part) => part.points.length));
    assert.equal(seen.uncertified, 0);
    assert.equal(seen.width, { fish: 480, eye: 324, pins: 480 }[name] ?? 640);
    await page.screenshot({ path: `${SHOTS}/site-${name}.png` });
    if (mode === 'handles') assert.equal(seen.handles, seen.shapes.source[0].points.length);
    if (mode) return;
    await drag(page, 'figure.first [data-type=vertex][data-part="0"][data-vertex="1"]', [6, 4], 2);
    const dragged = await page.evaluate(() => ({ ...studio.cage.stats }));
    assert.ok(dragged.frames > seen.frames);
    assert.equal(dragged.uncertified + dragged.folded, 0);
  });

test('no page error, no request', () => assert.deepEqual(wrong, []));
