// Drives Debian's Chromium through the page of eyeray dev: node drive_dev.mjs ADDRESS SHADERS FOLDER. Screenshots go to FOLDER; exit code 1
// with the reason where the page does not do what docs/dev-loop.md says of it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { launch } from './browser.mjs';

const [address, shaders, folder] = process.argv.slice(2);
const browser = await launch();
const page = await browser.newPage({ colorScheme: 'light', viewport: { width: 1280, height: 900 } });
page.setDefaultTimeout(300_000);
page.on('pageerror', error => { throw error; });
page.on('console', message => assert.notEqual(message.type(), 'error', message.text()));
page.on('request', request => assert.ok(request.url().startsWith(address) || request.url().startsWith('blob:'), `the page asks for ${request.url()}`));

const body = name => page.evaluate(key => document.body.dataset[key], name);
const stage = () => page.locator('#stage').evaluate(canvas => canvas.toDataURL());
// Waits until the view's picture is complete and shown.
async function done(view) {
  await page.waitForFunction(name => {
    const { state, shown, wanted } = document.body.dataset;
    return state === 'done' && shown === wanted && shown.startsWith(name + ' ');
  }, view);
}
// Runs `action` and returns the view's next picture.
async function next(view, action) {
  const generation = await body('generation');
  await action();
  await page.waitForFunction(before => document.body.dataset.generation !== before, generation);
  await done(view);
  return stage();
}

await page.goto(address);
await done('gpu');
const first = await stage();
await page.screenshot({ path: `${folder}/light.png` });

// An edit changes the picture. A broken edit keeps the picture and reports the position; once mended, all is as before.
const pixel = `${shaders}/kernels/pixel.glsl`, good = readFileSync(pixel, 'utf8');
const with_code = code => {
  const edited = good.replace('  return sample_result(', `  ${code}\n  return sample_result(`);
  assert.notEqual(edited, good, 'the shader has changed: mend this test');
  return edited;
};
const red = await next('gpu', () => writeFileSync(pixel, with_code('color.x += 0.25f;')));
assert.notEqual(red, first);
writeFileSync(pixel, with_code('color = nonsense;'));
await page.locator('#failure:not([hidden])').waitFor();
assert.match(await page.locator('#failure').textContent(), /pixel\.glsl:\d+:\d+: error: .*nonsense/);
assert.match(await page.locator('#failure a').first().getAttribute('href'), /^vscode:\/\/file\/.*pixel\.glsl:\d+:\d+$/);
assert.equal(await stage(), red, 'the last good picture stays');
await page.screenshot({ path: `${folder}/failure.png` });
assert.equal(await next('gpu', () => writeFileSync(pixel, good)), first);
assert.ok(await page.locator('#failure').isHidden());

// Each view has a key; AOVs are in a list.
const views = new Set([first]);
for (const [key, name] of [['2', 'twin'], ['d', 'difference']]) views.add(await next(name, () => page.keyboard.press(key)));
views.add(await next('normal', () => page.locator('#aovs').selectOption('normal')));
assert.equal(views.size, 3, 'the twin is the GPU\'s picture, the difference and the normals are not');
// The twin is that of the user's shaders.
await next('twin', () => page.keyboard.press('2'));
assert.equal(await next('twin', () => writeFileSync(pixel, with_code('color.x += 0.25f;'))), red);
await next('twin', () => writeFileSync(pixel, good));
assert.equal(await next('gpu', () => page.keyboard.press('1')), first);

// Exposure and zoom change what is seen; a click shows the pixel's value and its rays.
await page.keyboard.press(']');
await done('gpu');
assert.notEqual(await stage(), first);
await page.keyboard.press('[');
await done('gpu');
await page.keyboard.press('+');
assert.notEqual(await stage(), first);
await page.keyboard.press('0');
const box = await page.locator('#stage').boundingBox();
const middle = [box.x + box.width / 2, box.y + box.height / 2];
await page.mouse.click(...middle);
await page.locator('#probe details').first().waitFor();
assert.match(await page.locator('#probe').textContent(), /gpu, twin, reference agree/);
assert.match(await page.locator('#pixel').textContent(), /^\d+,\d+ {2}[\d.]+/);

// Rays of a picture that has changed since are marked as such.
const scene_file = `${folder}/scene.toml`, scene = readFileSync(scene_file, 'utf8');
assert.ok(await page.locator('#stale').isHidden());
writeFileSync(pixel, with_code('color = nonsense;'));
await page.locator('#failure:not([hidden])').waitFor();
assert.ok(await page.locator('#stale').isHidden(), 'the picture is that of the rays');
await next('gpu', () => writeFileSync(pixel, good));
await page.mouse.click(...middle);
await page.locator('#probe details').first().waitFor();
await next('gpu', () => writeFileSync(scene_file, scene.replace(/^radius = .*$/m, 'radius = 0.5')));
assert.ok(await page.locator('#stale').isVisible());
await next('gpu', () => writeFileSync(scene_file, scene));
await page.mouse.click(...middle);
await page.locator('#stale').waitFor({ state: 'hidden' });
await page.locator('#probe details').first().waitFor();

// A constant with a control gets a slider, which compiles nothing; a value of the scene too.
const slider = name => page.locator(`#tunables input[id$="${name}"]`);
const tunable = good.replace('  return sample_result(', '  const float GLOW = 0.0f;  // @slider 0 1\n  color.y += GLOW;\n  return sample_result(');
const dark = await stage();
assert.equal(await next('gpu', () => writeFileSync(pixel, tunable)), dark);
const glowing = await next('gpu', () => slider('GLOW').fill('0.75'));
assert.notEqual(glowing, dark);
await next('gpu', () => writeFileSync(scene_file, scene.replace(/^radius = .*$/m, 'radius = 1.0  # @slider 0.25 1.5')));
const smaller = await stage();
assert.notEqual(await next('gpu', () => slider('sphere.0.radius').fill('0.5')), smaller);
assert.match(await page.locator('#tunables').textContent(), /^kernels\/pixel\.glslGLOW.*sphereradius/);
await page.screenshot({ path: `${folder}/tunables.png` });

// Two pages show the same: a control moved on one also moves on the other.
const other = await browser.newPage({ viewport: { width: 1280, height: 900 } });
await other.goto(address);
const there = name => other.locator(`#tunables input[id$="${name}"]`);
const shows = (tab, value) => tab.waitForFunction(wanted => document.getElementById('tunable sphere.0.radius').value === wanted, value);
await there('sphere.0.radius').waitFor();
await shows(other, '0.5');
assert.equal(await there('GLOW').inputValue(), '0.75');
await there('sphere.0.radius').fill('0.75');
await shows(page, '0.75');
await page.locator('#tunables label', { hasText: 'radius' }).dblclick();
await shows(other, '1');
await page.keyboard.press('w');
await other.locator('#reset:not([hidden])').waitFor();
await other.locator('#reset').click();
await page.locator('#reset').waitFor({ state: 'hidden' });
await other.close();
await done('gpu');
await next('gpu', () => writeFileSync(scene_file, scene));
await next('gpu', () => writeFileSync(pixel, good));

// The scene's warnings stand beside the picture with their positions; so does the number of pixels that may be wrong.
assert.ok(await page.locator('#warnings-panel').isHidden());
const sheets = `[[implicit]]\ncode = "float f(vec3 p) { return sin(6000.0 * p.z) + 0.5; }"\nmin = [-3, 0, -1]\nmax = [3, 2, 1]\nlipschitz = 1\nmaterial = "matte"\n`;
await next('gpu', () => writeFileSync(scene_file, scene + sheets.replace('sin(6000.0 * p.z)', 'length(p) * 2.0')));
assert.match(await page.locator('#warnings').textContent(), /scene\.toml:\d+.*warning: `lipschitz` is 1, but/);
await page.screenshot({ path: `${folder}/warnings.png` });
await next('gpu', () => writeFileSync(scene_file, scene + sheets.replace('0.5', '1.000001').replace('lipschitz = 1', 'lipschitz = 60000')));
assert.match(await page.locator('#warnings').textContent(), /^\d+ pixels may be wrong: .* ran out of steps/);
await next('gpu', () => writeFileSync(scene_file, scene));
assert.ok(await page.locator('#warnings-panel').isHidden());

// A picture by random paths can be denoised; others cannot.
assert.ok(await page.locator('#denoise').isHidden());
const by_paths = scene.replace('[render]', '[render]\nintegrator = "path"').replace('height = 48', 'height = 48\nsamples = 4');
const noisy = await next('gpu', () => writeFileSync(scene_file, by_paths));
assert.equal(await page.locator('#denoise').getAttribute('aria-pressed'), 'false');
assert.notEqual(await next('gpu', () => page.locator('#denoise').click()), noisy);
assert.match(await page.locator('#times').textContent(), /; denoised, remaining noise [\d.]+\u00a0%$/);
assert.equal(await next('gpu', () => page.keyboard.press('n')), noisy);
await next('gpu', () => writeFileSync(scene_file, scene));

// The camera orbits its target, and returns.
await page.keyboard.press('o');
await page.mouse.move(...middle);
await page.mouse.down();
const turned = await next('gpu', () => page.mouse.move(middle[0] + 150, middle[1] - 40, { steps: 3 }));
await page.mouse.up();
await done('gpu');
await next('gpu', () => page.keyboard.press('r'));
assert.notEqual(turned, await stage());

// Narrow and dark.
await page.setViewportSize({ width: 390, height: 844 });
await page.emulateMedia({ colorScheme: 'dark' });
assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'the page is wider than a phone');
const small = await page.locator('#stage').boundingBox();
assert.ok(Math.abs(small.width / small.height - 64 / 48) < 0.02 && small.y < 150, 'the picture has bars around it, or is not at the top');
await page.screenshot({ path: `${folder}/dark.png` });

// Names are text, however long they are and whatever they hold.
const nasty = `</script><img src=x onerror=alert(1)> &lt;b&gt; ${'x'.repeat(80)}`;
await next('gpu', () => writeFileSync(scene_file, scene.replaceAll('"matte"', `"${nasty}"`).replace(/^diffuse = (.*)$/m, 'diffuse = $1  # @color')));
assert.equal(await page.locator('#tunables legend').first().textContent(), nasty);
assert.equal(await page.locator('img').count(), 0);
assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'a long name makes the page wider than a phone');
await browser.close();
