// What is shown, and who is told when it changes.
const data = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);

const state = {
  scene: 0,
  reference: 0, // index into data.references: what errors are against
  picture: 0,
  mode: 'image', // or 'signed', 'absolute'
  stops: 0, // of exposure, beyond the scene's own
  octaves: 0, // of the error scale, beyond the scene's own
  tiles: false,
  view: { zoom: 1, x: 0.5, y: 0.5 }, // centre in parts of the picture
  sort: { column: 'rank', descending: false },
};
const watchers = [];
/** Calls `update` whenever one of the keys of the state changes, and at the start. */
function watch(keys, update) {
  watchers.push({ keys, update });
}
function change(values) {
  const changed = Object.keys(values).filter((key) => state[key] !== values[key]);
  Object.assign(state, values);
  for (const { keys, update } of watchers) {
    if (keys.some((key) => changed.includes(key))) update();
  }
}

const scene = () => data.scenes[state.scene];
const referenceName = () => data.references[state.reference];
const errorScale = () => scene().error_scale * 2 ** state.octaves;
const rowOf = (picture) => scene().rows[picture.row];
const variantOf = (row) => data.variants[row.variant];
/** Whether rows are told apart by their machine. */
const severalMachines = () => new Set(scene().rows.map(({ machine }) => machine)).size > 1;

/** Name of a picture: that of its method and settings, or of the reference. */
function label(picture) {
  return picture.reference ? `reference, ${picture.reference}` : rowLabel(rowOf(picture));
}
function rowLabel(row) {
  return variantOf(row).label + (severalMachines() ? ` @${row.machine}` : '');
}

/** Three significant digits, without an exponent where that is short. */
function short(value) {
  if (value === null || value === undefined) return '';
  const size = Math.abs(value);
  if (size === 0 || !Number.isFinite(value)) return String(value);
  if (size < 1e-4 || size >= 1e6) return value.toExponential(2);
  const rounded = Number(value.toPrecision(3));
  return rounded.toFixed(Math.max(0, 2 - Math.floor(Math.log10(Math.abs(rounded)))));
}

/** An element with attributes and children; text is text, never HTML. */
function make(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}
