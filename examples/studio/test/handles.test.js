// Mode handles by hand: the thesis' star, stick figure and butterfly, posed and painted through the interface alone, each
// pose beside that of the native library. Needs STUDIO (the page), CHROMIUM, SHOTS (a folder for screenshots), and POSES
// (tests/poses of a native build).
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { AFTER, centre, drag, focus, open, settle, shoot, show } from './browser.js';
import { compare, record } from './tape.js';

const { STUDIO, CHROMIUM, SHOTS, POSES } = process.env;
const WEIGHTS = '.handles .panel:not(.first) ';
const handle = (i, side = AFTER) => `${side}[aria-label="handle ${i}"]`;
let browser, page, wrong, frames = 0;

before(async () => {
  ({ browser, page, wrong } = await open(STUDIO, CHROMIUM));
  await record(page);
  await show(page, 'handles');
});
after(async () => browser?.close());

const state = () => page.evaluate(() => studio.modes.handles.state);
const tool = (name) => page.click(`[data-tool=${name}]`);
const press = async (...keys) => { for (const key of keys) { await page.keyboard.press(key); await settle(page); } };
const certificate = () => page.$eval('.handles .certificate', (e) => e.textContent);

/** A place of the plane on the screen, in a panel. */
const placeIn = (side, at) => page.evaluate((selector, [x, y]) => {
  const svg = document.querySelector(`${selector}.overlay`), m = svg.getScreenCTM();
  return [m.a * x + m.e, m.d * y + m.f];
}, side, at);

/** Clicks places of the plane, in a panel. */
async function clicks(side, ...places) {
  for (const at of places) { await page.mouse.click(...await placeIn(side, at)); await settle(page); }
}

/** Paints from place to place in the weights. */
async function stroke(...places) {
  const [first, ...others] = await Promise.all(places.map((at) => placeIn(WEIGHTS, at)));
  await page.mouse.move(...first);
  await page.mouse.down();
  for (const at of others) await page.mouse.move(...at, { steps: 5 });
  await page.mouse.up();
  await settle(page);
}

async function rig(name) {
  await page.select('#rig', name);
  await settle(page);
}

/** A session, and what the native library gives for all poses since the last one. */
function session(name, work) {
  test(name, async (t) => {
    await work();
    if (!POSES) { t.diagnostic('not compared: there is no native build'); return; }
    const seen = await compare(page, POSES);
    assert.deepEqual([seen.errors, seen.different], [[], 0]);
    assert.ok(seen.frames >= 20, `${seen.frames} poses`);
    frames += seen.frames;
  });
}

session('the star: a grid of samples, every method, painted, turned', async () => {
  await rig('star');
  await focus(page, '#grid');
  await press('Space');
  assert.equal((await state()).grid, true);
  await drag(page, handle(4), [40, 28], 6);
  await drag(page, handle(3), [50, 0], 5, 'right');
  for (const method of ['qp', 'equality', 'l1']) {
    await page.click(`input[name=method][value=${method}]`);
    await settle(page);
    assert.equal((await state()).method, method);
    await drag(page, handle(1), [-12, -6], 3);
  }
  await clicks(WEIGHTS, (await state()).handles[4]);
  await tool('paint');
  await stroke([330, 300], [360, 330], [340, 380]);
  await shoot(page, SHOTS, 'star-painted');
  assert.equal((await state()).paintings.length, 1);
  await tool('move');
  await focus(page, handle(5));
  await press('ArrowRight', 'ArrowRight', 'ArrowDown', '.', '.', '.');
  for (let k = 0; k < 6; ++k) { await page.click('#undo'); await settle(page); }
  assert.equal((await state()).paintings.length, 1);
  for (const id of ['undo', 'redo', 'redo']) { await page.click(`#${id}`); await settle(page); }
  await drag(page, handle(7), [0, 40], 4);
  await shoot(page, SHOTS, 'star');
});

session('the star: straight lines and a parallel one, on a grid and on blue noise', async () => {
  await rig('star');
  await tool('line');
  await clicks(WEIGHTS, [250, 300], [390, 330], [390, 330]);
  await tool('parallel');
  await clicks(WEIGHTS, [260, 370], [385, 400], [385, 400]);
  assert.deepEqual((await state()).lines.map((line) => line.parallel), [0, 1]);
  await drag(page, handle(4), [60, 40], 6);
  await page.click('#grid');
  await settle(page);
  assert.equal((await state()).lines.length, 2);
  await drag(page, handle(8), [-60, 30], 6);
  await drag(page, handle(1), [0, -30], 6);
  await shoot(page, SHOTS, 'star-lines');
});

session('the stick figure: bones moved and turned, a rigid head, a rigid brush', async () => {
  await rig('figure');
  await tool('region');
  await clicks(WEIGHTS, [276, 80], [364, 80], [372, 180], [268, 180], [276, 80]);
  assert.equal((await state()).regions.length, 1);
  await drag(page, handle(5), [-20, -90], 6);
  await drag(page, `${AFTER}[aria-label="bone 10"]`, [40, 0], 6, 'right');
  await drag(page, handle(1), [30, 0], 5, 'right');
  await tool('rigid');
  await stroke([300, 300], [340, 340]);
  await tool('move');
  await drag(page, handle(7), [10, 60], 6);
  await page.click('input[name=scale][value=log]');
  await shoot(page, SHOTS, 'figure');
  await page.click('input[name=scale][value=linear]');
});

session('the butterfly: its cage, painted by keys, finer samples', async () => {
  await rig('butterfly');
  await drag(page, handle(4), [-30, 40], 6);
  await drag(page, handle(5), [-30, 20], 6);
  await clicks(WEIGHTS, (await state()).handles[7]);
  await tool('paint');
  await focus(page, `${WEIGHTS}.overlay`);
  await press('ArrowRight', 'ArrowRight', 'ArrowDown', 'Enter');
  assert.equal((await state()).paintings.length, 1);
  await tool('move');
  await focus(page, '.handles [aria-label="Spacing of samples"]');
  await press('ArrowLeft', 'ArrowLeft');
  assert.deepEqual([(await state()).spacing, (await state()).paintings.length], [10, 1]);
  await drag(page, handle(8), [20, -50], 6);
  await shoot(page, SHOTS, 'butterfly');
});

test('what cannot be had is said, and what was there stays', async () => {
  const was = await state();
  await tool('line');
  await clicks(WEIGHTS, [30, 30], [60, 60], [60, 60]);
  assert.deepEqual(await state(), was);
  assert.notEqual(await page.$eval('#toast', (e) => e.textContent), '');
  await drag(page, handle(8), [5, 5], 2);
});

test('a pose is made certified, and reset', async () => {
  await page.click('#rest');
  await settle(page);
  assert.match(await certificate(), /^Nothing folded/);
  assert.equal(await page.$eval('.handles #certificate', (e) => e.dataset.state), 'open');
  await drag(page, handle(8), [15, -30], 4);
  assert.doesNotMatch(await certificate(), /Certified/);
  await page.click('#certify');
  await settle(page);
  assert.match(await certificate(), /Certified one-to-one\s*0 of/);
  await shoot(page, SHOTS, 'butterfly-certified');
  await page.click('#rest');
  await settle(page);
  assert.equal(await page.evaluate(() => studio.modes.handles.stats.folded), 0);
});

test('poses and samplings are saved, and loaded again', async () => {
  const folder = `${SHOTS}/handles`, cdp = await browser.target().createCDPSession();
  fs.rmSync(folder, { recursive: true, force: true });
  await cdp.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  const press = (label) => page.evaluate((text) =>
    [...document.querySelectorAll('.handles button')].find((b) => b.textContent === text).click(), label);
  const load = async (label, file) => {
    const [chooser] = await Promise.all([page.waitForFileChooser(), press(label)]);
    await chooser.accept([file]);
    await settle(page);
    await settle(page);
  };
  await drag(page, handle(8), [15, -30], 4);
  const { transforms } = await state();
  for (const [label, name] of [['Save pose', 'pose.json'], ['Save sampling', 'sampling.icc']]) {
    await press(label);
    for (let k = 0; k < 200 && !fs.existsSync(`${folder}/${name}`); ++k) await new Promise((done) => { setTimeout(done, 50); });
  }
  await page.click('#rest');
  await settle(page);
  await load('Load pose …', `${folder}/pose.json`);
  assert.deepEqual((await state()).transforms, transforms);
  const facts = () => page.$eval('.handles dl', (e) => e.textContent), samples = await facts();
  await load('Load sampling …', `${folder}/sampling.icc`);
  assert.equal(await facts(), samples);
  fs.writeFileSync(`${folder}/other.icc`, 'no sampling');
  const was = await state();
  await load('Load sampling …', `${folder}/other.icc`);
  assert.deepEqual(await state(), was);
  assert.notEqual(await page.$eval('#toast', (e) => e.textContent), '');
});

test('a pose is certified while it is dragged; where there is no such map it is not, and says why', async () => {
  await rig('figure');
  await page.click('#keep');
  await settle(page);
  await drag(page, handle(5), [10, 20], 6);
  await drag(page, handle(1), [12, 4], 6);
  assert.match(await certificate(), /Certified one-to-one\s*0 of/);
  await shoot(page, SHOTS, 'figure-certified');
  await drag(page, handle(5), [-30, -80], 6);
  assert.match(await certificate(), /Not certified.*Handle 4 lies outside the outline/);
  await rig('butterfly');
  await drag(page, handle(4), [-290, 40], 6);
  assert.match(await certificate(), /Not certified.*crosses itself/);
  await page.click('#keep');
});

test('no page error, no request', (t) => {
  assert.deepEqual(wrong, []);
  if (POSES) t.diagnostic(`${frames} poses, all the same as those of ${POSES}, to the bit`);
});
