// Pictures of pages of `report`, for doc/report.md: report.png, report_dark.png and report_two.png.
//
// usage: node picture_report.mjs PAGES FOLDER     PAGES has pen.html, rough.html and two.html
import { join, resolve } from 'node:path';
import { chromium } from 'playwright-core';

const [pages, folder] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });

/** One page at a time of the run, in tenths of a second. */
async function take(name, colorScheme, tenths, picture) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, colorScheme });
  const page = await context.newPage();
  await page.goto(`file://${resolve(pages, name)}`);
  await page.waitForSelector('.uplot');
  await page.keyboard.press('Home');
  for (let seconds = 0; seconds < Math.floor(tenths / 10); ++seconds) await page.keyboard.press('Shift+ArrowRight');
  for (let tenth = 0; tenth < tenths % 10; ++tenth) await page.keyboard.press('ArrowRight');
  await page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => { requestAnimationFrame(done); }); }));
  await page.screenshot({ path: join(folder, picture) });
  await context.close();
}

await take('pen.html', 'light', 15, 'report.png');
await take('rough.html', 'dark', 30, 'report_dark.png');
await take('two.html', 'light', 30, 'report_two.png');
await browser.close();
