// The rays of one pixel, as `eyeray probe` prints them: a value on which all agree appears once, and differences are marked.

const make = (tag, text, name) => {
  const node = document.createElement(tag);
  if (text !== undefined) node.textContent = text;
  if (name) node.className = name;
  return node;
};

const all_digits = 9, digits_in_a_line = 6;
const number = (x, digits) => typeof x === 'number' && !Number.isInteger(x) ? String(Number(x.toPrecision(digits))) : String(x);
const text = (value, digits) => value === undefined ? '–' : [value].flat().map(x => number(x, digits)).join(' ');

function line(value, executors) {
  const row = make('div', undefined, `line ${value.verdict ?? ''}`);
  row.append(make('span', value.name, 'name'));
  if (!value.verdict) {  // shorten numbers that agree, so that a vector fits in a line
    const agreed = executors.map(name => value[name]).find(each => each !== undefined);
    row.append(Object.assign(make('span', text(agreed, digits_in_a_line)), { title: text(agreed, all_digits) }));
    return row;
  }
  const texts = executors.map(name => text(value[name], all_digits));
  const all = make('span');
  executors.forEach((name, i) => all.append(make('div', `${texts[i]}  ${name}`)));
  all.append(make('div', `${value.verdict}: ${value.difference}`, 'why'));
  row.append(all);
  return row;
}

export function show_probe(element, answer) {
  if (answer.message) {
    element.textContent = answer.message;
    return;
  }
  const { rays, executors, notes, first_difference, sample, samples } = answer.findings, names = Object.keys(executors);
  const depths = [];
  const title = `pixel ${answer.x},${answer.y}` + (samples > 1 ? `, sample ${sample} of ${samples}` : '') +
    (first_difference ? '' : `: ${names.join(', ')} agree`);
  element.replaceChildren(make('p', title), ...notes.map(note => make('p', note)));
  rays.forEach((ray, i) => {
    depths[i] = ray.parent === undefined ? 0 : depths[ray.parent] + 1;
    const item = make('details', undefined, ray.verdict ?? '');
    item.style.marginLeft = `${Math.min(depths[i], 12) * 0.75}em`;
    item.open = depths[i] < 2;
    const kind = ray.ray === 'eye' ? 'camera' : ray.ray;
    const shown = kind === 'pixel' ? 'the pixel' : ray.light === undefined ? `${kind} ray` : `shadow ray to light ${ray.light}`;
    item.append(make('summary', shown + (ray.hits ? ` → ${ray.hits}` : '')), ...ray.values.map(value => line(value, names)));
    if (ray.values.some(value => value.verdict === 'differs')) item.open = true;
    element.append(item);
  });
  element.scrollTop = 0;
}
