// Takes the documents' screenshots of the pages of `dev` and `verify --report`: node screenshots.mjs EYERAY FOLDER (scripts/pictures).
import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const [eyeray, folder] = process.argv.slice(2).map(path => resolve(path));
// eyeray runs here, so that the pages show short paths.
const scratch = mkdtempSync(`${tmpdir()}/eyeray-pages-`), shaders = 'my-shaders';
symlinkSync(resolve('scenes'), `${scratch}/scenes`);
process.chdir(scratch);
const browser = await launch();
async function open(url, height) {
  const page = await browser.newPage({ colorScheme: 'light', viewport: { width: 1200, height } });
  page.setDefaultTimeout(300_000);
  await page.goto(url);
  return page;
}
function run(code, ...options) {
  const { status, stderr } = spawnSync(eyeray, options);
  if (status !== code) throw new Error(`eyeray ${options.join(' ')}: exit code ${status}, not ${code}: ${stderr}`);
}
function edit(file, from, to) {
  const path = `${shaders}/${file}`, code = readFileSync(path, 'utf8');
  if (!code.includes(from)) throw new Error(`${file} has no "${from}": mend this script`);
  writeFileSync(path, code.replace(from, to));
}

run(0, 'shaders', '--export', shaders);
const dev = spawn(eyeray, ['dev', 'scenes/whitted.toml', '-s', '640x480', '--shaders', shaders, '--timeout', '60']);
const address = await new Promise(found => {
  let text = '';
  dev.stderr.on('data', data => {
    text += data;
    const url = /http:\/\/\S+/.exec(text);
    if (url) found(url[0]);
  });
});
const page = await open(address, 740);
await page.waitForFunction(() => document.body.dataset.state === 'done');
const { x, y, width, height } = await page.locator('#stage').boundingBox();
await page.mouse.click(x + 0.3 * width, y + 0.66 * height);
await page.locator('#probe details').first().waitFor();
edit('shapes/sphere.glsl', 'return discriminant', 'return discrimnant');
await page.locator('#failure:not([hidden])').waitFor();
await page.screenshot({ path: `${folder}/dev.png` });
dev.kill();
edit('shapes/sphere.glsl', 'return discrimnant', 'return discriminant');

edit('lights/light.glsl', 'LIGHTS(SAMPLE_OF)', 'LIGHTS(SAMPLE_OF)\n  s.color = s.color * 0.98f;');
const scenes = ['cornell', 'orientation', 'shapes/sphere', 'whitted'].map(name => `scenes/${name}.toml`);
run(1, 'verify', ...scenes, '--shaders', shaders, '--quiet', '-s', '480x360', '--report', 'report');
const report = await open(`${pathToFileURL('report/index.html').href}#2,gpu,split,difference`, 1060);
await report.locator('#pictures button[aria-pressed=true]').waitFor();
await report.screenshot({ path: `${folder}/report.png` });

await browser.close();
rmSync(scratch, { recursive: true });
