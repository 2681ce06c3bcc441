// Debian's chromium without a display or a graphics card, with a profile of its own.
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

/** `faults` collects what the page complains of, and every request that leaves the server of `address`. */
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
    // While the server is away the browser itself reports every attempt to reach it.
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
