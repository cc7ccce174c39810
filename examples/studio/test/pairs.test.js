// Mode points by hand: pairs of places are clicked, a wrong one is found and put right. Needs STUDIO (the page), CHROMIUM,
// and SHOTS (a folder for screenshots). LIBICC is the command of a native build, which has to make the same map.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { drag, focus, open, settle, shoot, show } from './browser.js';

const { STUDIO, CHROMIUM, SHOTS, LIBICC } = process.env;
const BEFORE = '.points .panel:nth-child(1) ', AFTER = '.points .panel:nth-child(2) ', OTHER = '.points .panel:nth-child(4) ';
const point = (i, side = AFTER) => `${side}[aria-label="point ${i}"]`;
let browser, page, wrong;

before(async () => {
  ({ browser, page, wrong } = await open(STUDIO, CHROMIUM));
  await show(page, 'points');
});
after(async () => browser?.close());

const state = () => page.evaluate(() => studio.modes.points.state);
const stats = () => page.evaluate(() => studio.modes.points.stats);
const mesh = () => page.evaluate(() => {
  const { residuals, leftOuts, leftOut } = studio.modes.points.mesh;
  return { residuals: [...residuals], leftOuts: [...leftOuts], leftOut };
});
const card = () => page.$eval('.points .certificate', (e) => e.textContent);
const rows = () => page.$$eval('.residuals tbody tr', (all) => all.map((row) => [...row.children].map((e) => e.textContent)));
const marked = () => page.$$eval('.residuals .wrong th', (all) => all.map((e) => e.textContent));
const tool = (name) => page.click(`[data-tool=${name}]`);

/** A place of the plane on the screen, in a panel. */
const placeIn = (side, at) => page.evaluate((selector, [x, y]) => {
  const m = document.querySelector(`${selector}.overlay`).getScreenCTM();
  return [m.a * x + m.e, m.d * y + m.f];
}, side, at);

async function click(side, at) {
  await page.mouse.click(...await placeIn(side, at));
  await settle(page);
}

async function certified() {
  const { uncertified, folded } = await stats();
  assert.deepEqual([uncertified, folded], [0, 0]);
  assert.match(await card(), /^Certified one-to-one/);
}

test('it opens with a wrong point: the thin plate folds, the map does not, and the table names the point', async () => {
  await certified();
  assert.ok((await stats()).other > 0);
  assert.match(await page.$eval(`${OTHER}.badge`, (e) => e.textContent), /^\d+ folded$/);
  assert.equal((await rows()).length, 10);
  const { leftOuts, residuals } = await mesh();
  assert.equal(leftOuts.indexOf(Math.max(...leftOuts)), 3);
  assert.deepEqual(await marked(), ['4']);
  assert.match(await card(), /point 4 is [\d.]+ px from where the others would take it/);
  assert.ok(Math.max(...residuals) < 1e-6);
  await shoot(page, SHOTS, 'points');
});

test('the wrong point is dragged to its place: certified in every frame, and the accuracy is better then', async () => {
  const was = await mesh(), frames = (await stats()).frames;
  const [x, y] = await placeIn(AFTER, [456, 326]), [u, v] = await placeIn(AFTER, [250, 250]);
  await drag(page, point(4), [u - x, v - y], 8);
  await certified();
  assert.ok((await stats()).frames >= frames + 8);
  const now = await mesh();
  assert.ok(now.leftOut < was.leftOut / 3, `${now.leftOut} and ${was.leftOut}`);
  assert.equal((await stats()).other, 0);
  assert.ok(!(await marked()).includes('4'));
  await shoot(page, SHOTS, 'points-right');
  for (const [id, same] of [['undo', was], ['redo', now]]) {
    await page.click(`#${id}`);
    await settle(page);
    assert.deepEqual(await mesh(), same);
  }
});

test('the points are saved as the command reads them, and loaded again', async (t) => {
  const folder = `${SHOTS}/points`, cdp = await browser.target().createCDPSession(), { points, targets } = await state();
  fs.rmSync(folder, { recursive: true, force: true });
  await cdp.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  for (const [label, name] of [['Save CSV', 'points.csv'], ['Save QGIS .points', 'picture.points'], ['Save PNG', 'warped.png']]) {
    await page.evaluate((text) => [...document.querySelectorAll('.points button')].find((b) => b.textContent === text).click(), label);
    for (let k = 0; k < 200 && !fs.existsSync(`${folder}/${name}`); ++k) await new Promise((done) => { setTimeout(done, 50); });
  }
  assert.equal(fs.readFileSync(`${folder}/warped.png`).readUInt32BE(16), 640);
  const texts = ['points.csv', 'picture.points'].map((name) => fs.readFileSync(`${folder}/${name}`, 'utf8'));
  assert.match(texts[0], /^x,y,to_x,to_y\n/);
  assert.match(texts[1], /^mapX,mapY,sourceX,sourceY,enable\n/);
  const near = (list, other) => list.flat().every((v, k) => Math.abs(v - other.flat()[k]) < 1e-3);
  for (const text of texts) {
    await page.click('#none');
    await settle(page);
    assert.match(await card(), /No points yet/);
    await page.evaluate((csv) => studio.modes.points.take(new File([csv], 'given.csv', { type: 'text/csv' })), text);
    await settle(page);
    const now = await state();
    assert.ok(near(points, now.points) && near(targets, now.targets), JSON.stringify(now));
  }
  if (!LIBICC) { t.diagnostic('not compared: there is no native build'); return; }
  const { leftOut } = await mesh();
  for (const [name, box] of [['points.csv', '0,0,640,640'], ['picture.points', '0,-640,640,0']]) {
    const said = execFileSync(LIBICC, ['fit', '--box', box, `${folder}/${name}`], { encoding: 'utf8' });
    const accuracy = Number(/accuracy\s+([\d.]+)/.exec(said)[1]);
    assert.ok(Math.abs(accuracy - leftOut) < 1e-3 * leftOut, `${name}: ${accuracy} and ${leftOut}`);
  }
});

test('what cannot be read is said, and the points stay', async () => {
  const was = await state();
  for (const text of ['no points', 'x,y,to_x,to_y\n1,2,2683850,1247721\n']) {
    await page.evaluate((t) => studio.modes.points.take(new File([t], 'given.csv')), text);
    await page.waitForFunction('document.getElementById("toast").textContent.includes("could not be read")');
  }
  assert.deepEqual(await state(), was);
});

test('points that may be off are smoothed', async () => {
  await page.evaluate(() => {
    const input = document.querySelector('.points .slider input');
    input.value = 6;
    input.dispatchEvent(new Event('input'));
  });
  await settle(page);
  assert.equal((await state()).tolerance, 6);
  await certified();
  await page.click('#plate');
  await settle(page);
  assert.equal(await page.$eval(OTHER, (e) => e.hidden), true);
  await page.click('#plate');
  await settle(page);
});

test('an empty sheet: pairs are clicked, moved by keys and removed', async () => {
  await page.click('#empty');
  await settle(page);
  assert.match(await card(), /No points yet/);
  for (const [one, other] of [[[100, 120], [150, 150]], [[500, 140], [480, 200]], [[480, 520], [500, 540]], [[120, 500], [140, 470]]]) {
    await click(BEFORE, one);
    await click(AFTER, other);
    await certified();
  }
  assert.equal((await state()).points.length, 4);
  await tool('move');
  await focus(page, point(2));
  const [x] = (await state()).targets[1];
  await page.keyboard.press('ArrowRight');
  await settle(page);
  assert.ok((await state()).targets[1][0] > x);
  await drag(page, point(3, BEFORE), [10, 10], 3);
  await tool('remove');
  await page.click(point(1, BEFORE));
  await settle(page);
  assert.equal((await state()).points.length, 3);
  await certified();
  await tool('move');
  await shoot(page, SHOTS, 'points-empty');
});

test('points that would mirror the picture have no map: it is said, and undone', async () => {
  await page.evaluate(() => studio.modes.points.edit({ targets: studio.modes.points.state.targets.map(([x, y]) => [640 - x, y]) }));
  await settle(page);
  assert.match(await card(), /^No map/);
  await page.click('#undo');
  await settle(page);
  await certified();
});

test('no page error, no request', () => assert.deepEqual(wrong, []));
