// The built page in a real browser, served by the real program MMS_PROGRAM. Screenshots are written to VIEWER_PICTURES
// if that is set.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser } from './chromium.mjs';
import { countPixels, eventually } from './pixels.mjs';
import { freePort, makeRun, Server } from './program.mjs';

/** Just wide enough for all panels: the CPU renders the page. */
const kDesktop = process.env.VIEWER_PICTURES ? { width: 1440, height: 900 } : { width: 1000, height: 660 };
const kPhone = { width: 390, height: 844 };
/** Share of light pixels that only a map reaches. */
const kMap = 0.08;

let folder, run, server, browser, page, faults;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'mms-viewer-'));
  run = process.env.VIEWER_RUN ?? makeRun(folder);
  server = new Server(run, await freePort());
  await server.start();
  ({ browser, page, faults } = await openBrowser(join(folder, 'desktop'), server.address, kDesktop));
});

after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(folder, { recursive: true, force: true });
});

const scene = () => page.locator('#scene');
const pixels = () => countPixels(page, scene());
const frame = async () => Number(/frame (\d+)/.exec(await page.textContent('.frames'))?.[1] ?? 0) - 1;
const image = () => countPixels(page, page.locator('#image'));
const pill = () => page.textContent('#connection');

/** The run may end before the click, which then starts it again: only a title that stays counts. */
async function pause() {
  let calm = 0;
  const stay = async () => {
    const title = await page.locator('.play').getAttribute('title');
    calm = title && !title.startsWith('Pause') ? calm + 1 : 0;
    if (title?.startsWith('Pause')) await page.locator('.play').click();
    return calm;
  };
  await eventually('pausing', stay, (times) => times >= 5);
}

/** Clicks the slider at a share of its length. */
async function scrub(share) {
  const box = await page.locator('#scrub').boundingBox();
  await page.mouse.click(box.x + 8 + share * (box.width - 16), box.y + box.height / 2);
}

/** Waits for a frame and for its picture, which follows after decoding. */
function arrive(what, accept) {
  const pictured = async () => Number((await page.locator('#image').getAttribute('data-frame')) ?? -1);
  const shown = async () => ({ number: await frame(), picture: await pictured() });
  return eventually(what, shown, ({ number, picture }) => number === picture && accept(number)).then(({ number }) => number);
}

async function show(layer, wanted) {
  const button = page.locator(`[data-layer=${layer}]`);
  if ((await button.getAttribute('aria-checked')) !== String(wanted)) await button.click();
}

async function keepPicture(name) {
  if (!process.env.VIEWER_PICTURES) return;
  await page.waitForTimeout(6000);
  await page.screenshot({ path: join(process.env.VIEWER_PICTURES, `${name}.jpg`), quality: 85, type: 'jpeg' });
}

/** The frame with the most objects. */
function busiestFrame() {
  const stamps = readFileSync(join(run, 'trajectory.tum'), 'utf8').split('\n').filter((line) => /^\d/.test(line)).map((line) => line.split(' ')[0]);
  const seen = new Map(stamps.map((stamp) => [stamp, 0]));
  for (const { history } of JSON.parse(readFileSync(join(run, 'objects.json'), 'utf8')).tracks) {
    for (const { stamp } of history) seen.set(stamp, seen.get(stamp) + 1);
  }
  const counts = [...seen.values()];
  assert.ok(Math.max(...counts) > 0, 'the run has no objects to draw');
  return { index: counts.lastIndexOf(Math.max(...counts)), last: stamps.length - 1 };
}

test('the page loads and connects', async () => {
  await eventually('connecting', pill, (text) => text === 'Connected');
  assert.match(await page.title(), /MMS-SLAM/);
  await eventually('the first frame', frame, (number) => number >= 0);
  await pause();
  assert.equal(await page.locator('#notice').isVisible(), false);
});

test('the slider moves the pose, the image and the charts', async () => {
  const { index, last } = busiestFrame();
  await scrub(0.1);
  const early = await arrive('an early frame', (number) => number < 0.3 * last);
  const imageBefore = (await image()).sum;
  const sceneBefore = (await pixels()).sum;
  await scrub(index / last);
  await arrive('the busiest frame', (number) => Math.abs(number - index) <= 1 && number !== early);
  assert.notEqual((await image()).sum, imageBefore, 'another image');
  await eventually('another view', pixels, ({ sum }) => sum !== sceneBefore);
  assert.ok((await page.locator('.chart canvas').count()) >= 3, 'charts are drawn');
});

test('draws points and boxes, and switches every layer', async () => {
  const full = await eventually('the map', pixels, ({ lit, all }) => lit > kMap * all);
  for (const layer of ['scan', 'trails', 'labels', 'trajectory', 'truth', 'camera', 'grid']) await show(layer, false);
  await show('map', false);
  const boxes = await eventually('only boxes of people and vehicles', pixels, ({ lit, red, green, all }) => red > 80 && green > 80 && lit < kMap * all);
  await show('boxes', false);
  await eventually('no boxes', pixels, ({ red, green }) => red < 0.1 * boxes.red && green < 0.1 * boxes.green);
  await show('map', true);
  const own = await eventually('the map again', pixels, ({ lit }) => lit > 0.5 * full.lit);
  await show('heights', true);
  await eventually('the map by height', pixels, ({ red, green }) => red > own.red + 0.001 * full.all && green > own.green + 0.005 * full.all);
  await show('heights', false);
  await eventually('the map in its colors', pixels, ({ green }) => green <= own.green + 0.001 * full.all);
  for (const layer of ['scan', 'trails', 'labels', 'trajectory', 'truth', 'camera', 'grid', 'boxes']) await show(layer, true);
  await eventually('boxes again', pixels, ({ red, green }) => red > 0.3 * boxes.red && green > 0.3 * boxes.green);
  const masked = await image();
  await page.keyboard.press('k');
  await eventually('the image without masks', image, ({ sum }) => sum !== masked.sum);
  await page.keyboard.press('k');
});

test('the camera has views from behind, the side and above', async () => {
  const sums = new Set([(await pixels()).sum]);
  for (const key of ['2', '3']) {
    await page.keyboard.press(key);
    const { sum } = await eventually('another view', pixels, (count) => !sums.has(count.sum) && count.lit > 0.02 * count.all);
    sums.add(sum);
  }
  await keepPicture('viewer_top');
  await page.keyboard.press('1');
  await eventually('the first view again', pixels, ({ lit, all }) => lit > kMap * all);
  await keepPicture('viewer_desktop');
});

test('plays, steps, and plays again at the end', async () => {
  await page.keyboard.press('Home');
  await eventually('the first frame', frame, (number) => number === 0);
  await page.keyboard.press('ArrowRight');
  await eventually('the next frame', frame, (number) => number === 1);
  await page.selectOption('#speed', '8');
  await page.locator('.play').click();
  const { last } = busiestFrame();
  await eventually('the last frame', frame, (number) => number === last);
  await page.getByTitle(/^Replay/).waitFor();
});

test('saves the picture, the map and the trajectory', async () => {
  const [picture] = await Promise.all([page.waitForEvent('download'), page.locator('#screenshot').click()]);
  assert.match(picture.suggestedFilename(), /\.png$/);
  assert.equal(readFileSync(await picture.path()).subarray(1, 4).toString(), 'PNG');
  for (const file of ['static_map.ply', 'trajectory.tum']) {
    await page.locator('#downloads > button').click();
    const link = page.locator(`#downloads a[download="${file}"]`);
    const [saved] = await Promise.all([page.waitForEvent('download'), link.click()]);
    assert.deepEqual(readFileSync(await saved.path()), readFileSync(join(run, file)));
  }
});

test('reports a lost server and resumes after reconnecting', async () => {
  await scrub(0.5);
  const before = await eventually('a frame in between', frame, (number) => number > 5 && number < busiestFrame().last);
  await pause();
  await server.stop();
  await eventually('losing the server', pill, (text) => text === 'Offline');
  assert.match(await page.textContent('#notice'), /Connection lost/);
  await server.start();
  await eventually('the server again', pill, (text) => text === 'Connected');
  await eventually('the former frame', frame, (number) => number === before);
  // The server begins every connection playing; the page's commands to pause and seek follow.
  await eventually('a pause as before', () => page.locator('.play').getAttribute('title'), (title) => title.startsWith('Play'));
  assert.equal(await frame(), before, 'it stays paused');
  await eventually('the map again', pixels, ({ lit, all }) => lit > kMap * all);
});

test('the page has no errors and no foreign requests', () => {
  assert.deepEqual(faults, []);
});

test('says what is missing in a browser without WebGL', async () => {
  const without = await browser.newPage();
  await without.addInitScript(() => {
    const real = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith('webgl') ? null : real.call(this, kind, ...rest);
    };
  });
  await without.goto(server.address);
  await eventually('the notice', () => without.textContent('#notice'), (text) => /no WebGL 2/.test(text));
  assert.equal(await without.textContent('#connection'), 'Stopped');
  await without.close();
});

test('counts frames from 1 and says that an image is loading', async () => {
  await pause();
  await scrub(1);
  await eventually('the last frame', () => page.textContent('.frames'), (text) => /^frame (\d+) of \1$/.test(text));
  const early = await browser.newPage();
  await early.addInitScript(() => {
    window.createImageBitmap = () => new Promise(() => {}); // images never arrive
  });
  await early.goto(server.address);
  await eventually('the text', () => early.textContent('#image-empty'), (text) => text === 'Loading image');
  await early.close();
});

test('the page fits a phone', async () => {
  await browser.close();
  ({ browser, page, faults } = await openBrowser(join(folder, 'phone'), server.address, kPhone));
  await eventually('the first frame', frame, (number) => number >= 0);
  await pause();
  const { index, last } = busiestFrame();
  await scrub(index / last);
  await eventually('the map', pixels, ({ lit, all }) => lit > kMap * all);
  await eventually('an image', image, ({ lit }) => lit > 1000);
  await keepPicture('viewer_phone');
  for (const tab of ['charts', 'objects', 'layers', 'image']) {
    await page.locator(`[data-tab=${tab}]`).last().tap();
    assert.equal(await page.locator(`[data-panel=${tab}]`).isVisible(), true, tab);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${tab} is ${wide} pixels too wide`);
  }
  assert.deepEqual(faults, []);
});
