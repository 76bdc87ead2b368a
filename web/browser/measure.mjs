// Opens a page three times and prints what it takes: time until its first plot is drawn, pictures a second while it plays, and the
// processor time of all of Chromium for each, which says more than a rate on a machine with other work.
//
// usage: node browser/measure.mjs PAGE.html
import { readFileSync, readdirSync } from 'node:fs';
import { resolve } from 'node:path';
import { chromium } from 'playwright-core';

/** Processor time of every Chromium, ms. */
function processorTime() {
  let total = 0;
  for (const process of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      if (!readFileSync(`/proc/${process}/cmdline`, 'utf8').includes('chromium')) continue;
      const fields = readFileSync(`/proc/${process}/stat`, 'utf8').split(') ')[1].split(' ');
      total += 10 * (Number(fields[11]) + Number(fields[12]));
    } catch {
      // It has ended meanwhile.
    }
  }
  return total;
}

const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
for (let round = 0; round < 3; ++round) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  const before = processorTime();
  const begin = performance.now();
  await page.goto(`file://${resolve(process.argv[2])}`);
  await page.waitForSelector('.uplot');
  await page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => { requestAnimationFrame(done); }); }));
  const opened = performance.now() - begin;
  const opening = processorTime() - before;
  await page.waitForTimeout(4000);
  await page.keyboard.press('Space');
  await page.waitForTimeout(1000);
  const start = processorTime();
  const [frames, seconds] = await page.evaluate(() => new Promise((done) => {
    const from = performance.now();
    let count = 0;
    const next = (now) => {
      ++count;
      if (now - from > 5000) done([count, (now - from) / 1000]);
      else requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  }));
  const cost = (processorTime() - start) / frames;
  console.log(`opened in ${opened.toFixed(0)} ms (${opening} ms of processor time), ${(frames / seconds).toFixed(1)} pictures/s, ${cost.toFixed(1)} ms of processor time each`);
  await page.close();
}
await browser.close();
