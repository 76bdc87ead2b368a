import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { chromium, type Browser, type Page } from 'playwright-core';

// Pages that scripts/check_page has made with the program `report`, opened in a real browser.
const folder = process.env['PAGES'] ?? '';
const FLAGS = ['--no-sandbox', '--enable-unsafe-swiftshader'];

let browser: Browser;

before(async () => {
  browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: FLAGS });
});
after(async () => {
  await browser.close();
});

interface Opened {
  page: Page;
  /** What the page said on its console, and what it asked the network for. */
  complaints: string[];
}

async function open(name: string, width = 1280, colorScheme: 'light' | 'dark' = 'light'): Promise<Opened> {
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
  const complaints: string[] = [];
  page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
  page.on('pageerror', (error) => { complaints.push(error.message); });
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) complaints.push(request.url()); });
  await page.goto(`file://${folder}/${name}`);
  await page.waitForSelector('.uplot');
  return { page, complaints };
}

async function clockOf(page: Page): Promise<number> {
  const text = (await page.locator('.clock').textContent()) ?? '';
  return Number.parseFloat(text);
}

async function waitForClock(page: Page, holds: (time: number) => boolean): Promise<number> {
  for (let i = 0; i < 200; ++i) {
    const time = await clockOf(page);
    if (holds(time)) return time;
    await page.waitForTimeout(50);
  }
  throw new Error(`the clock stands at ${await clockOf(page)}`);
}

test('a page opens without a complaint, without the network, light and dark', async () => {
  for (const scheme of ['light', 'dark'] as const) {
    const { page, complaints } = await open('pen.html', 1280, scheme);
    assert.equal(await page.title(), 'pen.bag: report');
    assert.ok((await page.locator('.uplot').count()) >= 2);
    assert.ok((await page.locator('.view canvas').count()) >= 3);
    const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(background === 'rgb(13, 17, 22)', scheme === 'dark', background);
    assert.deepEqual(complaints, []);
    await page.close();
  }
});

test('space plays, arrows step, the slider goes to a time', async () => {
  const { page, complaints } = await open('pen.html');
  await page.keyboard.press('Space');
  const time = await waitForClock(page, (now) => now > 0.3);
  await page.keyboard.press('Space');
  const paused = await clockOf(page);
  assert.ok(paused >= time);
  await page.keyboard.press('End');
  await waitForClock(page, (now) => now > 5.9);
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await waitForClock(page, (now) => Math.abs(now - 0.1) < 1e-6);
  await page.locator('.track input').fill('2.5');
  await waitForClock(page, (now) => Math.abs(now - 2.5) < 1e-6);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a pointer on one plot shows its time in all of them, and leaves the run where it is', async () => {
  const { page } = await open('pen.html');
  const plots = page.locator('.u-over');
  await plots.first().hover();
  const time = await waitForClock(page, (now) => now > 1);
  const lines = await page.locator('.u-cursor-x').evaluateAll((all) => all.slice(0, 2).map((line) => line.getBoundingClientRect().left - (line.parentElement?.getBoundingClientRect().left ?? 0)));
  assert.ok(lines.length === 2 && lines.every((left) => left > 20), `${lines.join()} at ${time}`);
  await page.mouse.move(5, 5);
  await waitForClock(page, (now) => now === 0);
  await page.close();
});

test('a click on a contact goes to its time', async () => {
  const { page } = await open('pen.html');
  const row = page.locator('tr.clickable').first();
  const time = Number.parseFloat((await row.locator('button').textContent()) ?? '');
  assert.ok(time > 0.5);
  await row.click();
  await waitForClock(page, (now) => Math.abs(now - time) < 0.01);
  await page.close();
});

test('a click on the time line beside a contact goes to its time', async () => {
  const { page } = await open('pen.html');
  const contact = Number.parseFloat((await page.locator('tr.clickable button').first().textContent()) ?? '');
  const slider = page.locator('.track input');
  const box = await slider.boundingBox();
  assert.ok(box);
  const end = Number(await slider.getAttribute('max'));
  await page.mouse.click(box.x + 8 + ((box.width - 16) * contact) / end + 3, box.y + box.height / 2);
  await waitForClock(page, (now) => Math.abs(now - contact) < 0.0051);
  await page.close();
});

test('a dark page is printed dark on white, with every plot', async () => {
  const { page, complaints } = await open('pen.html');
  await page.keyboard.press('l');
  await page.waitForFunction(() => document.documentElement.dataset['theme'] === 'dark');
  const before = await page.locator('.uplot').count();
  await page.emulateMedia({ media: 'print' });
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  const [text, background, timeline] = await page.evaluate(() => [
    getComputedStyle(document.querySelector('.card h2') ?? document.body).color,
    getComputedStyle(document.body).backgroundColor,
    getComputedStyle(document.querySelector('.timeline') ?? document.body).display,
  ]);
  assert.equal(text, 'rgb(27, 36, 48)');
  assert.equal(background, 'rgb(255, 255, 255)');
  assert.equal(timeline, 'none');
  assert.equal(await page.locator('.uplot').count(), await page.locator('figure.panel').count());
  assert.ok(before <= (await page.locator('.uplot').count()));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a manoeuvre that was flown has a card that goes to its first execute', async () => {
  const { page, complaints } = await open('manoeuvres.html');
  const card = page.locator('.card', { hasText: 'turning_circle' });
  assert.match((await card.textContent()) ?? '', /tactical diameter[\d.]+ m/);
  const time = Number.parseFloat((await card.locator('button').textContent()) ?? '');
  assert.ok(time > 4.9);
  await card.locator('button').click();
  await waitForClock(page, (now) => Math.abs(now - time) < 0.01);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('on a telephone nothing is wider than the screen', async () => {
  const { page, complaints } = await open('two.html', 390);
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 390, `${width} pixels`);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('two runs lie over each other, with where they part', async () => {
  const { page, complaints } = await open('two.html');
  const text = (await page.locator('.cards').textContent()) ?? '';
  assert.match(text, /They part at \d/);
  assert.ok((await page.locator('.u-legend').first().textContent())?.includes('difference'));
  const labels = await page.locator('.u-legend .u-label').allTextContents();
  assert.ok(labels.includes('forward u A') && labels.includes('forward u B'), labels.join());
  assert.deepEqual(complaints, []);
  await page.close();
});

test('of two bodies the chosen one is plotted', async () => {
  const { page } = await open('crates.html');
  const button = page.locator('.choice', { hasText: 'crate_b' });
  await button.click();
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  await page.waitForFunction(() => document.querySelector('.source')?.textContent?.includes('crate_b'));
  await page.close();
});

test('texts of a bag are texts', async () => {
  const { page, complaints } = await open('hostile.html');
  const { isHurt, images, text } = await page.evaluate(() => ({
    isHurt: 'hurt' in window,
    images: document.querySelectorAll('img').length,
    text: document.body.textContent ?? '',
  }));
  assert.equal(isHurt, false);
  assert.equal(images, 0);
  assert.ok(text.includes('<img src=x onerror='), 'the name is shown as it is');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a bag of poses alone, and one of odometry alone, have a way and speeds', async () => {
  for (const name of ['poses.html', 'odometry.html']) {
    const { page, complaints } = await open(name);
    assert.ok((await page.locator('.title').first().textContent())?.startsWith('Velocity'), name);
    assert.deepEqual(complaints, [], name);
    await page.close();
  }
});
