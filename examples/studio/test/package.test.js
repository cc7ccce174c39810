// The package in a page of one's own: AsyncIcc over its worker in Chromium, and the page of the tutorial. Needs
// STUDIO_PACKAGE, TUTORIAL (docs/tutorials/browser.md) and CHROMIUM.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { test } from 'node:test';
import { launch } from './browser.js';

const { STUDIO_PACKAGE, TUTORIAL, CHROMIUM } = process.env;
const TYPES = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
// With these two a page gets memory that its threads share, and can stop a call in the worker.
const ISOLATED = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** Serves the package at / and where npm puts it, and a page at /page.html; on this machine only. */
const serve = (headers, html = '<!doctype html><title>empty</title>') => new Promise((ready) => {
  const server = http.createServer(({ url }, response) => {
    const file = path.join(STUDIO_PACKAGE, path.normalize(url).replace('/node_modules/libicc', ''));
    const body = url === '/page.html' ? html : fs.existsSync(file) && fs.readFileSync(file);
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
