// Pictures as floats, and their colours.

/** Value of each half float by its bits. */
const HALVES = Float32Array.from({ length: 65536 }, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return exponent ? sign * 2 ** (exponent - 15) * (1 + fraction / 1024) : sign * 2 ** -24 * fraction;
});
/** 8 bits of sRGB (IEC 61966-2-1) of linear values from 0 to 1. */
const LEVELS = 8192;
const SRGB = Uint8Array.from({ length: LEVELS + 1 }, (_, level) => {
  const linear = level / LEVELS;
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
});
/** From none to the end of the scale: R, G, B. */
const ABSOLUTE = Uint8Array.from(JSON.parse(element('ramp-colors').textContent));
/** Too dark is blue, right is black, too bright is orange. */
const SIGNED = Uint8Array.from({ length: 3 * 511 }, (_, index) => {
  const t = (Math.floor(index / 3) - 255) / 255;
  const stops = t < 0 ? [[0, 0, 0], [45, 120, 230], [205, 232, 255]] : [[0, 0, 0], [225, 90, 25], [255, 226, 180]];
  const at = Math.min(1.999, 2 * Math.abs(t));
  const [a, b] = [stops[Math.floor(at)], stops[Math.floor(at) + 1]];
  return Math.round(a[index % 3] + (at % 1) * (b[index % 3] - a[index % 3]));
});
const MAGENTA = [255, 0, 255];

const decoded = new Map();
/** Radiance of a picture of a scene: R, G, B, row by row. */
function radiance(sceneIndex, pictureIndex) {
  const id = `picture-${sceneIndex}-${pictureIndex}`;
  if (!decoded.has(id)) {
    const bytes = atob(element(id).textContent);
    const { factor } = data.scenes[sceneIndex];
    const values = new Float32Array(bytes.length / 2);
    for (let i = 0; i < values.length; i += 1) {
      values[i] = HALVES[bytes.charCodeAt(2 * i) | (bytes.charCodeAt(2 * i + 1) << 8)] / factor;
    }
    decoded.set(id, values);
  }
  return decoded.get(id);
}

/** Mean over R, G, B of the differences of pixel `i`, or of their sizes. */
function meanError(values, truth, i, size) {
  const difference = (k) => values[3 * i + k] - truth[3 * i + k];
  if (size) return (Math.abs(difference(0)) + Math.abs(difference(1)) + Math.abs(difference(2))) / 3;
  return (difference(0) + difference(1) + difference(2)) / 3;
}

const painted = new Map();
/** A picture as the controls ask for it: a canvas, one pixel a pixel. */
function paint(pictureIndex) {
  const key = `${state.scene} ${pictureIndex}`;
  const wanted = `${state.mode} ${state.mode === 'image' ? state.stops : `${state.octaves} ${state.reference}`}`;
  let entry = painted.get(key);
  if (!entry) {
    const [width, height] = scene().resolution;
    entry = { canvas: make('canvas', { width, height }), wanted: '' };
    painted.set(key, entry);
  }
  if (entry.wanted !== wanted) {
    entry.wanted = wanted;
    const [width, height] = scene().resolution;
    const image = new ImageData(width, height);
    fillColors(image.data, radiance(state.scene, pictureIndex));
    entry.canvas.getContext('2d').putImageData(image, 0, 0);
  }
  return entry.canvas;
}

function fillColors(bytes, values) {
  const pixels = values.length / 3;
  const truth = radiance(state.scene, state.reference);
  const gain = scene().exposure * 2 ** state.stops * LEVELS;
  const scale = errorScale();
  for (let i = 0; i < pixels; i += 1) {
    let color = MAGENTA;
    let from = 0;
    if (state.mode === 'image') {
      const [r, g, b] = [values[3 * i] * gain, values[3 * i + 1] * gain, values[3 * i + 2] * gain];
      if (Number.isFinite(r + g + b)) color = [level(r), level(g), level(b)];
    } else {
      const error = meanError(values, truth, i, state.mode === 'absolute') / scale;
      if (Number.isFinite(error)) {
        const signed = state.mode === 'signed';
        color = signed ? SIGNED : ABSOLUTE;
        const t = Math.max(-1, Math.min(1, error));
        from = 3 * (Math.round(255 * t) + (signed ? 255 : 0));
      }
    }
    bytes[4 * i] = color[from];
    bytes[4 * i + 1] = color[from + 1];
    bytes[4 * i + 2] = color[from + 2];
    bytes[4 * i + 3] = 255;
  }
}

function level(value) {
  return SRGB[Math.round(Math.max(0, Math.min(LEVELS, value)))];
}
