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
  const several = await page.$eval('#data', (d) => JSON.parse(d.textContent).pictures[0].wrong.length > 1);
  assert.equal(await status(page) !== first, several, 'n goes on');
  await page.keyboard.press('p');
  assert.equal(await status(page), first, 'p goes back');
  await page.keyboard.press('Space');
  assert.equal(await page.inputValue('#v-layer'), 'expected');
  for (const [key, layer] of [['3', 'difference'], ['4', 'owner'], ['5', 'depth'], ['6', 'depth-error'], ['7', 'count'], ['1', 'got']]) {
    await page.keyboard.press(key);
    assert.equal(await page.inputValue('#v-layer'), layer);
    assert.ok(await colours() > 1, layer);
  }

  // Gain and range change what their layers show, and are there for them only.
  const shot = () => page.$eval('#v-canvas', (c) => c.toDataURL());
  for (const [layer, control, value] of [['difference', '#v-gain', '5'], ['depth', '#v-high', '400']]) {
    assert.ok(!await page.isVisible(control));
    await page.selectOption('#v-layer', layer);
    const old = await shot();
    await page.fill(control, value);
    assert.notEqual(await shot(), old, control);
  }
  await page.selectOption('#v-layer', 'got');

  // A pixel that is held: who covers it, and the numbers that decide.
  await page.focus('#v-canvas');
  await page.keyboard.press('n');
  await page.keyboard.press('p');
  const details = () => page.locator('#v-details').textContent();
  assert.match(await details(), /Polygons that cover it.*polygon 0.*an edge counts when.*odd, so it is inside/s);
  const [x, y] = await page.$eval('#data', (d) => JSON.parse(d.textContent).pictures[0].wrong[0]);
  const sums = await page.$$eval('#v-details li', (list) => list.map((e) => e.textContent).filter((e) => e.includes('·')));
  assert.ok(sums.length >= 2);
  for (const text of sums) {
    // "(1, 1)–(3, 8): (3 − 1)·7 − (3 − 1)·2 = 10 ≥ 0, counts": the sum is what it says.
    const [, x1, y1, x2, y2, value, verdict] = text.match(/^\((-?\d+), (-?\d+)\)–\((-?\d+), (-?\d+)\): .* = (−?\d+) ([≥<]) 0/).map((v) => v.replace('−', '-'));
    const exact = (x - x1) * (y2 - y1) - (y - y1) * (x2 - x1);
    assert.equal(Number(value), exact, text);
    assert.equal(verdict, exact >= 0 ? '≥' : '<', text);
  }
  await page.click('#v-details button');
  assert.equal(await page.getAttribute('#v-details button', 'aria-pressed'), 'true');
  await page.focus('#v-canvas');
  await page.keyboard.press('Escape');
  assert.ok(!await page.isVisible('#v-details'), 'Escape lets it go');
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
  // A click holds the pixel: what is below no longer follows the pointer. Another click lets it go.
  await page.mouse.down();
  await page.mouse.up();
  const held = await status(page);
  await page.mouse.move(box.x + box.width / 2 + 90, box.y + box.height / 2 + 90);
  assert.equal(await status(page), held);
  assert.ok(await page.isVisible('#v-details'));
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.up();
  assert.ok(!await page.isVisible('#v-details'));
  // Dragging moves the picture and holds nothing.
  const still = await shot();
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 30, {steps: 3});
  await page.mouse.up();
  assert.notEqual(await shot(), still);
  assert.ok(!await page.isVisible('#v-details'));
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

  // Curves of speed.
  for (const line of await page.$$eval('svg.curve polyline', (list) => list.map((e) => e.getAttribute('points')))) assert.doesNotMatch(line, /nan|inf/i);

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
  await page.focus('#v-canvas');
  await page.keyboard.press('n');
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
  // A finger holds a pixel, too.
  const small = await phone.page.locator('#v-canvas').boundingBox();
  await phone.page.locator('#v-canvas').scrollIntoViewIfNeeded();
  await phone.page.locator('#v-canvas').tap({position: {x: small.width / 2, y: small.height / 2}});
  assert.ok(await phone.page.isVisible('#v-details'));
  assert.ok(await phone.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
  assert.deepEqual(phone.problems, []);

  // Without JavaScript: findings, pictures and tables are there, the viewer is not.
  const plain = await open({javaScriptEnabled: false});
  assert.ok(await plain.page.locator('.finding .message').first().isVisible());
  assert.ok(await plain.page.locator('svg.lattice').first().isVisible());
  assert.ok(!await plain.page.locator('#viewer').isVisible());
  console.log(`driven: ${sizes.length} pictures, ${all} cases`);
} finally {
  await browser.close();
}
