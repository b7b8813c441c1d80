// Headless Chromium that opens pages from disk and reports everything they complain about.
import { mkdtempSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

export async function startBrowser(npmFolder, chromium) {
  const { chromium: driver } = createRequire(join(npmFolder, 'package.json'))('playwright-core');
  const profile = mkdtempSync(join(tmpdir(), 'trivalent-browser-'));
  return driver.launchPersistentContext(profile, {
    executablePath: chromium,
    headless: true,
    acceptDownloads: true,
    args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
      '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
}

/** Opens a page from disk and waits for the shell; complaints and requests are listed. */
export async function openPage(browser, path, { width = 1280, height = 800, theme = 'light' } = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(120000);
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme: theme });
  const complaints = [];
  const requests = [];
  page.on('console', (message) => {
    // Software rendering says that reading its pixels is slow.
    const isAboutSpeed = message.text().includes('GPU stall due to ReadPixels');
    if (['error', 'warning'].includes(message.type()) && !isAboutSpeed) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('dialog', (dialog) => { complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => requests.push(request.url()));
  const url = pathToFileURL(path).href;
  const begin = performance.now();
  await page.goto(url, { waitUntil: 'commit' });
  await page.waitForFunction(() => document.documentElement.dataset.ready === 'true');
  return { page, complaints, requests: () => requests.filter((each) => each !== url && !each.startsWith('blob:')),
    milliseconds: performance.now() - begin };
}

/** The canvas as its number of colors and a text that changes with the picture. */
export function picture(page) {
  return page.evaluate(() => {
    const { view } = window.trivalent;
    view.draw();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [view.canvas.width, view.canvas.height];
    const pen = copy.getContext('2d');
    pen.drawImage(view.canvas, 0, 0);
    const pixels = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    const colors = new Map();
    let hash = 0;
    for (const pixel of pixels) {
      colors.set(pixel, (colors.get(pixel) ?? 0) + 1);
      hash = (Math.imul(hash, 31) + pixel) | 0;
    }
    let most = 0;
    for (const number of colors.values()) most = Math.max(most, number);
    return { colors: colors.size, covered: 1 - most / pixels.length, hash };
  });
}
