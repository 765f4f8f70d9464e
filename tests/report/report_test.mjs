// SPDX-License-Identifier: GPL-3.0-or-later
// Drives a report in headless Chromium: report_test.mjs REPORT.html. Exit status 77: a tool is missing.
import assert from 'node:assert/strict';
import {existsSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

let chromium;
try {
  ({chromium} = await import('playwright-core'));
} catch {
  console.log('skipped: playwright-core is missing, run `npm ci` in tests/report');
  process.exit(77);
}
const executablePath = ['/usr/bin/chromium', '/usr/bin/google-chrome'].find(existsSync);
if (!executablePath) {
  console.log('skipped: Chromium is missing');
  process.exit(77);
}
const url = pathToFileURL(process.argv[2]).href;
const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});

async function open(options, hash = '') {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  const problems = [];
  page.on('console', (m) => {
    // This test, not the page, reads the canvas again and again.
    if (['error', 'warning'].includes(m.type()) && !m.text().startsWith('Canvas2D: Multiple readback')) problems.push(m.text());
  });
  page.on('pageerror', (e) => problems.push(String(e)));
  page.on('request', (r) => { if (!/^(data|file):/.test(r.url())) problems.push(`request: ${r.url()}`); });
  await page.goto(url + hash);
  return {page, problems};
}
const status = (page) => page.locator('#v-status').textContent();

try {
  const {page, problems} = await open({viewport: {width: 1280, height: 900}});
  await page.waitForSelector('#viewer[data-ready]');

  // Pictures: each is there and not of one colour only in what is drawn.
  const sizes = await page.$$eval('img', (list) => list.map((i) => i.naturalWidth * i.naturalHeight));
  assert.ok(sizes.length >= 2 && sizes.every((n) => n > 0), 'every picture has pixels');
  assert.ok(await page.$$eval('svg.lattice', (list) => list.length > 0 && list.every((s) => s.getBoundingClientRect().height > 50)));
  const colours = () => page.$eval('#v-canvas', (c) => {
    const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, seen = new Set();
    for (let i = 0; i < d.length; i += 4) seen.add((d[i] << 16) | (d[i + 1] << 8) | d[i + 2]);
    return seen.size;
  });
  assert.ok(await colours() > 1, 'the viewer shows something');

  // Keys: a wrong pixel, its status, flip, layers, zoom, help.
  await page.focus('#v-canvas');
  await page.keyboard.press('n');
  const first = await status(page);
  assert.match(first, /^\(\d+, \d+\) {2}yours \d+ \d+ \d+ {2}expected \d+ \d+ \d+ {2}\w+/);
  await page.keyboard.press('n');
  const several = await page.$eval('#data', (d) => JSON.parse(d.textContent)[0].wrong.length > 1);
  assert.equal(await status(page) !== first, several, 'n goes on');
  await page.keyboard.press('p');
  assert.equal(await status(page), first, 'p goes back');
  await page.keyboard.press('Space');
  assert.equal(await page.inputValue('#v-layer'), 'expected');
  for (const [key, layer] of [['3', 'difference'], ['4', 'owner'], ['1', 'got']]) {
    await page.keyboard.press(key);
    assert.equal(await page.inputValue('#v-layer'), layer);
  }
  const zoom = () => page.$eval('#v-canvas', (c) => Number(c.dataset.zoom));
  const before = await zoom();
  await page.keyboard.press('-');
  assert.equal(await zoom(), before / 2);
  for (let i = 0; i < 12; ++i) await page.keyboard.press('+');
  assert.equal(await zoom(), 64, 'zoom ends at 64');
  await page.keyboard.press('f');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('#v-keys'));

  // The pixel under the pointer; wheel.
  const box = await page.locator('#v-canvas').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  assert.match(await status(page), /^\(\d+, \d+\)/);
  const fitted = await zoom();
  await page.mouse.wheel(0, -100);
  await page.waitForFunction((z) => Number(document.getElementById('v-canvas').dataset.zoom) > z, fitted);
  for (const mode of ['side', 'swipe', 'single']) {
    await page.selectOption('#v-mode', mode);
    assert.ok(await colours() > 1, mode);
  }

  // The row, step by step.
  await page.locator('.stepper').first().fill('1');
  const now = await page.locator('table.steps').first().locator('tr.now td').first().textContent();
  assert.equal(await page.locator('.lattice .step').first().getAttribute('cx'), now);

  // The filter box.
  const shown = () => page.$$eval('#cases tbody tr', (rows) => rows.filter((r) => !r.hidden).length);
  const all = await shown();
  assert.ok(all > 0);
  await page.fill('#filter', 'surely no case has this');
  assert.equal(await shown(), 0);
  await page.fill('#filter', '');
  assert.equal(await shown(), all);

  // Roles, names and contrast, light and dark.
  const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({colorScheme});
    await page.evaluate(axe);
    const {violations} = await page.evaluate(() => axe.run());
    assert.deepEqual(violations.map((v) => `${colorScheme} ${v.id}: ${v.nodes[0].html}`), []);
  }
  assert.deepEqual(problems, []);

  // A link to a pixel.
  const deep = await open({}, '#picture=0&x=1&y=2&zoom=32');
  await deep.page.waitForSelector('#viewer[data-ready]');
  assert.match(await status(deep.page), /^\(1, 2\)/);
  assert.deepEqual(deep.problems, []);

  // A phone: nothing sticks out.
  const phone = await open({viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true});
  await phone.page.waitForSelector('#viewer[data-ready]');
  assert.ok(await phone.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
  assert.deepEqual(phone.problems, []);

  // Without JavaScript: findings, pictures and tables are there, the viewer is not.
  const plain = await open({javaScriptEnabled: false});
  assert.ok(await plain.page.locator('.finding .message').first().isVisible());
  assert.ok(await plain.page.locator('svg.lattice').first().isVisible());
  assert.ok(!await plain.page.locator('#viewer').isVisible());
  console.log(`passed: ${sizes.length} pictures, ${all} cases`);
} finally {
  await browser.close();
}
