// Wheel, drag, pinch and keys on the stage; what is under the pointer.

/** Zooms by a factor and keeps the point (x, y), in device pixels of the canvas, where it is. */
function zoomAt(canvas, factor, x, y) {
  const { view } = state;
  const zoom = Math.max(1, Math.min(MOST_ZOOM, view.zoom * factor));
  const [, , width, height] = placement(canvas);
  const moved = (1 - view.zoom / zoom);
  setView(canvas, {
    zoom,
    x: view.x + ((x - canvas.width / 2) / width) * moved,
    y: view.y + ((y - canvas.height / 2) / height) * moved,
  });
}

function move(canvas, dx, dy) {
  const [, , width, height] = placement(canvas);
  setView(canvas, { zoom: state.view.zoom, x: state.view.x - dx / width, y: state.view.y - dy / height });
}

/** Position of an event in device pixels of its canvas. */
function position(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return [((event.clientX - box.left) / box.width) * canvas.width, ((event.clientY - box.top) / box.height) * canvas.height];
}

function listen(canvas, pictureIndex) {
  const pointers = new Map();
  const middle = () => {
    const list = [...pointers.values()];
    const sum = (k) => list.reduce((total, at) => total + at[k], 0) / list.length;
    const spread = list.length > 1 ? Math.hypot(list[0][0] - list[1][0], list[0][1] - list[1][1]) : 0;
    return { x: sum(0), y: sum(1), spread };
  };
  canvas.addEventListener('wheel', (event) => {
    // At the far end the page scrolls on.
    if (state.view.zoom === 1 && event.deltaY > 0) return;
    event.preventDefault();
    zoomAt(canvas, 2 ** (-Math.max(-100, Math.min(100, event.deltaY)) / 200), ...position(canvas, event));
  }, { passive: false });
  canvas.addEventListener('pointerdown', (event) => {
    pointers.set(event.pointerId, position(canvas, event));
    if (state.view.zoom > 1) canvas.setPointerCapture(event.pointerId);
    canvas.classList.add('dragged');
  });
  canvas.addEventListener('pointermove', (event) => {
    read(canvas, pictureIndex(), ...position(canvas, event));
    if (!pointers.has(event.pointerId)) return;
    const before = middle();
    pointers.set(event.pointerId, position(canvas, event));
    const after = middle();
    if (before.spread > 0) zoomAt(canvas, after.spread / before.spread, after.x, after.y);
    if (state.view.zoom > 1) move(canvas, after.x - before.x, after.y - before.y);
  });
  for (const end of ['pointerup', 'pointercancel', 'pointerleave']) {
    canvas.addEventListener(end, (event) => {
      pointers.delete(event.pointerId);
      canvas.classList.toggle('dragged', pointers.size > 0);
    });
  }
  // A second finger would move the page.
  canvas.addEventListener('touchmove', (event) => {
    if (event.touches.length > 1 && event.cancelable) event.preventDefault();
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    const center = [canvas.width / 2, canvas.height / 2];
    if (event.key === '+' || event.key === '=') zoomAt(canvas, 1.5, ...center);
    else if (event.key === '-') zoomAt(canvas, 1 / 1.5, ...center);
    else if (event.key === '0') setView(canvas, { zoom: 1, x: 0.5, y: 0.5 });
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
}

/** Radiance of a pixel and its error: [R, G, B] each. */
function pixel(pictureIndex, x, y) {
  const from = 3 * (y * scene().resolution[0] + x);
  const values = [...radiance(state.scene, pictureIndex).subarray(from, from + 3)];
  const truth = radiance(state.scene, state.reference).subarray(from, from + 3);
  return { values, errors: values.map((value, k) => value - truth[k]) };
}

/** Writes what is under the point (x, y), in device pixels of the canvas. */
function read(canvas, pictureIndex, x, y) {
  const [left, top] = placement(canvas);
  const size = pixelSize(canvas);
  const [width, height] = scene().resolution;
  const [column, row] = [Math.floor((x - left) / size), Math.floor((y - top) / size)];
  if (column < 0 || row < 0 || column >= width || row >= height) return;
  const { values, errors } = pixel(pictureIndex, column, row);
  const signed = (value) => (value > 0 ? '+' : value < 0 ? '−' : ' ') + short(Math.abs(value));
  const line = (name, k) => `${name}  ${short(values[k]).padEnd(9)} ${signed(errors[k])}`;
  element('readout').classList.add('read');
  element('readout').textContent = [
    `x ${column}, y ${row}`,
    '   radiance  error',
    ...['R', 'G', 'B'].map(line),
  ].join('\n');
}
