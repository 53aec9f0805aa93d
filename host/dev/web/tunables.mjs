// Sliders, colours and checkboxes for the constants of shaders that say so (docs/dev-loop.md).

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
const said = (type, value) => type === 'bool' ? String(value[0] !== 0) : type === 'vec3' ? hex(value) : String(Number(value[0].toPrecision(4)));

const in_toml = (type, value) => type === 'bool' ? String(value[0] !== 0) : type === 'vec3' ? `[${value.join(', ')}]` : String(value[0]);

let shown = '';

// `choose(command)` is called while a control is moved. A double click on the name gives the value back to its file.
export function show_tunables(panel, place, of_shaders, of_scene, choose) {
  const all = [...of_shaders.map(each => ({ ...each, set: value => choose({ tunables: { [each.id]: value } }) })),
               ...of_scene.map(each => ({ ...each, set: value => choose({ defines: { [each.id]: value && in_toml(each.type, value) } }) }))];
  panel.hidden = all.length === 0;
  // What is held by a hand is not taken from it: only other tunables, or other texts, make new controls.
  const key = JSON.stringify(all.map(each => [each.id, each.type, each.low, each.high, each.written]));
  if (key === shown) return;
  shown = key;
  place.replaceChildren(...all.map(each => {
    const row = make('div', { className: 'tunable', title: each.id });
    const input = controls[each.type](each), output = make('output', { textContent: said(each.type, each.value) });
    input.id = `tunable ${each.id}`;
    input.oninput = () => {
      const value = value_of(each.type, input);
      output.textContent = said(each.type, value);
      each.set(value);
    };
    const label = make('label', { textContent: each.name, htmlFor: input.id });
    label.ondblclick = () => { each.set(null); shown = ''; };
    row.append(label, input, output);
    return row;
  }));
}
