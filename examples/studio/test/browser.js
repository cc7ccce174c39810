// Chromium without a screen, and what a user does in it.
import path from 'node:path';
import puppeteer from 'puppeteer-core';

const ARGUMENTS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars',
  '--force-prefers-reduced-motion'];
export const LOOKS = {
  light: { width: 1360, height: 800 }, dark: { width: 1360, height: 800 },
  phone: { width: 390, height: 844, deviceScaleFactor: 2 },
};
export const AFTER = 'figure.first ';
export const TOUCH = { ...LOOKS.phone, hasTouch: true, isMobile: true };

export const launch = (chromium) => puppeteer.launch({ executablePath: chromium, headless: true, args: ARGUMENTS });

/** Opens the page from disk; what goes wrong in it, and what it asks the network for, is collected. */
export async function open(file, chromium) {
  const browser = await launch(chromium);
  const page = await browser.newPage();
  const wrong = [];
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
  page.on('console', (message) => message.type() === 'error' && wrong.push(`console: ${message.text()}`));
  page.on('request', (request) => !/^(file|blob|data):/.test(request.url()) && wrong.push(`request: ${request.url()}`));
  await page.setViewport(LOOKS.light);
  await page.goto(`file://${path.resolve(file)}`);
  await page.waitForFunction('globalThis.studio?.cage.stats.frames > 0', { timeout: 120000 });
  return { browser, page, wrong };
}

/** A page that is loaded anew. */
export async function again(page, viewport) {
  await page.setViewport(viewport);
  await page.reload();
  await page.waitForFunction('globalThis.studio?.cage.stats.frames > 0', { timeout: 120000 });
}

/** Until nothing is under way: what was asked has come, and was drawn. */
export const settle = (page) => page.evaluate(async () => {
  await studio.remote.call('version');
  for (let k = 0; k < 3; ++k) await new Promise((done) => { requestAnimationFrame(done); });
  await studio.remote.call('version');
  await new Promise((done) => { requestAnimationFrame(done); });
});

export const frame = (page) => page.evaluate(() => new Promise((done) => { requestAnimationFrame(done); }));

export async function centre(page, selector) {
  const box = await (await page.$(selector)).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** Goes from a handle by `by` in steps of a frame; `pointer` is mouse, touch or right. */
export async function drag(page, selector, by, steps, pointer = 'mouse') {
  const [x, y] = await centre(page, selector);
  const at = (k) => [x + (by[0] * k) / steps, y + (by[1] * k) / steps];
  if (pointer === 'touch') {
    await page.touchscreen.touchStart(x, y);
    for (let k = 1; k <= steps; ++k) { await page.touchscreen.touchMove(...at(k)); await settle(page); }
    await page.touchscreen.touchEnd();
  } else {
    const button = pointer === 'right' ? 'right' : 'left';
    await page.mouse.move(x, y);
    await page.mouse.down({ button });
    for (let k = 1; k <= steps; ++k) { await page.mouse.move(...at(k)); await settle(page); }
    await page.mouse.up({ button });
  }
  await settle(page);
}

export const show = async (page, mode) => {
  await page.click(`[data-mode=${mode}]`);
  await page.waitForFunction(`studio.modes.${mode}.stats.frames > 0`, { timeout: 120000 });
  await settle(page);
};

export const focus = (page, selector) => page.$eval(selector, (element) => element.focus());

/** Screenshots in the three looks; the page is light and wide again after that. */
export async function shoot(page, folder, name) {
  const look = (scheme) => page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  for (const [key, viewport] of Object.entries(LOOKS)) {
    await look(key === 'dark' ? 'dark' : 'light');
    await page.setViewport(viewport);
    await settle(page);
    await page.screenshot({ path: `${folder}/${name}-${key}.png` });
  }
  await look('light');
  await page.setViewport(LOOKS.light);
  await settle(page);
}
