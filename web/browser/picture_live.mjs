// Pictures of the page of a running simulation (LIVE=http://localhost:PORT/), for doc/web.md: web.png, driven by keys, and web_dark.png.
//
// usage: node picture_live.mjs FOLDER
import { join } from 'node:path';
import { chromium } from 'playwright-core';

const folder = process.argv[2];
const browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
for (const colorScheme of ['light', 'dark']) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 1180 }, colorScheme });
  const page = await context.newPage();
  await page.goto(process.env['LIVE']);
  await page.waitForSelector('.uplot');
  await page.getByRole('button', { name: 'Reset' }).click();
  await page.waitForTimeout(500);
  await page.getByRole('button', { name: 'Take the helm' }).click();
  await page.waitForSelector('.driving');
  await page.keyboard.down('w');
  await page.waitForTimeout(2500);
  await page.keyboard.down('a');
  await page.waitForTimeout(2500);
  await page.keyboard.up('w');
  await page.waitForTimeout(800);
  await page.screenshot({ path: join(folder, colorScheme === 'dark' ? 'web_dark.png' : 'web.png') });
  await context.close();
}
await browser.close();
