// The studio in Chromium, by mouse, touch and keys. Needs STUDIO (the page), CHROMIUM, and SHOTS (a folder for
// screenshots).
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { AFTER, LOOKS, TOUCH, again, centre, drag, focus, open, settle, shoot, show } from './browser.js';

const { STUDIO, CHROMIUM, SHOTS } = process.env;
const corner = (i) => `${AFTER}[data-type=vertex][data-part="0"][data-vertex="${i}"]`;
let browser, page, wrong;

before(async () => { ({ browser, page, wrong } = await open(STUDIO, CHROMIUM)); });
after(async () => browser?.close());

const cage = () => page.evaluate(() => ({ ...studio.cage.stats, times: [...studio.cage.stats.times], canUndo: studio.cage.canUndo,
  shapes: studio.cage.shapes, certificate: document.getElementById('certificate')?.textContent }));
const shot = (name) => shoot(page, SHOTS, name);

/** A fresh page of the sample. */
async function sample(name) {
  await page.select('#sample', name);
  await settle(page);
  await page.evaluate(() => Object.assign(studio.cage.stats, { frames: 0, uncertified: 0, folded: 0, other: 0, times: [], refused: 0 }));
}

test('one file of at most 1,142,000 bytes', () => assert.ok(fs.statSync(STUDIO).size <= 1_142_000));

test('it opens in the middle of a drag: certified beside a fold, and says what it waits for', async () => {
  const waits = () => page.$eval(`${AFTER}.waits`, (e) => e.textContent);
  const state = await cage();
  assert.ok(state.other > 0);
  assert.equal(state.folded, 0);
  assert.match(state.certificate, /Certified one-to-one/);
  assert.equal(await waits(), 'Drag a white dot');
  await shot('first');
  await drag(page, corner(4), [20, 0], 3);
  assert.equal(await waits(), '');
});

test('a corner is dragged by mouse: certified in every frame, nothing folds, mean value coordinates do', async () => {
  await sample('butterfly');
  await drag(page, corner(4), [-90, 90], 12);
  await drag(page, corner(5), [-170, -40], 12);
  const state = await cage();
  assert.ok(state.frames >= 24, `${state.frames} frames`);
  assert.equal(state.uncertified, 0);
  assert.equal(state.folded, 0);
  assert.ok(state.other > 0);
  assert.match(state.certificate, /Certified one-to-one/);
});

test('undo and redo restore the cage to the bit', async () => {
  const now = (await cage()).shapes;
  await page.click('#undo');
  await settle(page);
  const undone = (await cage()).shapes;
  assert.notDeepEqual(undone.target, now.target);
  await page.keyboard.down('Control');
  await page.keyboard.press('y');
  await page.keyboard.up('Control');
  await settle(page);
  assert.deepEqual((await cage()).shapes.target, now.target);
});

test('a cage that crosses itself is refused: the edges are named, the last good picture stays', async () => {
  await sample('squares');
  await drag(page, corner(2), [0, 460], 6);
  const state = await cage();
  assert.match(state.certificate, /Edges \d+ and \d+ (cross|touch)/);
  assert.match(state.certificate, /last good picture stays/);
  assert.ok(state.refused > 0);
  assert.equal(state.uncertified, 0);
  const crossing = await page.$eval(`${AFTER}.crossing`, (path) => path.getAttribute('d'));
  assert.match(crossing, /^M/);
  const numbers = await page.$$eval(`${AFTER}.number`, (all) => all.map((e) => e.textContent));
  const [, one, other] = /Edges (\d+) and (\d+)/.exec(state.certificate);
  assert.ok(numbers.includes(one) && numbers.includes(other), `${numbers}`);
  await shot('refused');
  await page.click('#reset');
  await settle(page);
  assert.match((await cage()).certificate, /Certified/);
});

test('keys move, add and remove corners', async () => {
  await sample('letter');
  const n = (await cage()).shapes.target[0].points.length;
  await focus(page, corner(3));
  for (let k = 0; k < 4; ++k) await page.keyboard.press('ArrowDown');
  await settle(page);
  const moved = (await cage()).shapes;
  assert.ok(moved.target[0].points[3][1] > moved.source[0].points[3][1]);
  await page.keyboard.press('+');
  await settle(page);
  assert.equal((await cage()).shapes.target[0].points.length, n + 1);
  await page.keyboard.press('Delete');
  await settle(page);
  assert.equal((await cage()).shapes.target[0].points.length, n);
  assert.equal((await cage()).folded, 0);
});

test('a hole, a line and a pin inside; the pin is dragged', async () => {
  await sample('owl');
  const [x, y] = await centre(page, `${AFTER}.overlay`);
  const clicks = async (tool, ...places) => {
    await page.click(`[data-tool=${tool}]`);
    for (const [u, v] of places) { await page.mouse.click(x + u, y + v); await settle(page); }
    await settle(page);
  };
  await clicks('hole', [-40, 70], [40, 70], [0, 130], [-40, 70]);
  await clicks('line', [-70, 20], [70, 20], [70, 20]);
  await clicks('point', [0, -40]);
  const { shapes } = await cage();
  assert.deepEqual(shapes.source.map((part) => part.kind), ['outline', 'hole', 'line', 'point']);
  await drag(page, `${AFTER}[data-type=vertex][data-part="3"]`, [30, -20], 8);
  const state = await cage();
  assert.equal(state.uncertified, 0);
  assert.equal(state.folded, 0);
  assert.match(state.certificate, /Certified/);
  await shot('features');
});

test('the place under the pointer is shown in both pictures', async () => {
  await sample('butterfly');
  const [x, y] = await centre(page, `${AFTER}.overlay`);
  await page.mouse.move(x + 60, y - 30);
  await settle(page);
  const note = await page.$eval('.cage .panel:not(.first) .note', (e) => e.textContent);
  assert.match(note, /^comes from [\d.]+, [\d.]+$/);
});

test('the view: squares, distortion, triangles, every comparison', async () => {
  await drag(page, corner(4), [-80, 60], 4);
  for (const compare of ['thin-plate', 'gradient', 'none', 'mean-value']) {
    await page.select('#compare', compare);
    await settle(page);
  }
  await page.click('.cage .toggle input');
  await page.click('input[name=look][value=heat]');
  await shot('distortion');
  await page.click('input[name=look][value=squares]');
  await shot('squares');
  await page.click('input[name=look][value=picture]');
  await page.click('.cage .toggle input');
  await shot('cage');
});

test('cages as text, GeoJSON and SVG; a link brings them back', async () => {
  const load = (text) => page.evaluate((t) => studio.cage.take(new File([t], 'cage.txt')), text).then(() => settle(page));
  const outline = async () => (await cage()).shapes.source[0].points;
  await load('100 100\n500 100\n500 500\n100 500\n');
  assert.deepEqual(await outline(), [[100, 100], [500, 100], [500, 500], [100, 500]]);
  await load('{"type":"Polygon","coordinates":[[[80,90],[500,100],[400,500],[80,90]]]}');
  assert.deepEqual(await outline(), [[80, 90], [500, 100], [400, 500]]);
  await load('<svg xmlns="http://www.w3.org/2000/svg"><path d="M100 100h400v300l-50 80H100z"/></svg>');
  assert.deepEqual(await outline(), [[100, 100], [500, 100], [500, 400], [450, 480], [100, 480]]);
  await page.click('#link');
  await page.waitForFunction('location.hash.length > 3');
  await again(page, LOOKS.light);
  assert.deepEqual(await outline(), [[100, 100], [500, 100], [500, 400], [450, 480], [100, 480]]);
  await page.evaluate(() => { location.hash = ''; });
});

/** A picture as its bytes: two colours. */
const painted = () => page.evaluate(async () => {
  const sheet = new OffscreenCanvas(300, 200), g = sheet.getContext('2d');
  g.fillStyle = 'teal';
  g.fillRect(0, 0, 300, 200);
  g.fillStyle = 'gold';
  g.fillRect(60, 40, 180, 120);
  return [...new Uint8Array(await (await sheet.convertToBlob()).arrayBuffer())];
});
const sizeOf = (bytes) => [bytes.readUInt32BE(16), bytes.readUInt32BE(20)]; // of a PNG

test('pictures and cages are opened, dropped and pasted; the picture is saved', async () => {
  const file = `${SHOTS}/opened.png`, saved = `${SHOTS}/saved`, bytes = await painted();
  fs.writeFileSync(file, Uint8Array.from(bytes));
  const open = async (label, what) => {
    const [chooser] = await Promise.all([page.waitForFileChooser(), page.evaluate((text) =>
      [...document.querySelectorAll('.cage button')].find((b) => b.textContent === text).click(), label)]);
    await chooser.accept([what]);
  };
  const image = () => page.evaluate(() => [studio.cage.image.width, studio.cage.image.height]);
  const give = (type, member, data) => page.evaluate((t, m, { text, png }) => {
    const transfer = new DataTransfer();
    if (text) transfer.setData('text', text);
    else transfer.items.add(new File([Uint8Array.from(png)], 'given.png', { type: 'image/png' }));
    document.dispatchEvent(new (t === 'paste' ? ClipboardEvent : DragEvent)(t, { [m]: transfer, bubbles: true, cancelable: true }));
  }, type, member, data);
  const comes = (width) => page.waitForFunction(`studio.cage.image.width === ${width}`);

  await sample('owl');
  await open('Open …', file);
  await comes(300);
  await settle(page);
  assert.deepEqual(await image(), [300, 200]);
  await drag(page, corner(0), [12, 12], 3);

  fs.rmSync(saved, { recursive: true, force: true });
  const session = await browser.target().createCDPSession();
  await session.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: saved });
  await page.click('#save');
  const warped = `${saved}/warped.png`;
  for (let k = 0; k < 100 && !fs.existsSync(warped); ++k) await new Promise((done) => { setTimeout(done, 50); });
  assert.deepEqual(sizeOf(fs.readFileSync(warped)), [300, 200]);

  for (const [type, member] of [['drop', 'dataTransfer'], ['paste', 'clipboardData']]) {
    await sample('owl');
    await give(type, member, { png: bytes });
    await comes(300);
    await give(type, member, { text: '20 20\n280 20\n280 180\n20 180\n' });
    await page.waitForFunction('studio.cage.shapes.source[0].points.length === 4');
    await settle(page);
    assert.match((await cage()).certificate, /Certified/, type);
  }
  fs.writeFileSync(`${SHOTS}/cage.txt`, '30 20\n280 20\n150 180\n');
  await open('Load …', `${SHOTS}/cage.txt`);
  await page.waitForFunction('studio.cage.shapes.source[0].points.length === 3');
  await give('drop', 'dataTransfer', { text: 'no cage' });
  await page.waitForFunction('document.getElementById("toast").textContent.includes("could not be read")');
});

test('without WebGL2 a 2-D canvas shows the same', async () => {
  const shown = () => page.evaluate(() => {
    const from = document.querySelector('figure.first canvas'), sheet = new OffscreenCanvas(64, 64), g = sheet.getContext('2d');
    g.drawImage(from, 0, 0, 64, 64);
    return [...g.getImageData(0, 0, 64, 64).data];
  });
  const moved = async () => {
    await sample('butterfly');
    await drag(page, corner(4), [-90, 90], 6);
    return shown();
  };
  const usual = await moved();
  const { identifier } = await page.evaluateOnNewDocument(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function other(kind, ...rest) {
      return kind === 'webgl2' ? null : getContext.call(this, kind, ...rest);
    };
  });
  await again(page, LOOKS.light);
  const plain = await moved();
  const apart = usual.reduce((sum, v, i) => sum + Math.abs(v - plain[i]), 0) / usual.length;
  assert.ok(apart < 4 && usual.some((v) => v > 0), `${apart} of 255 on the average`);
  for (const look of ['heat', 'squares', 'picture']) {
    await page.click(`input[name=look][value=${look}]`);
    await settle(page);
    if (look !== 'picture') assert.notDeepEqual(await shown(), plain);
  }
  assert.equal((await cage()).uncertified, 0);
  await shot('canvas');
  await page.click('[data-mode=space]');
  await page.waitForFunction('document.getElementById("toast").textContent.includes("WebGL2")');
  await show(page, 'handles');
  await page.removeScriptToEvaluateOnNewDocument(identifier);
  await again(page, LOOKS.light);
});

test('stages: every step, and a walk', async () => {
  await show(page, 'stages');
  for (const step of ['grid', 'fire', 'tree', 'function', 'levels', 'curves', 'walk']) {
    await page.click(`input[name=step][value=${step}]`);
    await settle(page);
    if (step !== 'curves') continue;
    const [all, up] = await page.$$eval('.stages dd', (facts) => facts.map((fact) => Number(fact.textContent)));
    assert.ok(all > 50 && up === all, `${up} of ${all} curves end at the maximum`);
    await shot('curves');
  }
  const [x, y] = await centre(page, '.stages .first .overlay');
  await page.mouse.move(x + 40, y + 10);
  await settle(page);
  assert.match(await page.$eval('.stages .first .note', (e) => e.textContent), /^edge \d+, .* t = 0\.\d+$/);
  await shot('stages');
});

test('stages: an outline that crosses itself has none, and what is shown is it and why', async () => {
  const told = () => page.$eval('.stages .lesson', (e) => e.textContent);
  const outline = () => page.$eval('.stages .first .overlay .part.outline', (path) => path.getAttribute('d'));
  await show(page, 'cage');
  await sample('squares');
  await drag(page, corner(2), [0, 460], 6);
  await show(page, 'stages');
  assert.match(await told(), /^There are no stages: .*(cross|touch)/);
  assert.match(await outline(), /^M/);
  await shot('no-stages');
  await show(page, 'cage');
  await page.click('#reset');
  await settle(page);
  await show(page, 'stages');
  assert.doesNotMatch(await told(), /no stages/);
});

test('space: the bar is bent and cut, certified', async () => {
  await show(page, 'space');
  const set = (index, value) => page.evaluate((i, v) => {
    const input = document.querySelectorAll('.space .slider input')[i];
    input.value = v;
    for (const type of ['input', 'change']) input.dispatchEvent(new Event(type));
  }, index, value).then(() => settle(page));
  for (const bend of [2, 2.6, 3.2]) await set(0, bend);
  await set(1, 1);
  await set(3, 0.2);
  const stats = await page.evaluate(() => studio.modes.space.stats);
  assert.ok(stats.frames >= 4);
  assert.equal(stats.uncertified, 0);
  assert.equal(stats.turned, 0);
  await shot('space');
});

test('every control has a name and is 24 pixels across at least', async () => {
  for (const mode of ['cage', 'pins', 'points', 'handles', 'stages', 'space']) {
    await page.click(`[data-mode=${mode}]`);
    await settle(page);
    const bad = await page.evaluate(() => [...document.querySelectorAll('button, select, input, [role=button], canvas[tabindex]')]
      .filter((e) => e.checkVisibility() && getComputedStyle(e).display !== 'none').map((e) => {
        const box = (e.closest('label') ?? e.querySelector('.reach') ?? e).getBoundingClientRect();
        const name = e.getAttribute('aria-label') || e.closest('label')?.textContent || e.textContent;
        return [e.outerHTML.slice(0, 80), name.trim(), Math.round(Math.min(box.width, box.height))];
      }).filter(([, name, size]) => name === '' || size < 24));
    assert.deepEqual(bad, []);
  }
});

test('by touch', async () => {
  await again(page, TOUCH);
  await sample('harbour');
  await drag(page, corner(1), [10, 60], 10, 'touch');
  const state = await cage();
  assert.ok(state.frames >= 10);
  assert.equal(state.uncertified + state.folded, 0);
  await again(page, LOOKS.light);
});

test('no page error, no request', () => assert.deepEqual(wrong, []));
