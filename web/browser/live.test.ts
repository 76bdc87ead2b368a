import assert from 'node:assert/strict';
import { createServer as createHttpServer } from 'node:http';
import { connect, createServer, type AddressInfo, type Server, type Socket } from 'node:net';
import { after, before, test } from 'node:test';
import { chromium, type Browser, type Page } from 'playwright-core';

// The page of a web_node that scripts/check_page has started (LIVE=http://localhost:PORT), in a real browser.
const live = new URL(process.env['LIVE'] ?? 'http://localhost:8080');
const fleet = process.env['FLEET']; // the page of a simulation of two craft, alpha and beta
const shots = process.env['SHOTS']; // a folder for pictures
const FLAGS = ['--no-sandbox', '--enable-unsafe-swiftshader', '--host-resolver-rules=MAP rebind.example 127.0.0.1'];
const PATIENCE = 30000; // ms

let browser: Browser;

before(async () => {
  browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: FLAGS });
});
after(async () => {
  await browser.close();
});

interface Opened {
  page: Page;
  complaints: string[];
}

async function open(address = live.href, colorScheme: 'light' | 'dark' = 'light', prepare?: (page: Page) => Promise<void>): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: 1100, height: 860 }, colorScheme });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  const complaints: string[] = [];
  page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
  page.on('pageerror', (error) => { complaints.push(error.message); });
  await prepare?.(page);
  await page.goto(address);
  await page.waitForSelector('.uplot');
  await waitFor(page, '.status', /^live$/);
  return { page, complaints: complaints };
}

async function textOf(page: Page, selector: string): Promise<string> {
  return (await page.locator(selector).first().textContent()) ?? '';
}

async function waitFor(page: Page, selector: string, wanted: RegExp): Promise<void> {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const text = await textOf(page, selector);
    if (wanted.test(text)) return;
    if (Date.now() > end) throw new Error(`${selector} says ${text}, not ${String(wanted)}`);
    await page.waitForTimeout(30);
  }
}

async function clockOf(page: Page): Promise<number> {
  const parts = (await textOf(page, '.run .clock')).replace(' s', '').split(':').map(Number);
  return parts.reduce((sum, part) => 60 * sum + part, 0);
}

async function waitForClock(page: Page, holds: (time: number) => boolean): Promise<number> {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const time = await clockOf(page);
    if (holds(time)) return time;
    if (Date.now() > end) throw new Error(`the clock stands at ${time}`);
    await page.waitForTimeout(30);
  }
}

/** The forward speed that the legend of the first plot shows, m/s. */
async function speedOf(page: Page): Promise<number> {
  return Number((await textOf(page, '.panel .u-series:nth-child(2) .u-value')).replace('\u2212', '-'));
}

async function waitForSpeed(page: Page, holds: (speed: number) => boolean): Promise<void> {
  const end = Date.now() + PATIENCE;
  while (!holds(await speedOf(page))) {
    if (Date.now() > end) throw new Error(`the speed is ${await speedOf(page)}`);
    await page.waitForTimeout(30);
  }
}

async function takeHelm(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Take the helm' }).click();
  await waitFor(page, '.who', /^You drive/);
}

async function reset(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Reset' }).click();
  await waitForClock(page, (time) => time < 2);
}

async function close(...pages: Opened[]): Promise<void> {
  for (const { page, complaints } of pages) {
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
}

test('the page opens light and dark, and time goes on', async () => {
  for (const scheme of ['light', 'dark'] as const) {
    const opened = await open(live.href, scheme);
    const { page } = opened;
    const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(background === 'rgb(13, 17, 22)', scheme === 'dark', background);
    assert.ok((await page.locator('.view canvas').count()) >= 3);
    const time = await clockOf(page);
    await waitForClock(page, (now) => now > time + 0.5);
    assert.equal(await textOf(page, '.who'), 'Nobody drives hovercraft');
    assert.ok(await page.locator('.control input').first().isDisabled());
    await close(opened);
  }
});

test('keys drive, and the craft stops being pushed when they are let go', async () => {
  const opened = await open();
  const { page } = opened;
  await reset(page);
  await page.keyboard.press('w'); // nobody at the helm: nothing
  await takeHelm(page);
  await page.keyboard.down('w');
  await waitForSpeed(page, (speed) => speed > 0.8);
  await page.keyboard.down('a');
  await waitFor(page, '.panel:nth-of-type(2) .u-series:nth-child(4) .u-value', /^0\.[1-9]|^[1-9]/); // yaw rate
  if (shots) await page.screenshot({ path: `${shots}/web.png` });
  await page.keyboard.up('w');
  await page.keyboard.up('a');
  await waitFor(page, '.panel:nth-of-type(3) .u-series:nth-child(2) .u-value', /^0(\.0+\d?)?$/); // thrust of the rear engine
  assert.match(await textOf(page, '.control .level'), /^0/);
  await close(opened);
});

test('a slider drives while it is held, and goes back when it is let go', async () => {
  const opened = await open();
  const { page } = opened;
  await reset(page);
  await takeHelm(page);
  const slider = page.locator('.control input').first();
  const box = await slider.boundingBox();
  assert.ok(box);
  const middle = box.y + box.height / 2;
  await page.mouse.move(box.x + 9, middle);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.9 * box.width, middle, { steps: 5 });
  await waitForSpeed(page, (speed) => speed > 0.6);
  await page.mouse.up();
  await waitFor(page, '.control .level', /^0/);
  await page.getByLabel('sliders stay').check();
  await slider.fill('2.25');
  await page.locator('h1').click();
  await waitFor(page, '.panel:nth-of-type(3) .u-series:nth-child(2) .u-value', /^2\.2/);
  assert.match(await textOf(page, '.control .level'), /^2\.25/);
  await page.getByRole('button', { name: 'Leave the helm' }).click();
  await waitFor(page, '.who', /^Nobody/);
  await waitFor(page, '.panel:nth-of-type(3) .u-series:nth-child(2) .u-value', /^0(\.0+\d?)?$/);
  await close(opened);
});

test('a gamepad drives while a shoulder button is held', async () => {
  const opened = await open(live.href, 'light', (page) => page.addInitScript(() => {
    const pad = { connected: true, axes: [0, -1, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 })) };
    Object.assign(window, { pad });
    navigator.getGamepads = () => [null, pad] as unknown as (Gamepad | null)[];
  }));
  const { page } = opened;
  const hold = (isHeld: boolean): Promise<void> => page.evaluate((held) => {
    const { pad } = window as unknown as { pad: { buttons: { pressed: boolean }[] } };
    if (pad.buttons[5]) pad.buttons[5].pressed = held;
  }, isHeld);
  await reset(page);
  await takeHelm(page);
  await waitFor(page, '.helm', /hold a shoulder button/);
  await hold(true);
  await waitForSpeed(page, (speed) => speed > 0.5);
  await hold(false);
  await waitFor(page, '.panel:nth-of-type(3) .u-series:nth-child(2) .u-value', /^0(\.0+\d?)?$/);
  await close(opened);
});

test('it pauses, steps, resets with a seed, and goes on at another pace', async () => {
  const opened = await open();
  const { page } = opened;
  await page.keyboard.press('Space');
  await waitFor(page, '.reached', /^paused$/);
  await page.waitForTimeout(300);
  const paused = await clockOf(page);
  await page.getByLabel('steps').fill('500');
  await page.getByRole('button', { name: 'Step' }).click();
  await waitForClock(page, (time) => Math.abs(time - paused - 0.5) < 0.015);
  await page.getByLabel('seed').fill('42');
  await page.getByRole('button', { name: 'Reset' }).click();
  await waitFor(page, '.notes', /reset the run, seed 42/);
  await waitForClock(page, (time) => time < 0.1);
  await page.getByLabel('real-time factor').selectOption('5');
  await page.getByRole('button', { name: 'resume' }).click();
  await waitForClock(page, (time) => time > 3);
  await page.getByLabel('real-time factor').selectOption('1');
  await waitFor(page, '.notes', /set the real-time factor to 1/);
  await close(opened);
});

test('two viewers, one driver, who is named', async () => {
  const [first, second] = [await open(), await open()];
  await first.page.getByLabel('your name').fill('<img src=x onerror=x>');
  await first.page.getByLabel('your name').press('Enter');
  await takeHelm(first.page);
  await waitFor(second.page, '.who', /^<img src=x onerror=x> drives hovercraft$/);
  assert.equal(await second.page.locator('.who img, .notes img').count(), 0);
  assert.ok(await second.page.getByRole('button', { name: 'Take the helm' }).isDisabled());
  await waitFor(second.page, '.chip:nth-of-type(2)', /^2 viewers$/);
  await close(first);
  await waitFor(second.page, '.who', /^Nobody drives/);
  await takeHelm(second.page);
  await close(second);
});

test('two craft have a driver each, who moves only his own', async () => {
  assert.ok(fleet);
  const [first, second] = [await open(fleet), await open(fleet)];
  await second.page.getByRole('button', { name: 'beta' }).click();
  await waitFor(second.page, '.who', /^Nobody drives beta$/);
  await takeHelm(first.page);
  await takeHelm(second.page);
  await second.page.keyboard.down('w');
  await waitForSpeed(second.page, (speed) => speed > 0.5);
  assert.equal(await speedOf(first.page), 0); // alpha's
  await first.page.getByRole('button', { name: 'beta' }).click();
  await waitFor(first.page, '.who', /drives beta$/);
  assert.ok(await first.page.getByRole('button', { name: 'Take the helm' }).isDisabled());
  await waitForSpeed(first.page, (speed) => speed > 0.5);
  if (shots) await first.page.screenshot({ path: `${shots}/fleet.png` });
  await second.page.keyboard.up('w');
  await close(first, second);
});

/** A door to the server that can be shut. */
class Door {
  private readonly open = new Set<Socket>();
  private readonly server: Server;
  isShut = false;

  constructor() {
    this.server = createServer((inside) => {
      if (this.isShut) {
        inside.destroy();
        return;
      }
      const outside = connect(Number(live.port), '127.0.0.1');
      for (const [from, to] of [[inside, outside], [outside, inside]] as const) {
        this.open.add(from);
        from.pipe(to);
        from.on('error', () => to.destroy());
        from.on('close', () => { this.open.delete(from); to.destroy(); });
      }
    });
  }
  async listen(): Promise<string> {
    await new Promise<void>((done) => this.server.listen(0, '127.0.0.1', done));
    return `http://localhost:${(this.server.address() as AddressInfo).port}/`;
  }
  shut(): void {
    this.isShut = true;
    for (const socket of this.open) socket.destroy();
  }
  close(): void {
    this.shut();
    this.server.close();
  }
}

test('a lost connection stops the craft, is said, and comes back with the helm', async () => {
  const door = new Door();
  const driver = await open(await door.listen());
  const other = await open();
  await reset(other.page);
  await takeHelm(driver.page);
  await driver.page.keyboard.down('w');
  await waitForSpeed(other.page, (speed) => speed > 0.5);
  door.shut();
  await waitFor(driver.page, '.status', /connection lost|connecting/);
  await waitFor(other.page, '.who', /^Nobody/);
  await waitFor(other.page, '.panel:nth-of-type(3) .u-series:nth-child(2) .u-value', /^0(\.0+\d?)?$/);
  if (shots) await driver.page.screenshot({ path: `${shots}/lost.png` });
  door.isShut = false;
  await waitFor(driver.page, '.status', /^live$/);
  await waitFor(driver.page, '.who', /^You drive/);
  const time = await clockOf(driver.page);
  await waitForClock(driver.page, (now) => now > time + 0.3);
  await driver.page.keyboard.up('w');
  // A browser says on its console that a connection failed.
  driver.complaints.splice(0, Infinity, ...driver.complaints.filter((text) => !text.includes('WebSocket')));
  await close(driver, other);
  door.close();
});

test('a page of another site, and one whose name was made to lead here, get nothing', async () => {
  const foreign = createHttpServer((_, response) => {
    response.setHeader('Content-Type', 'text/html');
    response.end('<!doctype html><title>foreign</title>');
  });
  await new Promise<void>((done) => foreign.listen(0, '127.0.0.1', done));
  const page = await browser.newPage();
  await page.goto(`http://localhost:${(foreign.address() as AddressInfo).port}/`);
  const outcomes = await page.evaluate(async (port) => {
    const socket = (host: string): Promise<string> => new Promise((done) => {
      const wire = new WebSocket(`ws://${host}:${port}/socket`);
      wire.onopen = () => { done('open'); };
      wire.onerror = () => { done('refused'); };
    });
    const read = (path: string): Promise<string> => fetch(`http://localhost:${port}${path}`).then(() => 'read', () => 'refused');
    const blind = (path: string): Promise<string> => fetch(`http://localhost:${port}${path}`, { mode: 'no-cors' }).then(() => 'read', () => 'refused');
    const script = (): Promise<string> => new Promise((done) => {
      const made = document.createElement('script');
      made.onload = () => { done('ran'); };
      made.onerror = () => { done('refused'); };
      made.src = `http://localhost:${port}/report.js`;
      document.head.append(made);
    });
    return [await socket('localhost'), await socket('127.0.0.1'), await read('/'), await blind('/'), await script()];
  }, live.port);
  assert.deepEqual(outcomes, Array<string>(5).fill('refused'));
  const framed = await page.evaluate((address) => new Promise<string>((done) => {
    const frame = document.createElement('iframe');
    frame.onload = () => {
      try {
        done(frame.contentDocument?.title ?? 'hidden');
      } catch {
        done('hidden');
      }
    };
    frame.src = address;
    document.body.append(frame);
  }), live.href);
  assert.equal(framed, 'hidden');
  const answer = await page.goto(`http://rebind.example:${live.port}/`);
  assert.equal(answer?.status(), 403);
  await page.close();
  foreign.close();
});
