// The stage: one canvas, or all pictures side by side, that share zoom and position.
const MOST_ZOOM = 64;
let canvases = []; // { canvas, picture }: `picture` is undefined for the one that flips

/** Lays the stage out anew. */
function layOut() {
  const stage = element('stage');
  stage.replaceChildren();
  element('viewer').classList.toggle('tiled', state.tiles);
  canvases = state.tiles
    ? scene().pictures.map((picture, index) => addCanvas(stage, picture, index))
    : [addCanvas(stage)];
  draw();
}

function addCanvas(stage, picture, index) {
  const canvas = make('canvas', { tabindex: '0', role: 'img' });
  const figure = make('figure', {}, canvas);
  if (picture) {
    figure.append(make('figcaption', {}, `${index + 1}  ${label(picture)}`));
    canvas.setAttribute('aria-label', label(picture));
    canvas.addEventListener('dblclick', () => change({ picture: index, tiles: false }));
  }
  stage.append(figure);
  listen(canvas, () => (picture ? index : state.picture));
  return { canvas, picture: picture ? index : undefined };
}

/** Device pixels that a pixel of the picture takes on a canvas. */
function pixelSize(canvas) {
  const [width, height] = scene().resolution;
  return Math.min(canvas.width / width, canvas.height / height) * state.view.zoom;
}

/** Where the picture lies on a canvas: left, top, width, height in device pixels. */
function placement(canvas) {
  const [width, height] = scene().resolution;
  const size = pixelSize(canvas);
  const left = canvas.width / 2 - state.view.x * width * size;
  const top = canvas.height / 2 - state.view.y * height * size;
  return [left, top, width * size, height * size];
}

/** Moves the view so that the picture fills the canvas wherever it is large enough. */
function setView(canvas, { zoom, x, y }) {
  const [width, height] = scene().resolution;
  const bounded = Math.max(1, Math.min(MOST_ZOOM, zoom));
  const fit = Math.min(canvas.width / width, canvas.height / height) * bounded;
  const within = (value, length, side) => {
    const half = length / (2 * fit * side);
    return half >= 0.5 ? 0.5 : Math.max(half, Math.min(1 - half, value));
  };
  change({ view: { zoom: bounded, x: within(x, canvas.width, width), y: within(y, canvas.height, height) } });
}

function draw() {
  for (const { canvas, picture } of canvases) drawOn(canvas, picture ?? state.picture);
  const shown = scene().pictures[state.picture];
  if (!state.tiles) canvases[0]?.canvas.setAttribute('aria-label', `${label(shown)}, ${modeName()}`);
  drawPanel(shown);
}

function drawOn(canvas, picture) {
  const [width, height] = scene().resolution;
  const room = canvas.clientWidth;
  const most = state.tiles ? Infinity : Math.max(240, 0.72 * window.innerHeight);
  const shownHeight = Math.round(Math.min((room * height) / width, most));
  const ratio = window.devicePixelRatio || 1;
  canvas.style.height = `${shownHeight}px`;
  canvas.width = Math.max(1, Math.round(room * ratio));
  canvas.height = Math.max(1, Math.round(shownHeight * ratio));
  canvas.classList.toggle('zoomed', state.view.zoom > 1);
  const context = canvas.getContext('2d');
  const [left, top, w, h] = placement(canvas);
  // Reduced pictures are smoothed, enlarged ones show their pixels.
  context.imageSmoothingEnabled = pixelSize(canvas) < 1;
  context.drawImage(paint(picture), left, top, w, h);
  context.lineWidth = 1.5 * ratio;
  for (const { rectangle: [x, y, cw, ch], color } of scene().crops) {
    const size = pixelSize(canvas);
    context.strokeStyle = color;
    context.strokeRect(left + x * size, top + y * size, cw * size, ch * size);
  }
}

const modeName = () => ({ image: 'picture', signed: 'signed error', absolute: 'absolute error' })[state.mode];

function drawPanel(shown) {
  element('shown').replaceChildren(`${state.picture + 1}  ${label(shown)}`);
  const list = element('shown-numbers');
  list.replaceChildren();
  const add = (term, text) => list.append(make('dt', {}, term), make('dd', {}, text));
  if (shown.reference) {
    const floor = scene().floors[shown.reference];
    add('Made of', shown.made);
    if (floor) add('Noise', `${short(floor.display)} (sRGB RMSE)`);
  } else {
    const row = rowOf(shown);
    const { display } = row.errors[referenceName()];
    add('Rank', places(row.errors[referenceName()]));
    add('Time', `${short(1e3 * row.seconds)} ms`);
    add('RMSE', short(display.rmse));
    add('PSNR', display.psnr === null ? '∞' : `${display.psnr.toFixed(2)} dB`);
    add('SSIM', display.ssim.toFixed(4));
  }
  drawScaleBar();
}

function drawScaleBar() {
  element('scale-bar').hidden = state.mode === 'image';
  if (state.mode === 'image') return;
  const canvas = element('ramp');
  const colors = state.mode === 'signed' ? SIGNED : ABSOLUTE;
  canvas.width = colors.length / 3;
  const image = new ImageData(canvas.width, 1);
  for (let i = 0; i < canvas.width; i += 1) {
    image.data.set([colors[3 * i], colors[3 * i + 1], colors[3 * i + 2], 255], 4 * i);
  }
  canvas.getContext('2d').putImageData(image, 0, 0);
  const end = short(errorScale());
  const labels = state.mode === 'signed' ? [`−${end} too dark`, '0', `too bright +${end}`] : ['0', 'mean over R, G, B', `${end} W·m⁻²·sr⁻¹`];
  element('ramp-labels').replaceChildren(...labels.map((text) => make('span', {}, text)));
}
