// The pages of real shells, opened from disk in a real browser.
//
// Usage: node page_test.mjs NPM_FOLDER TRIVALENT CHROMIUM FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openPage, picture, startBrowser } from './browser.mjs';

const [npmFolder, program, chromium, folder] = process.argv.slice(2);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const at = (name) => join(folder, name);
const trivalent = (...words) => execFileSync(program, [...words, '--json'], { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
const json = (text) => JSON.parse(text);

const browser = await startBrowser(npmFolder, chromium);
let failures = 0;
async function test(name, body) {
  try {
    await body();
    console.log(`passed: ${name}`);
  } catch (error) {
    failures += 1;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
}

/** What must hold of every page, whatever it shows. */
async function checkPage({ page, complaints, requests }) {
  const shown = await picture(page);
  assert.ok(shown.colors > 20, `only ${shown.colors} colors on the canvas`);
  assert.ok(shown.covered > 0.005, 'the canvas is blank');
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests(), []);
  const layout = await page.evaluate(() => {
    const box = (id) => document.getElementById(id).getBoundingClientRect();
    return { legend: box('legend'), compare: box('compare'), header: box('title'), sideways: document.documentElement.scrollWidth - innerWidth };
  });
  assert.ok(layout.sideways <= 0, `the page is ${layout.sideways} pixels too wide`);
  const { legend, compare } = layout;
  const apart = compare.width === 0 || legend.right <= compare.left || compare.right <= legend.left
    || legend.bottom <= compare.top || compare.bottom <= legend.top;
  assert.ok(apart, 'legend and slider overlap');
}

/** Its dual is C20, the smallest fullerene. */
function icosahedron() {
  const phi = (1 + Math.sqrt(5)) / 2;
  const points = [-1, 1].flatMap((a) => [-phi, phi].flatMap((b) => [[0, a, b], [a, b, 0], [b, 0, a]]));
  const isEdge = (p, q) => Math.abs(Math.hypot(...p.map((x, i) => x - q[i])) - 2) < 1e-9;
  const faces = [];
  points.forEach((p, i) => points.forEach((q, j) => points.forEach((r, k) => {
    if (!(i < j && i < k && isEdge(p, q) && isEdge(q, r) && isEdge(r, p))) return;
    const volume = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    if (volume > 0) faces.push([3, i, j, k]); // counter-clockwise seen from outside
  })));
  return `OFF\n${points.length} ${faces.length} 0\n${[...points, ...faces].map((row) => row.join(' ')).join('\n')}\n`;
}

const textOf = (page, selector) => page.locator(selector).innerText();

trivalent('build', 'double-torus', '--atoms', '20000', '-o', 'shell', '--method', 'paper', '--iterations', '8', '--digits', '17');
const report = json(readFileSync(at('shell/report.json'), 'utf8'));

await test('a report of 20,000 atoms', async () => {
  const opened = await openPage(browser, at('shell/report.html'));
  const { page } = opened;
  await checkPage(opened);

  // The legend is report.json's color scale.
  const ends = await page.locator('#legend input').evaluateAll((inputs) => inputs.map((input) => Number(input.value)));
  const { low, high } = report.energy.scale;
  const isShown = (text, value) => Math.abs(text - value) <= 5e-6 * Math.abs(value); // six digits
  assert.ok(isShown(ends[0], low) && isShown(ends[1], high), `${ends} for ${low}, ${high}`);

  // A range that is typed holds, and another one can be typed after it.
  for (const typed of [high + 0.1, high + 0.2]) {
    await page.locator('#legend input').last().fill(String(typed));
    await page.keyboard.press('Tab');
    const shown = await page.evaluate(() => window.trivalent.scale.high);
    assert.ok(Math.abs(shown - typed) < 1e-9, `${shown} for ${typed}`);
  }
  assert.deepEqual(opened.complaints, []);

  // The worst atom's row leads to it.
  const [worst] = json(trivalent('energy', 'shell/shell.extxyz')).worst;
  await page.locator('#worst button').first().click();
  assert.equal(await textOf(page, '#atom h2'), `Atom ${worst.id}`);
  const details = await textOf(page, '#atom');
  assert.ok(details.includes(worst.energy.toFixed(3).replace('-', '−').slice(0, -1)), details);
  assert.ok(Math.abs(worst.energy - report.energy.after.highest) < 1e-8);
  await page.waitForTimeout(1000);
  await checkPage(opened);

  // The divider brings the state before into view.
  await page.keyboard.press('0');
  const after = await picture(page);
  await page.locator('#divider-place').fill('1000');
  await page.waitForFunction(() => window.trivalent.view.left !== null);
  await page.waitForTimeout(1500);
  const before = await picture(page);
  assert.notEqual(before.hash, after.hash);
  await page.locator('#divider-place').fill('0');

  // A saved picture is a PNG.
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#screenshot').click()]);
  await download.saveAs(at('saved.png'));
  assert.equal(readFileSync(at('saved.png')).subarray(1, 4).toString(), 'PNG');
  assert.ok(statSync(at('saved.png')).size > 10000);

  // What the program printed stands in the page.
  const panel = await page.locator('#panel').evaluate((node) => node.textContent);
  for (const text of ['hexagons', 'edge length', '--atoms'.slice(2), '20000']) assert.ok(panel.includes(text), text);
  for (const note of report.notes) assert.ok(panel.includes(note), note);
  assert.deepEqual(opened.complaints, []);
  await page.close();
});

await test('selections, colorings and keys', async () => {
  const opened = await openPage(browser, at('shell/report.html'), { theme: 'dark' });
  const { page } = opened;
  const whole = await picture(page);
  const rings = page.locator('.histogram canvas').nth(2);
  const box = await rings.boundingBox();
  const sizes = await page.evaluate(() => window.trivalent.histograms[2].labels);
  await rings.click({ position: { x: ((sizes.indexOf('5') + 0.5) * box.width) / sizes.length, y: 40 } });
  const pentagons = report.network.ring_sizes['5'];
  const selected = await textOf(page, '#selection');
  const number = Number(selected.replace(/,/g, '').match(/^(\d+) atoms/)[1]);
  assert.ok(number <= 5 * pentagons && number >= pentagons, selected);
  assert.notEqual((await picture(page)).hash, whole.hash);

  // No atom of a closed shell has fewer than three bonds: an empty selection says so.
  await page.locator('#coloring').selectOption('coordination');
  const first = page.locator('.histogram canvas').first();
  await first.click({ position: { x: 5, y: 40 } });
  assert.match(await textOf(page, '#selection'), /^No atoms selected/);
  assert.ok((await picture(page)).colors > 2);
  await page.locator('#clear').click();

  for (const name of await page.locator('#coloring option').evaluateAll((options) => options.map(({ value }) => value))) {
    await page.locator('#coloring').selectOption(name);
    await checkPage(opened);
  }
  await page.locator('#canvas').focus();
  let last = await picture(page);
  for (const key of ['ArrowLeft', 'ArrowUp', '+', 'r', 's', 't', '.', 'w']) {
    await page.keyboard.press(key);
    await page.waitForTimeout(700);
    const now = await picture(page);
    assert.notEqual(now.hash, last.hash, `key ${key} changed nothing`);
    last = now;
  }
  await page.keyboard.press('?');
  assert.ok(await page.locator('#help').isVisible());
  await page.keyboard.press('Escape');

  const { x, y } = await page.evaluate(() => {
    const { view } = window.trivalent;
    view.reset();
    for (let step = 0; step < 200; ++step) {
      const place = { x: view.width / 2, y: (view.height * (step + 0.5)) / 200 };
      if (view.atomAt(place.x, place.y) >= 0) return place;
    }
    return null;
  });
  await page.mouse.click(x, y);
  assert.match(await textOf(page, '#atom h2'), /^Atom \d+$/);
  await page.mouse.move(x + 1, y);
  await page.waitForFunction(() => getComputedStyle(document.getElementById('hover')).display === 'block');
  assert.deepEqual(opened.complaints, []);
  await page.close();
});

await test('a narrow screen', async () => {
  for (const theme of ['light', 'dark']) {
    const opened = await openPage(browser, at('shell/report.html'), { width: 390, height: 800, theme });
    await checkPage(opened);
    await opened.page.close();
  }
});

await test('small, open, periodic and hydrogenated atoms', async () => {
  trivalent('shape', 'sphere', 'ball.off', '--edge', '0.3');
  writeFileSync(at('C20.off'), icosahedron());
  trivalent('build', 'wavy-sheet', '--atoms', '1500', '--effort', 'quick', '-o', 'open');
  writeFileSync(at('methane.xyz'), '5\n\nC 0 0 0\nH .63 .63 .63\nH -.63 -.63 .63\nH -.63 .63 -.63\nH .63 -.63 -.63\n');
  writeFileSync(at('one.xyz'), '1\n\nC 0 0 0\n');
  writeFileSync(at('graphene.extxyz'), '4\nLattice="2.46 0 0 0 4.26 0 0 0 20" Properties=species:S:1:pos:R:3 pbc="T T F"\n'
    + 'C 0 0 0\nC 0 1.42 0\nC 1.23 2.13 0\nC 1.23 3.55 0\n');
  for (const name of ['methane.xyz', 'one.xyz', 'graphene.extxyz', 'ball.off', 'C20.off']) trivalent('view', name, '-o', `${name}.html`);
  for (const name of ['C20.off.html', 'open/report.html', 'methane.xyz.html', 'one.xyz.html', 'graphene.extxyz.html', 'ball.off.html']) {
    const opened = await openPage(browser, at(name));
    await checkPage(opened);
    await opened.page.locator('#worst button').first().click();
    assert.match(await textOf(opened.page, '#atom h2'), /^Atom \d+$/, name);
    await opened.page.close();
  }
});

await test('names that look like HTML are text', async () => {
  const name = "<img src=x onerror=document.title='owned'>.off";
  const title = "</script><script>document.title='owned'</script><!--";
  trivalent('shape', 'sphere', 'plain.off', '--edge', '0.5');
  writeFileSync(at(name), readFileSync(at('plain.off')));
  trivalent('build', name, '--atoms', '200', '--effort', 'quick', '-o', 'named');
  trivalent('view', name, 'plain.off', '-o', 'titled.html', '--title', title);
  for (const [path, heading] of [['named/report.html', name], ['titled.html', title]]) {
    const opened = await openPage(browser, at(path));
    await checkPage(opened);
    assert.equal(await textOf(opened.page, '#title'), heading);
    assert.ok(!(await opened.page.title()).startsWith('owned'));
    assert.equal(await opened.page.locator('img').count(), 0);
    await opened.page.close();
  }
});

await browser.close();
console.log(failures === 0 ? 'all passed' : `${failures} failed`);
process.exit(failures === 0 ? 0 : 1);
