// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures for docs/conformance/reading-your-report.md: pictures.mjs FOLDER NAME=REPORT.html ... writes FOLDER/report-NAME.png,
// the first finding of each report, short.
import {existsSync, statSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';

const [folder, ...reports] = process.argv.slice(2);
const executablePath = ['/usr/bin/chromium', '/usr/bin/google-chrome'].find(existsSync);
const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--disable-lcd-text']});
const page = await (await browser.newContext({viewport: {width: 760, height: 900}, colorScheme: 'light'})).newPage();
for (const word of reports) {
  const [name, report] = word.split('=');
  await page.goto(pathToFileURL(report).href);
  await page.waitForSelector('#viewer[data-ready]');
  // Of a whole frame the pictures tell most, otherwise the drawing with its row.
  const frame = (await page.locator('#finding-1 h3').textContent()).includes('frame.');
  await page.addStyleTag({content: `
    article details, article button, article > p.small, article p.pictures ~ p.pictures, input.stepper { display: none }
    ${frame ? '.columns > div' : 'article p.pictures'} { display: none }
    article { border-radius: 0 !important; font-size: 13px }
    .columns .small, .columns figcaption, table.steps, ul.sums { font-size: 12px }
    svg.lattice { max-height: 15em }
    article div.scroll { max-height: none; overflow: visible }`});
  const file = path.join(folder, `report-${name}.png`);
  await page.locator('#finding-1').screenshot({path: file});
  console.log(file, statSync(file).size);
}
await browser.close();
