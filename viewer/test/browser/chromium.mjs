// Debian's chromium without display or graphics card, with its own profile.
import { chromium } from 'playwright-core';

const kFlags = [
  '--no-sandbox',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** `faults` collects errors of the page and every request to another server than `address`. */
export async function openBrowser(profile, address, viewport) {
  const phone = viewport.width < 600;
  const browser = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: kFlags,
    viewport,
    isMobile: phone,
    hasTouch: phone,
    deviceScaleFactor: Number(process.env.VIEWER_SCALE ?? 1),
  });
  const page = browser.pages()[0] ?? (await browser.newPage());
  const faults = [];
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => {
    // While the server is down, the browser itself reports every attempt to connect.
    if (message.type() === 'error' && !/ERR_CONNECTION|WebSocket connection/.test(message.text())) faults.push(message.text());
  });
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(blob|data):/.test(url)) faults.push(`request to ${url}`);
  });
  page.setDefaultTimeout(30_000);
  await page.goto(address);
  return { browser, page, faults };
}
