// Five hundred dragged frames, by mouse, keys and touch, of five cages and three rigs: every one is certified and folds
// nothing. Needs STUDIO (the page) and CHROMIUM; STUDIO_LONG=1, as it takes minutes.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { AFTER, LOOKS, TOUCH, again, drag, focus, open, settle, show } from './browser.js';

const { STUDIO, CHROMIUM, STUDIO_LONG } = process.env;
const FRAMES = 500, STEPS = 12;
const CAGES = ['butterfly', 'owl', 'squares', 'harbour', 'letter'], RIGS = ['star', 'figure', 'butterfly'];
const skip = !STUDIO_LONG;
let browser, page, wrong;
const count = { frames: 0, uncertified: 0, folded: 0, refused: 0, times: [], by: {} };

before(async () => { if (!skip) ({ browser, page, wrong } = await open(STUDIO, CHROMIUM)); });
after(async () => browser?.close());

/** Drags one handle, `far` pixels of the screen in a direction of its own. */
async function pull(selector, round, far, pointer) {
  const by = [Math.cos(2.4 * round), Math.sin(2.4 * round)];
  if (pointer !== 'keys') { await drag(page, selector, by.map((v) => far * v), STEPS, pointer); return; }
  await focus(page, selector);
  for (let k = 0; k < STEPS; ++k) {
    const axis = k % 2;
    await page.keyboard.press(['Arrow', axis === 0 ? ['Left', 'Right'][Number(by[0] > 0)] : ['Up', 'Down'][Number(by[1] > 0)]].join(''));
    await settle(page);
  }
}

function add(pointer, { frames, uncertified, folded, refused, times }) {
  count.frames += frames;
  count.by[pointer] = (count.by[pointer] ?? 0) + frames;
  count.uncertified += uncertified;
  count.folded += folded;
  count.refused += refused;
  count.times.push(...times);
}

async function cage(name, round, pointer, far) {
  await page.select('#sample', name);
  await settle(page);
  await page.evaluate(() => Object.assign(studio.cage.stats, { frames: 0, uncertified: 0, folded: 0, times: [], refused: 0 }));
  const n = await page.evaluate(() => studio.cage.shapes.target[0].points.length);
  for (let k = 0; k < 2; ++k)
    await pull(`${AFTER}[data-type=vertex][data-part="0"][data-vertex="${(5 * round + 2 + 3 * k) % n}"]`, round + k, far, pointer);
  add(pointer, await page.evaluate(() => ({ ...studio.cage.stats })));
}

/** The rigs are certified as they are dragged; frames are counted where the map has come. */
async function rig(name, round, pointer, far) {
  await page.select('#rig', name);
  await settle(page);
  if (!await page.$eval('#keep', (e) => e.checked)) { await page.$eval('#keep', (e) => e.click()); await settle(page); }
  const begin = await page.evaluate(() => {
    const { modes: { handles: { stats, certificate } } } = studio;
    Object.assign(certificate.stats, { certified: 0, broken: 0 });
    return (stats.times = []).length;
  });
  assert.equal(begin, 0);
  for (let k = 0; k < 2; ++k) await pull(`${AFTER}[aria-label="handle ${2 + ((3 * round + 4 * k) % 9)}"]`, round + k, far, pointer);
  add(pointer, await page.evaluate(() => {
    const { modes: { handles: { stats: { times }, certificate: { stats } } } } = studio;
    return { frames: stats.certified, uncertified: times.length - stats.certified, folded: stats.broken, refused: 0, times };
  }));
}

test('five hundred frames by mouse, keys and touch', { skip }, async () => {
  for (let round = 0; count.frames < FRAMES; ++round)
    for (const [pointer, viewport, far] of [['mouse', LOOKS.light, 60], ['keys', LOOKS.light, 0], ['touch', TOUCH, 24]]) {
      await again(page, viewport);
      for (const name of CAGES) await cage(name, round, pointer, far);
      await show(page, 'handles');
      for (const name of RIGS) await rig(name, round, pointer, far / 2);
    }
  const { frames, uncertified, folded, refused, times, by } = count;
  times.sort((a, b) => a - b);
  console.log(`# ${frames} frames (${Object.entries(by).map(([key, n]) => `${n} by ${key}`).join(', ')}), ${refused} targets refused; `
    + `in the worker median ${times[times.length >> 1].toFixed(1)} ms, 95 % below ${times[Math.floor(0.95 * times.length)].toFixed(1)} ms (wall)`);
  assert.deepEqual([uncertified, folded, wrong], [0, 0, []]);
});
