// Moves a camera: eye, target and up, as a scene has them.

const add = (a, b) => a.map((x, i) => x + b[i]);
const sub = (a, b) => a.map((x, i) => x - b[i]);
const times = (a, s) => a.map(x => x * s);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = a => Math.sqrt(dot(a, a));
const unit = a => times(a, 1 / norm(a));

// Rotates v about the unit axis, by Rodrigues' formula.
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}

// Orbits the target by angles in radians: `around` the up axis, and `over` towards its poles, but not beyond them.
export function orbited(camera, around, over) {
  const up = unit(camera.up);
  let back = turned(sub(camera.eye, camera.target), up, around);
  const right = cross(up, back);
  if (norm(right) > 0) {
    const height = Math.acos(Math.min(Math.max(dot(unit(back), up), -1), 1));  // the angle from the pole
    const wanted = Math.min(Math.max(height + over, 0.02), Math.PI - 0.02);
    back = turned(back, unit(right), wanted - height);
  }
  return { ...camera, eye: add(camera.target, back) };
}

// Moves the eye along its line to the target: multiplies the distance by `factor`.
export const nearer = (camera, factor) => ({ ...camera, eye: add(camera.target, times(sub(camera.eye, camera.target), factor)) });

// Moves eye and target together, to the right and ahead, in units of their distance.
export function flown(camera, right, ahead) {
  const way = sub(camera.target, camera.eye);
  const step = add(times(unit(cross(way, camera.up)), right * norm(way)), times(way, ahead));
  return { ...camera, eye: add(camera.eye, step), target: add(camera.target, step) };
}
