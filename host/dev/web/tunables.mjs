// Sliders, colours and checkboxes for values that shaders and the scene mark as adjustable (docs/dev-loop.md).

const make = (tag, properties) => Object.assign(document.createElement(tag), properties);
const hex = value => '#' + value.map(x => Math.round(Math.min(Math.max(x, 0), 1) * 255).toString(16).padStart(2, '0')).join('');
const rgb = text => [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16) / 255);

const controls = {
  float: each => make('input', { type: 'range', min: each.low, max: each.high, step: (each.high - each.low) / 1000, value: each.value[0] }),
  int: each => make('input', { type: 'range', min: each.low, max: each.high, step: 1, value: each.value[0] }),
  bool: each => make('input', { type: 'checkbox', checked: each.value[0] !== 0 }),
  vec3: each => make('input', { type: 'color', value: hex(each.value) }),
};
const value_of = (type, input) => type === 'bool' ? [Number(input.checked)] : type === 'vec3' ? rgb(input.value) : [Number(input.value)];
const text_of = (type, value) => type === 'bool' ? String(value[0] !== 0) : type === 'vec3' ? hex(value) : String(Number(value[0].toPrecision(4)));

const in_toml = (type, value) => type === 'bool' ? String(value[0] !== 0) : type === 'vec3' ? `[${value.join(', ')}]` : String(value[0]);
const from_toml = text => [JSON.parse(text)].flat().map(Number);

const set_input = (type, input, value) => type === 'bool' ? input.checked = value[0] !== 0 : input.value = type === 'vec3' ? hex(value) : value[0];
const still_mine = 1000;  // milliseconds for which other pages do not move a control that was moved here

let shown = '';
let rows = [];  // the rows on the page: { each, node, input, output, touched }

function show_value(row) {
  if (performance.now() - row.touched < still_mine) return;
  set_input(row.each.type, row.input, row.each.now);
  row.output.textContent = text_of(row.each.type, row.each.now);
}

function row_of(each) {
  const node = make('div', { className: 'tunable', title: `${each.id}; double-click the name to restore the value of the file` });
  const input = controls[each.type](each), output = make('output', {});
  const row = { each, node, input, output, touched: -Infinity };
  input.id = `tunable ${each.id}`;
  input.oninput = () => {
    const value = value_of(each.type, input);
    output.textContent = text_of(each.type, value);
    row.touched = performance.now();
    setTimeout(show_value, 1.1 * still_mine, row);
    row.each.set(value);
  };
  const label = make('label', { textContent: each.name, htmlFor: input.id });
  label.ondblclick = () => { row.touched = -Infinity; row.each.set(null); };
  node.append(label, input, output);
  return row;
}

// `tunables`, `scene_tunables`: the tunables of shaders and scene that the server knows; `chosen`, `defines`: the values of these that pages have
// chosen. Calls `choose(command)` while a control is moved.
export function show_tunables(panel, element, { tunables = [], chosen = {}, scene_tunables = [], defines = {} }, choose) {
  const all = [
    ...(tunables ?? []).map(each => ({ ...each, now: chosen[each.id] ?? each.written, set: value => choose({ tunables: { [each.id]: value } }) })),
    ...(scene_tunables ?? []).map(each => ({ ...each, now: each.id in defines ? from_toml(defines[each.id]) : each.written,
                                             set: value => choose({ defines: { [each.id]: value && in_toml(each.type, value) } }) })),
  ];
  panel.hidden = all.length === 0;
  // Make new nodes only for other tunables: a control that is held must keep its node.
  const key = JSON.stringify(all.map(each => [each.id, each.owner, each.name, each.type, each.low, each.high]));
  if (key !== shown) {
    shown = key;
    rows = all.map(row_of);
    const owners = new Map();
    for (const row of rows) owners.set(row.each.owner, [...(owners.get(row.each.owner) ?? []), row.node]);
    element.replaceChildren(...[...owners].map(([owner, nodes]) => {
      const group = make('fieldset', {});
      group.append(...(owner ? [make('legend', { textContent: owner })] : []), ...nodes);
      return group;
    }));
  }
  rows.forEach((row, i) => {
    row.each = all[i];
    show_value(row);
  });
}
