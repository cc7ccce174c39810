// The package in a page of one's own: AsyncIcc over its worker in Chromium, and the page of the tutorial. Needs
// STUDIO_PACKAGE, TUTORIAL (docs/tutorials/browser.md) and CHROMIUM.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import zlib from 'node:zlib';
import { test } from 'node:test';
import { launch } from './browser.js';

const { STUDIO_PACKAGE, TUTORIAL, CHROMIUM } = process.env;
const TYPES = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html', '.png': 'image/png' };
// With these two a page gets memory that its threads share, and can stop a call in the worker.
const ISOLATED = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** A PNG of a plain colour, 300 x 200. */
const PICTURE = (() => {
  const chunk = (name, ...parts) => {
    const content = Buffer.concat([Buffer.from(name), ...parts]), size = Buffer.alloc(4), sum = Buffer.alloc(4);
    size.writeUInt32BE(content.length - 4);
    sum.writeUInt32BE(checksum(content));
    return Buffer.concat([size, content, sum]);
  };
  const checksum = (bytes) => {
    let rest = 0xffffffff;
    for (const byte of bytes) {
      rest ^= byte;
      for (let k = 0; k < 8; ++k) rest = (rest >>> 1) ^ (rest & 1 ? 0xedb88320 : 0);
    }
    return (rest ^ 0xffffffff) >>> 0;
  };
  const head = Buffer.alloc(13), row = Buffer.concat([Buffer.of(0), Buffer.alloc(900, Buffer.of(70, 130, 180))]);
  head.writeUInt32BE(300, 0);
  head.writeUInt32BE(200, 4);
  head.set([8, 2], 8); // bits, RGB
  const pixels = zlib.deflateSync(Buffer.concat(Array(200).fill(row)));
  return Buffer.concat([Buffer.of(137, 80, 78, 71, 13, 10, 26, 10), chunk('IHDR', head), chunk('IDAT', pixels), chunk('IEND')]);
})();

/** Serves the package at / and where npm puts it, a page at /page.html and its picture; on this machine only. */
const serve = (headers, html = '<!doctype html><title>empty</title>') => new Promise((ready) => {
  const server = http.createServer(({ url }, response) => {
    const file = path.join(STUDIO_PACKAGE, path.normalize(url).replace('/node_modules/libicc', ''));
    const body = url === '/page.html' ? html : url === '/picture.png' ? PICTURE : fs.existsSync(file) && fs.readFileSync(file);
    if (!body) { response.writeHead(404).end(); return; }
    response.writeHead(200, { 'Content-Type': TYPES[path.extname(url)], ...headers }).end(body);
  }).listen(0, '127.0.0.1', () => ready(server));
});

/** What happens in the page; it gives plain values. */
async function session() {
  const { AsyncIcc, IccError, load } = await import('/src/index.js');
  const SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]], LEANING = [[0, 0], [4, 1], [5, 5], [-1, 4]];
  const points = [[1, 1], [2, 3]], seen = {};
  const far = await AsyncIcc.start(), here = await load();
  const map = await far.Map.create(SQUARE, LEANING), there = new here.Map(SQUARE, LEANING);
  seen.stops = far.stops;
  seen.certified = await map.certified;
  seen.images = [[...await map.apply(points)], [...there.apply(points)]];
  seen.saved = [[...await map.save()], [...there.save()]];

  let begun = 0;
  const targets = Array.from({ length: 20 }, (_, k) => [[0, 0], [4, 1 - k / 40], [5, 5], [-1, 4]]);
  const results = await Promise.all(targets.map((t) => far.latest('drag', () => (++begun, map.retarget(t)))));
  seen.begun = begun;
  seen.kept = results.flatMap((r, k) => (r === undefined ? [] : [k]));
  seen.last = [[...await results[19].apply(points)], [...there.retarget(targets[19]).apply(points)]];

  const crossed = await far.Map.create(SQUARE, [[0, 0], [4, 4], [4, 0], [0, 4]]).catch((e) => e);
  seen.refused = [crossed instanceof IccError, crossed.code];
  const shares = [];
  await far.during({ progress: (_, share) => shares.push(share) }, () => far.Map.create(SQUARE, LEANING));
  seen.share = shares.at(-1);
  const controller = new AbortController();
  const slow = far.during({ signal: controller.signal, progress: () => controller.abort() },
    () => far.Chart.create(SQUARE, { method: 'gradient', function: 'bilaplace', cells: far.stops ? 1200 : 100 }));
  seen.aborted = (await slow.catch((e) => e)).name;
  seen.after = await (await far.Map.create(SQUARE, LEANING)).certified;
  far.close();
  seen.closed = (await map.info.catch((e) => e)).message;
  return seen;
}

for (const [name, headers] of [['plain', {}], ['isolated', ISOLATED]])
  test(`AsyncIcc in a ${name} page: the same bits, only the latest, errors, cancelling`, async () => {
    const server = await serve(headers), browser = await launch(CHROMIUM), wrong = [];
    try {
      const page = await browser.newPage();
      page.on('pageerror', (error) => wrong.push(error.message));
      await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
      const seen = await page.evaluate(session);
      assert.equal(seen.stops, name === 'isolated');
      assert.equal(seen.certified, true);
      for (const [far, here] of [seen.images, seen.saved, seen.last]) assert.deepEqual(far, here);
      assert.deepEqual([seen.begun, seen.kept], [2, [0, 19]]);
      assert.deepEqual(seen.refused, [true, 'BOUNDARY']);
      assert.equal(seen.share, 1);
      assert.equal(seen.aborted, 'AbortError');
      assert.equal(seen.after, true);
      assert.match(seen.closed, /has been closed/);
      assert.deepEqual(wrong, []);
    } finally {
      await browser.close();
      server.close();
    }
  });

/** What happens in a page of another host than the package's. */
async function visit(host) {
  const { AsyncIcc, load } = await import(`${host}/src/index.js`), { drawWarped } = await import(`${host}/src/canvas.js`);
  const square = [[0, 0], [4, 0], [4, 4], [0, 4]], here = await load(), far = await AsyncIcc.start();
  const [canvas, image] = [new OffscreenCanvas(4, 4), new OffscreenCanvas(4, 4)];
  image.getContext('2d').fillRect(0, 0, 4, 4);
  drawWarped(canvas, new here.Map(square, square), image);
  const certified = await (await far.Map.create(square, square)).certified;
  far.close();
  return [certified, [...canvas.getContext('2d').getImageData(1, 1, 1, 1).data]];
}

test('the package comes from another host than the page', async () => {
  const servers = [await serve({}), await serve({ 'Access-Control-Allow-Origin': '*' })], browser = await launch(CHROMIUM);
  try {
    const page = await browser.newPage(), [own, other] = servers.map((server) => `http://127.0.0.1:${server.address().port}`);
    await page.goto(`${own}/page.html`);
    assert.deepEqual(await page.evaluate(visit, other), [true, [0, 0, 0, 255]]);
  } finally {
    await browser.close();
    servers.forEach((server) => server.close());
  }
});

test('the page of the tutorial: its corner is dragged, and stays where the cage would cross itself', async () => {
  const [, html] = /^```html\n([^]*?)^```$/m.exec(fs.readFileSync(TUTORIAL, 'utf8'));
  const server = await serve({}, html), browser = await launch(CHROMIUM), wrong = [];
  try {
    const page = await browser.newPage();
    page.on('pageerror', (error) => wrong.push(error.message));
    await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
    await page.waitForFunction('canvas.onpointermove', { timeout: 60000 });
    const { x, y } = await (await page.$('canvas')).boundingBox();
    const covered = () => page.evaluate('[...canvas.getContext("2d").getImageData(0, 0, 400, 400).data]'
      + '.filter((value, i) => i % 4 === 3 && value).length');
    const drag = async (to) => { await page.mouse.move(x + to[0], y + to[1]); return covered(); };
    assert.equal(await covered(), 40000);
    await page.mouse.move(x + 300, y + 300);
    await page.mouse.down();
    assert.ok(Math.abs(await drag([350, 350]) - 50000) < 300);
    const held = await drag([250, 250]);
    assert.ok(Math.abs(held - 30000) < 300);
    assert.equal(await drag([50, 50]), held);
    assert.deepEqual(wrong, []);
  } finally {
    await browser.close();
    server.close();
  }
});

test('the second page of the tutorial: the whole picture, its corners, its pixels, and a drag', async () => {
  const [, html] = [...fs.readFileSync(TUTORIAL, 'utf8').matchAll(/^```html\n([^]*?)^```$/gm)].map(([, page]) => page);
  const server = await serve({}, html), browser = await launch(CHROMIUM), wrong = [];
  try {
    const page = await browser.newPage();
    page.on('pageerror', (error) => wrong.push(error.message));
    await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
    await page.waitForFunction('canvas.onpointermove', { timeout: 60000 });
    await new Promise((done) => { setTimeout(done, 200); });
    const { x, y, width, height } = await (await page.$('canvas')).boundingBox();
    assert.deepEqual([width, height], [500, 400]);
    const count = (test) => page.evaluate(`(() => { const { data } = canvas.getContext('2d').getImageData(0, 0, 500, 400);
      let n = 0; for (let i = 0; i < data.length; i += 4) if (${test}) ++n; return n; })()`);
    const blue = () => count('data[i] === 70 && data[i + 1] === 130 && data[i + 3] === 255');
    assert.ok(await count('data[i] > 200 && data[i + 1] < 40') > 4 * 90); // four dots
    const before = await blue();
    assert.ok(before > 60000 - 4 * 40 && before <= 60000);
    const text = async (px, py) => { await page.mouse.move(x + px, y + py); return page.$eval('#where', (e) => e.textContent); };
    assert.equal(await text(110.5, 120.5), 'pixel 10, 20');
    assert.equal(await text(50, 50), 'outside the picture');
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/tutorial-before.png` });
    await page.mouse.move(x + 395, y + 295);
    await page.mouse.down();
    await page.mouse.move(x + 480, y + 380);
    assert.ok(await blue() > before + 10000);
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/tutorial-dragged.png` });
    const held = await blue();
    await page.mouse.move(x + 20, y + 20); // turned over
    assert.equal(await blue(), held);
    await page.mouse.up();
    assert.deepEqual(wrong, []);
  } finally {
    await browser.close();
    server.close();
  }
});
