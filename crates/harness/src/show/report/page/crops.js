// The same rectangles of all pictures.

function layOutCrops() {
  const { crops, pictures } = scene();
  element('crops').hidden = crops.length === 0;
  element('crops-link').hidden = crops.length === 0;
  element('crop-rows').replaceChildren(...crops.map((crop, nth) => {
    const [x, y, width, height] = crop.rectangle;
    const tiles = pictures.map((picture, index) => cropTile(crop, picture, index));
    return make('div', { class: 'crop-row' },
      make('h3', {}, `Crop ${nth + 1}: ${width}×${height} pixels from column ${x}, row ${y}`),
      make('div', { class: 'crop-tiles' }, ...tiles));
  }));
  drawCrops();
}

function cropTile(crop, picture, index) {
  const [, , width, height] = crop.rectangle;
  const canvas = make('canvas', { width, height });
  canvas.style.borderColor = crop.color;
  const button = make('button', { type: 'button', 'aria-label': `Show ${label(picture)}` }, canvas);
  button.addEventListener('click', () => showCrop(crop, index));
  const tile = make('figure', { class: 'crop' }, button, make('figcaption', {}, `${index + 1}  ${label(picture)}`));
  Object.assign(canvas, { crop, picture: index });
  return tile;
}

function drawCrops() {
  for (const canvas of document.querySelectorAll('.crop canvas')) {
    const [x, y, width, height] = canvas.crop.rectangle;
    canvas.getContext('2d').drawImage(paint(canvas.picture), x, y, width, height, 0, 0, width, height);
    canvas.closest('.crop').classList.toggle('on', canvas.picture === state.picture);
  }
}

/** Flips to a picture and zooms to the crop. */
function showCrop({ rectangle: [x, y, width, height] }, index) {
  const [columns, rows] = scene().resolution;
  change({ picture: index, tiles: false });
  const zoom = 0.8 * Math.min(columns / width, rows / height);
  setView(canvases[0].canvas, { zoom, x: (x + width / 2) / columns, y: (y + height / 2) / rows });
  element('pictures').scrollIntoView({ block: 'start' });
}
