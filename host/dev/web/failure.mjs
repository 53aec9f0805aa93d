// Errors over the picture and warnings beside it: each message with its source and its position, a link that opens the editor.

const make = (tag, text) => Object.assign(document.createElement(tag), text === undefined ? {} : { textContent: text });

function item_of(diagnostic) {
  const item = make('div');
  const where = [diagnostic.file, diagnostic.line, diagnostic.column].filter(Boolean).join(':');
  const link = make(diagnostic.path ? 'a' : 'span', where);
  if (diagnostic.path) link.href = `vscode://file${diagnostic.path.split('/').map(encodeURIComponent).join('/')}:${diagnostic.line}:${diagnostic.column || 1}`;
  item.append(link, ': ', make('strong', diagnostic.severity), `: ${diagnostic.message}`);
  if (diagnostic.source) {
    const caret = diagnostic.column ? '\n' + ' '.repeat(Math.max(0, diagnostic.column - diagnostic.source_column)) + '^' : '';
    item.append(make('pre', diagnostic.source + caret));
  }
  return item;
}

export function show_failure(element, failure) {
  element.hidden = !failure;
  if (!failure) return;
  const diagnostics = failure.diagnostics ?? [];
  element.replaceChildren(...(diagnostics.length > 0 ? diagnostics.map(item_of) : [make('p', failure.message)]));
}

// `doubts`: sentences that warn of a picture that may be wrong.
export function show_warnings(panel, element, warnings, doubts) {
  panel.hidden = warnings.length === 0 && doubts.length === 0;
  element.replaceChildren(...warnings.map(item_of), ...doubts.map(doubt => make('p', doubt)));
}
