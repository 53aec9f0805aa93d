// Drives Debian's Chromium through the page of a report: node drive.mjs PAGE FOLDER. Screenshots go to FOLDER; exit code 1 with the reason
// where the page does not do what docs/report.md says of it.
import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const [file, folder] = process.argv.slice(2);
const browser = await launch();

async function open(colorScheme) {
  const page = await browser.newPage({ colorScheme, viewport: { width: 1280, height: 900 } });
  page.setDefaultTimeout(300_000);
  page.on('pageerror', error => { throw error; });
  page.on('request', request => assert.match(request.url(), /^(file|data|blob):/, 'the page needs another file'));
  await page.goto(pathToFileURL(file).href);
  await page.locator('#pictures button[aria-pressed=true]').waitFor();
  return page;
}

const page = await open('light');
const shown = () => page.locator('#pictures button[aria-pressed=true]').evaluate(button => button.firstChild.data.trim());
const pressed = id => page.locator(id).getAttribute('aria-pressed');
const stage = () => page.locator('#stage').evaluate(canvas => canvas.toDataURL());

// A scene that fails opens with its causes; each key shows its picture.
assert.equal(await shown(), 'causes');
const pictures = new Map();
for (const [key, name] of [['1', 'gpu'], ['2', 'twin'], ['3', 'reference'], ['4', 'golden'], ['d', 'difference'], ['c', 'causes']]) {
  await page.keyboard.press(key);
  assert.equal(await shown(), name);
  pictures.set(name, await stage());
}
assert.equal(pictures.get('twin'), pictures.get('reference'), 'the fault is on the GPU\'s side alone');
assert.equal(new Set(pictures.values()).size, 5);

// Heat by the slider.
await page.keyboard.press('d');
await page.locator('#exposure').fill('4');
assert.notEqual(await stage(), pictures.get('difference'));
await page.locator('#exposure').fill('0');
assert.equal(await stage(), pictures.get('difference'));

// Split: half of one picture beside half of another, and a bar that is dragged. Blink: one, then the other.
await page.keyboard.press('1');
await page.keyboard.press('s');
assert.equal(await pressed('#split'), 'true');
const half = await stage();
assert.notEqual(half, pictures.get('gpu'));
await page.locator('#stage').scrollIntoViewIfNeeded();
const box = await page.locator('#stage').boundingBox();
const middle = [box.x + box.width / 2, box.y + box.height / 2];
await page.mouse.move(...middle);
await page.mouse.down();
await page.mouse.move(middle[0] + box.width / 4, middle[1], { steps: 4 });
await page.mouse.up();
assert.notEqual(await stage(), half);
await page.keyboard.press('b');
assert.equal(await pressed('#blink'), 'true');
assert.equal(await pressed('#split'), 'false');
await page.waitForFunction(seen => document.getElementById('stage').toDataURL() === seen, pictures.get('reference'));
await page.waitForFunction(seen => document.getElementById('stage').toDataURL() === seen, pictures.get('gpu'));
await page.keyboard.press('b');

// Zoom by keys and the wheel, move by dragging, and back.
const fitted = await stage();
await page.keyboard.press('+');
const zoomed = await stage();
assert.notEqual(zoomed, fitted);
await page.mouse.move(...middle);
await page.mouse.down();
await page.mouse.move(middle[0] - 60, middle[1] + 30, { steps: 4 });
await page.mouse.up();
assert.notEqual(await stage(), zoomed);
await page.mouse.wheel(0, -240);
await page.keyboard.press('0');
assert.equal(await stage(), fitted);

// A pixel under the pointer, and one that a click holds.
const readout = page.locator('#pixel');
await page.mouse.move(...middle);
assert.match(await readout.textContent(), /^pixel \d+,\d+[^]*\ngpu +sRGB [^]*\ntwin +sRGB [^]*\nreference +sRGB [^]*\ngolden +sRGB /);
await page.mouse.click(...middle);
const held = await readout.textContent();
await page.mouse.move(middle[0] + 100, middle[1] + 50);
assert.equal(await readout.textContent(), held);

// The address is the view.
await page.keyboard.press('2');
const link = page.url();
assert.match(link, /#0,twin,one,reference$/);
await page.screenshot({ path: `${folder}/light.png` });

// Dark where the system is.
const dark = await open('dark');
const brightness = async of => (await of.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g).reduce((a, b) => a + Number(b), 0);
assert.ok(await brightness(page) > 600 && await brightness(dark) < 150);
await dark.screenshot({ path: `${folder}/dark.png` });
await browser.close();
