// What is wrong, over the picture: each message with its place, which opens in the editor, and its source.

const make = (tag, text) => Object.assign(document.createElement(tag), text === undefined ? {} : { textContent: text });

export function show_failure(place, failure) {
  place.hidden = !failure;
  if (!failure) return;
  const diagnostics = failure.diagnostics ?? [];
  if (diagnostics.length === 0) {
    place.replaceChildren(make('p', failure.message));
    return;
  }
  place.replaceChildren(...diagnostics.map(diagnostic => {
    const item = make('div');
    const where = [diagnostic.file, diagnostic.line, diagnostic.column].filter(Boolean).join(':');
    const link = make(diagnostic.path ? 'a' : 'span', where);
    if (diagnostic.path) link.href = `vscode://file${encodeURI(diagnostic.path)}:${diagnostic.line}:${diagnostic.column || 1}`;
    item.append(link, ': ', make('strong', diagnostic.severity), `: ${diagnostic.message}`);
    if (diagnostic.source) {
      const caret = diagnostic.column ? '\n' + ' '.repeat(Math.max(0, diagnostic.column - diagnostic.source_column)) + '^' : '';
      item.append(make('pre', diagnostic.source + caret));
    }
    return item;
  }));
}
