// The rays of one pixel, as `eyeray probe` tells them; what differs is marked.

export function show_probe(place, answer) {
  if (answer.message) {
    place.textContent = answer.message;
    return;
  }
  place.replaceChildren(...answer.text.split('\n').map(line => {
    const row = document.createElement('div');
    row.textContent = line || ' ';
    row.classList.toggle('differs', /◄|<--|differs/.test(line));
    return row;
  }));
  place.scrollTop = 0;
}
