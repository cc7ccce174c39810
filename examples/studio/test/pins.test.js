// Mode pins by hand: a figure is posed, pins are added and removed, and those that are not reached are named. Needs STUDIO
// (the page), CHROMIUM, and SHOTS (a folder for screenshots).
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { AFTER, centre, drag, focus, open, settle, shoot, show } from './browser.js';

const { STUDIO, CHROMIUM, SHOTS } = process.env;
const REST = '.pins .panel:not(.first) ';
const pin = (i, side = AFTER) => `${side}[aria-label="pin ${i}"]`;
let browser, page, wrong;

before(async () => {
  ({ browser, page, wrong } = await open(STUDIO, CHROMIUM));
  await show(page, 'pins');
});
after(async () => browser?.close());

const state = () => page.evaluate(() => studio.modes.pins.state);
const stats = () => page.evaluate(() => studio.modes.pins.stats);
const distances = () => page.evaluate(() => [...studio.modes.pins.mesh.distances]);
const images = () => page.evaluate(() => [...studio.modes.pins.mesh.images]);
const card = () => page.$eval('.pins .certificate', (e) => e.textContent);
const toast = () => page.$eval('#toast', (e) => e.textContent);
const labels = () => page.$$eval(`${AFTER}.number`, (all) => all.map((e) => e.textContent));
const rings = () => page.$$eval(`${AFTER}.part.outline:not(.casing)`, (all) => all.length);

async function figure(name) {
  await page.select('#figure', name);
  await settle(page);
}

/** Clicks places of the plane in a panel. */
async function clicks(side, ...places) {
  for (const at of places) {
    await page.mouse.click(...await page.evaluate((selector, [x, y]) => {
      const m = document.querySelector(`${selector}.overlay`).getScreenCTM();
      return [m.a * x + m.e, m.d * y + m.f];
    }, side, at));
    await settle(page);
  }
}

async function certified() {
  const { uncertified, folded } = await stats();
  assert.deepEqual([uncertified, folded], [0, 0]);
  assert.match(await card(), /^Certified one-to-one/);
}

test('it opens with a figure that is posed by six pins alone', async () => {
  await certified();
  assert.match(await card(), /6 pins are exactly in place/);
  assert.notDeepEqual((await state()).targets, (await state()).pins);
  assert.deepEqual(await distances(), [0, 0, 0, 0, 0, 0]);
  await shoot(page, SHOTS, 'pins');
});

test('a pin is dragged: certified in every frame, and the pins are exactly in place', async () => {
  const was = await stats();
  await drag(page, pin(5), [-60, -40], 8);
  await drag(page, pin(3), [30, 90], 8);
  assert.ok((await stats()).frames >= was.frames + 16);
  await certified();
  assert.deepEqual(await distances(), [0, 0, 0, 0, 0, 0]);
  assert.deepEqual(await labels(), []);
});

test('undo and redo bring poses back, to the bit', async () => {
  const now = await images();
  await page.click('#undo');
  await settle(page);
  assert.notDeepEqual(await images(), now);
  await page.click('#redo');
  await settle(page);
  assert.deepEqual(await images(), now);
});

test('a hand that is to lie in the belly is not reached, and it is said by how much', async () => {
  await figure('figure');
  const [[x, y], [u, v]] = [await centre(page, pin(2)), await centre(page, pin(6))];
  await drag(page, pin(2), [u - x + 2, v - y], 10);
  await certified();
  const off = (await distances())[1];
  assert.ok(off > 1, `${off}`);
  assert.match(await card(), new RegExp(`1 pin is not reached.*Pin 2 is ${off.toFixed(0)} px away`));
  assert.deepEqual(await labels(), [`${off.toFixed(0)} px`]);
  assert.match(await page.$eval(`${AFTER}.badge`, (e) => e.textContent), /1 of 6 pins not reached/);
  await shoot(page, SHOTS, 'pins-unreached');
  await page.click('#undo');
  await settle(page);
  assert.deepEqual(await labels(), []);
});

test('pins are added in both pictures, moved by keys and removed', async () => {
  await figure('figure');
  await page.click('[data-tool=point]');
  await clicks(REST, [440, 228]);
  const { pins: [at], targets: [to] } = await state().then(({ pins, targets }) => ({ pins: pins.slice(6), targets: targets.slice(6) }));
  assert.ok(Math.hypot(at[0] - 440, at[1] - 228) < 1 && Math.hypot(at[0] - to[0], at[1] - to[1]) > 5, `${at} to ${to}`);
  await clicks(AFTER, [330, 250]);
  assert.equal((await state()).pins.length, 8);
  await clicks(REST, [30, 30]);
  assert.equal((await state()).pins.length, 8);
  assert.notEqual(await toast(), '');
  await page.click('[data-tool=move]');
  await focus(page, pin(8));
  const [x] = (await state()).targets[7];
  for (const key of ['ArrowRight', 'ArrowRight']) { await page.keyboard.press(key); await settle(page); }
  assert.ok((await state()).targets[7][0] > x);
  await page.keyboard.press('Delete');
  await settle(page);
  await page.click('[data-tool=remove]');
  const [u, v] = await centre(page, pin(7));
  await page.mouse.click(u, v);
  await settle(page);
  assert.equal((await state()).pins.length, 6);
  await page.click('[data-tool=move]');
  await page.click('#back');
  await settle(page);
  assert.deepEqual((await state()).targets, (await state()).pins);
  await certified();
});

test('a reach takes the surroundings of a pin along', async () => {
  const set = (value) => page.evaluate((v) => {
    const input = document.querySelector('.pins .slider input');
    input.value = v;
    input.dispatchEvent(new Event('input'));
  }, value).then(() => settle(page));
  await set(40);
  assert.equal((await state()).reach, 40);
  await drag(page, pin(1), [30, -20], 5);
  await certified();
});

test('the figure: the picture, the cage of mode cage, a ring of clicks, a file with a hole and points', async () => {
  for (const name of ['frame', 'cage']) {
    await figure(name);
    assert.match(await card(), /There is no pin yet/);
    await clicks(AFTER, [200, 200], [400, 400]);
    await page.click('[data-tool=move]');
    await drag(page, pin(2), [-40, 20], 5);
    assert.deepEqual(await distances(), [0, 0]);
    await certified();
  }
  await page.click('[data-tool=outline]');
  await clicks(REST, [200, 200], [500, 220], [420, 500], [200, 200]);
  assert.equal((await state()).figure[0].points.length, 3);
  const ring = (a, b) => [[a, a], [b, a], [b, b], [a, b], [a, a]];
  const features = [{ type: 'Polygon', coordinates: [ring(100, 540), ring(250, 350)] },
    ...[[150, 150], [480, 480]].map((coordinates) => ({ type: 'Point', coordinates }))];
  await page.evaluate((text) => studio.modes.pins.take(new File([text], 'ring.geojson')),
    JSON.stringify({ type: 'FeatureCollection', features: features.map((geometry) => ({ type: 'Feature', geometry })) }));
  await settle(page);
  assert.deepEqual((await state()).pins, [[150, 150], [480, 480]]);
  assert.equal(await rings(), 2);
  await drag(page, pin(2), [30, 30], 5);
  assert.deepEqual(await distances(), [0, 0]);
  await certified();
  await shoot(page, SHOTS, 'pins-hole');
});

test('the view: squares, distortion, triangles; the place under the pointer; a picture is saved', async () => {
  await figure('figure');
  await page.click('.pins .toggle input');
  for (const look of ['heat', 'squares', 'picture']) { await page.click(`input[name=look][value=${look}]`); await settle(page); }
  await page.click('.pins .toggle input');
  const [x, y] = await centre(page, pin(6));
  await page.mouse.move(x + 8, y + 20);
  await settle(page);
  assert.match(await page.$eval(`${REST}.note`, (e) => e.textContent), /^comes from [\d.]+, [\d.]+$/);
  const folder = `${SHOTS}/pins`, cdp = await browser.target().createCDPSession();
  fs.rmSync(folder, { recursive: true, force: true });
  await cdp.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  await page.click('#save');
  const saved = `${folder}/warped.png`;
  for (let k = 0; k < 100 && !fs.existsSync(saved); ++k) await new Promise((done) => { setTimeout(done, 50); });
  assert.equal(fs.readFileSync(saved).readUInt32BE(16), 640);
});

test('the figure in a picture with a transparent ground is what is not transparent, with its hole', async () => {
  await page.evaluate(async () => {
    const sheet = new OffscreenCanvas(300, 200), g = sheet.getContext('2d');
    g.fillStyle = 'teal';
    g.beginPath();
    g.ellipse(150, 100, 120, 80, 0, 0, 7);
    g.ellipse(100, 100, 30, 20, 0, 7, 0, true);
    g.fill();
    g.fillRect(280, 180, 10, 10);
    studio.modes.pins.open(sheet.transferToImageBitmap());
  });
  await settle(page);
  const shape = (await state()).figure, area = ({ points }) => points.reduce((sum, [x, y], i) => {
    const [u, v] = points[(i + 1) % points.length];
    return sum + (x * v - u * y) / 2;
  }, 0);
  assert.deepEqual(shape.map(({ kind }) => kind), ['outline', 'hole']);
  assert.ok(Math.abs(area(shape[0]) / (Math.PI * 120 * 80) - 1) < 0.03 && Math.abs(area(shape[1]) / (Math.PI * 30 * 20) + 1) < 0.1);
  assert.ok(shape[0].points.length < 100, `${shape[0].points.length} corners`);
  await clicks(REST, [60, 100], [240, 100], [5, 5]);
  assert.equal((await state()).pins.length, 2);
  await page.click('[data-tool=move]');
  await drag(page, pin(2), [20, -30], 5);
  assert.deepEqual(await distances(), [0, 0]);
  await certified();
});

test('pins are saved and come back', async () => {
  await figure('figure');
  const { pins, targets } = await state(), folder = `${SHOTS}/saved-pins`, cdp = await browser.target().createCDPSession();
  fs.rmSync(folder, { recursive: true, force: true });
  await cdp.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  await page.click('#save-pins');
  const saved = `${folder}/pins.json`;
  for (let k = 0; k < 100 && !fs.existsSync(saved); ++k) await new Promise((done) => { setTimeout(done, 50); });
  const text = fs.readFileSync(saved, 'utf8');
  assert.deepEqual(JSON.parse(text), { pins: pins.map((at, i) => ({ at, to: targets[i] })) });
  await page.click('#back');
  await settle(page);
  await page.evaluate((content) => studio.modes.pins.take(new File([content], 'pins.json')), text);
  await settle(page);
  assert.deepEqual([(await state()).pins, (await state()).targets], [pins, targets]);
  await certified();
});

test('no page error, no request', () => assert.deepEqual(wrong, []));
