// Controls, keys, downloads.

function fillSelect(id, names, key) {
  const select = element(id);
  select.replaceChildren(...names.map((name, index) => make('option', { value: index }, name)));
  select.addEventListener('change', () => change({ [key]: Number(select.value) }));
  watch([key], () => { select.value = state[key]; });
}
fillSelect('scene', data.scenes.map(({ name }) => name), 'scene');
fillSelect('reference', data.references, 'reference');

function drawChips() {
  element('chips').replaceChildren(...scene().pictures.map((picture, index) => {
    const chip = make('button', { type: 'button', 'aria-pressed': 'false' }, make('kbd', {}, String(index + 1)));
    if (!picture.reference) {
      chip.append(make('span', { class: 'swatch', style: `background:${variantOf(rowOf(picture)).color}` }));
    }
    chip.append(label(picture));
    chip.addEventListener('click', () => change({ picture: index }));
    return chip;
  }));
  element('last-key').textContent = scene().pictures.length;
  element('left-out').hidden = !scene().left_out;
  element('left-out').textContent = `${scene().left_out} pictures are left out to keep the page small: each curve shows its last setting.`;
  pressChip();
}

function pressChip() {
  [...element('chips').children].forEach((chip, index) => {
    const pressed = index === state.picture;
    chip.setAttribute('aria-pressed', pressed);
    const strip = element('chips');
    if (pressed) strip.scrollLeft = chip.offsetLeft - (strip.clientWidth - chip.clientWidth) / 2;
  });
}

function show(picture) {
  const { length } = scene().pictures;
  change({ picture: ((picture % length) + length) % length });
}

// Scenes may differ in their pictures.
watch(['scene'], () => {
  state.picture = Math.min(state.picture, scene().pictures.length - 1);
  state.view = { zoom: 1, x: 0.5, y: 0.5 };
  drawChips();
});
watch(['scene', 'tiles'], layOut);
watch(['scene'], layOutCrops);
watch(['picture'], pressChip);
watch(['picture', 'mode', 'stops', 'octaves', 'reference', 'view'], draw);
watch(['picture', 'mode', 'stops', 'octaves', 'reference'], drawCrops);
watch(['scene', 'reference', 'sort'], drawTable);
watch(['picture'], markRow);
watch(['tiles'], () => element('tiles').setAttribute('aria-pressed', state.tiles));
watch(['mode'], () => {
  document.querySelector(`#modes [value="${state.mode}"]`).checked = true;
  element('exposure-control').hidden = state.mode !== 'image';
  element('scale-control').hidden = state.mode === 'image';
});
watch(['stops', 'octaves', 'scene'], () => {
  element('exposure').value = state.stops;
  element('scale').value = state.octaves;
  const sign = state.stops < 0 ? '−' : '+';
  element('exposure-value').textContent = `${sign}${Math.abs(state.stops)} stops`;
  element('scale-value').textContent = short(errorScale());
});

element('modes').addEventListener('change', (event) => change({ mode: event.target.value }));
element('exposure').addEventListener('input', (event) => change({ stops: Number(event.target.value) }));
element('scale').addEventListener('input', (event) => change({ octaves: Number(event.target.value) }));
element('tiles').addEventListener('click', () => change({ tiles: !state.tiles }));
element('reset').addEventListener('click', () => change({ stops: 0, octaves: 0, view: { zoom: 1, x: 0.5, y: 0.5 } }));
new ResizeObserver(draw).observe(element('stage'));

let typed = { digits: '', at: 0 };
/** Digits that follow each other at once are one number where there are that many pictures. */
function typeDigit(digit, now) {
  const together = now - typed.at < 600 ? typed.digits + digit : digit;
  const digits = Number(together) <= scene().pictures.length ? together : digit;
  typed = { digits, at: now };
  const picture = Number(digits) - 1;
  if (picture >= 0 && picture < scene().pictures.length) show(picture);
}

document.addEventListener('keydown', (event) => {
  const writes = event.target instanceof Element && event.target.closest('select, input, [role="region"]');
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (/^[0-9]$/.test(event.key) && !event.target.closest?.('select')) {
    typeDigit(event.key, event.timeStamp);
    return;
  }
  if (writes) return;
  const modes = { p: 'image', s: 'signed', a: 'absolute' };
  if (event.key === 'ArrowRight') show(state.picture + 1);
  else if (event.key === 'ArrowLeft') show(state.picture - 1);
  else if (modes[event.key.toLowerCase()]) change({ mode: modes[event.key.toLowerCase()] });
  else return;
  event.preventDefault();
});

function download(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  make('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
element('download-csv').addEventListener('click', () => download('table.csv', 'text/csv', data.csv));
element('download-json').addEventListener('click', () => download('report.json', 'application/json', JSON.stringify(data)));

for (const { update } of watchers) update();
// For tests and the console.
window.manylights = { data, state, change, show, sortBy, pixel, paint };
document.documentElement.dataset.ready = 'true';
