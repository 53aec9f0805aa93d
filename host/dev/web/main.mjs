// eyeray dev's page: shows the server's status, and sends the user's commands.
import { Stage } from './stage.mjs';
import { orbited, nearer, flown } from './camera.mjs';
import { show_failure, show_warnings } from './failure.mjs';
import { show_probe } from './probe.mjs';
import { show_tunables } from './tunables.mjs';

const $ = id => document.getElementById(id);
const keys = { gpu: '1', twin: '2', reference: '3', difference: 'd' };

let status = { pictures: {}, view: 'gpu' };
let camera = null;         // the camera as this page has moved it, until the server has it too; null: the server's camera
let moved = -Infinity;     // when this page last moved the camera
let mode = 'look';
let shown_picture = '';    // view, version and exposure of the picture on the stage
let loading = false;

const send = command =>
  fetch('command', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(command) });

// ---- The picture ----
const stage = new Stage($('stage'), {
  hover: at => show_values(at ?? stage.marked),
  click: at => choose_pixel(at),
  drag: (dx, dy) => mode === 'orbit' && move_camera(orbited(camera_now(), -dx / 150, -dy / 150)),
  wheel: steps => mode === 'orbit' && move_camera(nearer(camera_now(), 2 ** (-steps / 2))),
});

// The version of a view's picture; undefined while there is no picture.
function version_of(view) {
  const { gpu, reference, [view]: own } = status.pictures;
  return view === 'difference' ? gpu && reference && `${gpu}/${reference}` : own;
}

// Fetches one picture at a time: the newest one, once the last one has arrived.
async function refresh() {
  const version = version_of(status.view);
  const wanted = `${status.view} ${version} ${$('exposure').value}`;
  document.body.dataset.wanted = wanted;
  if (loading || !version || wanted === shown_picture) return;
  loading = true;
  try {
    const answer = await fetch(`frame?view=${encodeURIComponent(status.view)}&exposure=${$('exposure').value}`);
    if (answer.ok) {
      stage.show(await createImageBitmap(await answer.blob()));
      shown_picture = wanted;
      document.body.dataset.shown = wanted;
      show_values(stage.marked);
    } else if (answer.status !== 404) {
      shown_picture = wanted;
    }
  } catch { /* the events say when the server is gone */ }
  loading = false;
  if (shown_picture === wanted) refresh();
}

let requested = 0;
async function show_values(at) {
  const turn = ++requested;
  if (!at || !version_of(status.view)) { $('pixel').textContent = ''; return; }
  const answer = await fetch(`values?view=${encodeURIComponent(status.view)}&x=${at[0]}&y=${at[1]}`).catch(() => null);
  if (turn !== requested || !answer?.ok) return;
  const [values] = await answer.json();
  $('pixel').textContent = `${at[0]},${at[1]}  ${values.map(v => typeof v === 'number' ? v.toPrecision(7) : v).join('  ')}`;
}

function choose_pixel(at) {
  stage.marked = at;
  stage.draw();
  show_values(at);
  probed = null;
  report_whether_stale();
  $('probe').textContent = `Examining ${at[0]},${at[1]} …`;
  send({ probe: at });
}

// ---- Values that the user moves: at most one request a frame, with the newest of each ----
let chosen = null;
function choose(command) {
  if (!chosen) requestAnimationFrame(() => { send(chosen); chosen = null; });
  chosen = { ...chosen, ...Object.fromEntries(Object.entries(command).map(([key, values]) => [key, { ...chosen?.[key], ...values }])) };
}

// ---- The camera ----
const camera_now = () => camera ?? status.camera;
function move_camera(to) {
  if (!status.camera) return true;
  camera = to;
  moved = performance.now();
  const text = v => `[${v.map(x => x.toPrecision(9)).join(', ')}]`;
  choose({ defines: { 'camera.eye': text(camera.eye), 'camera.target': text(camera.target) } });
  return true;
}
function reset_camera() {
  camera = null;
  send({ defines: { 'camera.eye': null, 'camera.target': null } });
}

// ---- The status ----
const words = { starting: 'starting', load: 'loading', loading: 'loading', compile: 'compiling', render: 'rendering', denoise: 'denoising', done: 'done', failed: 'failed' };
let probes = 0;
let probed = null;  // the edit to which the shown rays belong
let drawn = null;  // the edit to which the shown picture belongs: a broken edit leaves the last good one
const report_whether_stale = () => {
  if (!status.stale) drawn = status.edit;
  $('stale').hidden = probed === null || drawn === null || probed === drawn;
};
function tell() {
  const name = status.scene.split('/').pop();
  $('scene').textContent = name;
  $('scene').title = status.scene;
  document.title = `${status.state === 'failed' ? '✗ ' : ''}${name} – eyeray dev`;
  const { state } = status;
  const note = status.preview && state === 'compile' ? 'A preview: the CPU computes the same picture while the kernel compiles.'
    : status.stale && Object.keys(status.pictures).length > 0 ? 'The last picture stays until there is a new one.'
    : status.view === 'difference' && state === 'render' ? 'Grey pixels are not compared yet.' : '';
  $('state').textContent = `${words[state] ?? state}${state === 'denoise' ? ` ${Math.round(status.share * 100)}\u00a0%` : ''}`;
  $('times').textContent = note;
  $('state').className = `badge ${status.state}`;
  document.body.dataset.state = status.state;
  document.body.dataset.generation = status.generation;
  if (status.state === 'done') {
    const compile = ['shader compile', 'pipeline', 'compile'].reduce((sum, stage) => sum + (status.stages[stage] ?? 0), 0);
    const tracing = status.stages.dispatch ?? status.stages.trace ?? status.seconds;
    $('times').textContent = `${status.width}×${status.height}, ${ms(status.seconds)}, of which compiling ${ms(compile)}; ` +
      `${(status.rays / Math.max(tracing, 1e-6) / 1e6).toPrecision(3)}\u00a0Mrays/s` +
      (status.noise_left === null ? '' : `; denoised, remaining noise ${percent(status.noise_left)}`);
    $('stages').textContent = [...Object.entries(status.stages).map(([name, s]) => `${name.padEnd(16)} ${ms(s)}`), '', status.device].join('\n');
  }
  // Take the server's camera again: another page may have moved it.
  if (status.state === 'done' && performance.now() - moved > 1000) camera = null;
  $('reset').hidden = !('camera.eye' in (status.defines ?? {}));
  $('denoise').hidden = typeof status.denoise !== 'boolean';
  $('denoise').setAttribute('aria-pressed', status.denoise === true);
  show_failure($('failure'), status.failure);
  show_warnings($('warnings-panel'), $('warnings'), status.warnings ?? [], status.doubts ?? []);
  show_tunables($('tunables-panel'), $('tunables'), status, choose);
  show_views();
  if (status.probes && status.probes !== probes) {
    probes = status.probes;
    fetch('probe').then(answer => answer.json()).then(answer => {
      probed = answer.edit;
      stage.marked ??= [answer.x, answer.y];  // another page may have requested the probe
      stage.draw();
      show_probe($('probe'), answer);
      report_whether_stale();
    });
  }
  report_whether_stale();
  refresh();
}
const percent = share => `${Number((share * 100).toPrecision(2))}\u00a0%`;
const ms = seconds => seconds < 1 ? `${(seconds * 1000).toFixed(0)}\u00a0ms` : `${seconds.toFixed(2)}\u00a0s`;

function show_views() {
  const names = Object.keys(keys);
  if ($('views').children.length === 0) {
    for (const name of names) {
      const button = Object.assign(document.createElement('button'), { textContent: `${name} `, onclick: () => send({ view: name }) });
      button.append(Object.assign(document.createElement('kbd'), { textContent: keys[name] }));
      button.dataset.view = name;
      $('views').append(button);
    }
  }
  if ($('aovs').children.length === 1) for (const name of status.aovs) $('aovs').append(new Option(name));
  $('aovs').value = status.aovs.includes(status.view) ? status.view : '';
  for (const button of $('views').children) button.setAttribute('aria-pressed', button.dataset.view === status.view);
}

const events = new EventSource('events');
events.onmessage = event => {
  status = JSON.parse(event.data);
  tell();
};
events.onerror = () => {
  $('state').textContent = 'eyeray dev has ended; waiting for it';
  $('state').className = 'badge lost';
};

// ---- Buttons and keys ----
function choose_mode(name) {
  mode = name;
  $('pan').setAttribute('aria-pressed', mode === 'look');
  $('orbit').setAttribute('aria-pressed', mode === 'orbit');
}
function expose(stops) {
  $('exposure').value = stops;
  $('stops').textContent = $('exposure').value;
  refresh();
}
$('exposure').oninput = () => expose($('exposure').value);
$('pan').onclick = () => choose_mode('look');
$('orbit').onclick = () => choose_mode('orbit');
$('aovs').onchange = () => { send({ view: $('aovs').value || 'gpu' }); $('aovs').blur(); };
$('fit').onclick = () => stage.fit();
$('reset').onclick = reset_camera;
const toggle_denoising = () => {
  if (typeof status.denoise === 'boolean') send({ defines: { 'render.denoise': String(!status.denoise) } });
};
$('denoise').onclick = toggle_denoising;

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const flights = { w: [0, 0.05], s: [0, -0.05], a: [-0.05, 0], f: [0.05, 0] };
addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input, select')) return;
  const view = Object.keys(keys).find(name => keys[name] === event.key);
  if (view) send({ view });
  else if (event.key === '0') stage.fit();
  else if (event.key === '+' || event.key === '=') stage.zoom(2);
  else if (event.key === '-') stage.zoom(0.5);
  else if (event.key === '[') expose(Number($('exposure').value) - 0.5);
  else if (event.key === ']') expose(Number($('exposure').value) + 0.5);
  else if (event.key === 'v') choose_mode('look');
  else if (event.key === 'o') choose_mode('orbit');
  else if (event.key === 'n') toggle_denoising();
  else if (event.key === 'r') reset_camera();
  else if (event.key in flights && status.camera) move_camera(flown(camera_now(), ...flights[event.key]));
  else if (event.key === 'Enter' && stage.marked && event.target === $('stage')) choose_pixel(stage.marked);
  else if (event.key in arrows && stage.image) {
    event.preventDefault();
    const from = stage.marked ?? stage.size.map(n => Math.floor(n / 2));
    stage.marked = from.map((x, i) => Math.min(Math.max(x + arrows[event.key][i], 0), stage.size[i] - 1));
    stage.draw();
    show_values(stage.marked);
  }
});
