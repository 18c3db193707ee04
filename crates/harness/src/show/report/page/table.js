// The table of a scene against a reference.
/** What a row is compared with: the baseline on the same machine. */
const baseline = (row) => scene().rows.find(({ variant, machine, outcome }) => (
  variant === data.baseline && machine === row.machine && outcome === 'done'));
const errorsOf = (row) => row.errors[referenceName()];
/** The places that a row may have. */
const places = ({ rank_best: best, rank_worst: worst }) => (best === worst ? String(best) : `${best}–${worst}`);
const over = (value, base) => (base ? value / base : null);
const counts = (row) => Object.entries(row.counters).map(([name, count]) => `${count} ${name}`).join(', ');

/** Columns by group; `value` sorts, `text` shows. */
const GROUPS = [
  ['', [
    { id: 'rank', title: 'rank', value: (row) => errorsOf(row).rank_best, text: (row) => places(errorsOf(row)) },
    { id: 'method', title: 'method', value: (row) => row.variant },
  ]],
  ['work', [
    { id: 'amount', title: 'amount', value: (row) => row.amount, text: (row) => String(row.amount ?? '') },
    { id: 'counts', title: 'counts', value: (row) => Object.values(row.counters)[0] ?? 0, text: counts, left: true },
  ]],
  ['time, ms', [
    { id: 'time', title: 'median', value: (row) => 1e3 * row.seconds },
    { id: 'quartiles', title: 'quartiles', value: (row) => row.seconds_upper - row.seconds_lower, text: (row) => `${short(1e3 * row.seconds_lower)}–${short(1e3 * row.seconds_upper)}` },
    { id: 'runs', title: 'n', value: (row) => row.runs, text: (row) => String(row.runs) },
    { id: 'time_ratio', title: '÷ base', value: (row) => over(row.seconds, baseline(row)?.seconds) },
    { id: 'bake', title: 'bake', value: (row) => (row.bake_seconds ? 1e3 * row.bake_seconds : null), optional: true },
    { id: 'prepare', title: 'preparation', value: (row) => 1e3 * row.prepare_seconds },
  ]],
  ['error of sRGB values', [
    { id: 'rmse', title: 'RMSE', value: (row) => errorsOf(row).error, best: Math.min },
    { id: 'interval', title: '95 %', value: (row) => errorsOf(row).error_interval?.[0] ?? null, text: (row) => errorsOf(row).error_interval?.map(short).join('–') ?? '', optional: true },
    { id: 'rmse_ratio', title: '÷ base', value: (row) => over(errorsOf(row).error, baseline(row) && errorsOf(baseline(row)).error),
      text: (row, value) => short(value) + (!errorsOf(row).differs_from_baseline && row.variant !== data.baseline ? ' ≈' : '') },
    { id: 'bias', title: 'bias', value: (row) => errorsOf(row).bias, optional: true },
    { id: 'deviation', title: 'deviation', value: (row) => errorsOf(row).deviation, optional: true },
    { id: 'psnr', title: 'PSNR dB', value: (row) => errorsOf(row).display.psnr ?? Infinity, text: (row, value) => (value === Infinity ? '∞' : value.toFixed(2)), best: Math.max },
    { id: 'ssim', title: 'SSIM', value: (row) => errorsOf(row).display.ssim, text: (row, value) => value.toFixed(4), best: Math.max },
    { id: 'flip', title: 'FLIP', value: (row) => errorsOf(row).display.flip ?? null, best: Math.min, optional: true },
  ]],
  ['error of radiance', [
    { id: 'linear_rmse', title: 'RMSE', value: (row) => errorsOf(row).linear.rmse, best: Math.min },
    { id: 'linear_mae', title: 'MAE', value: (row) => errorsOf(row).linear.mae },
    { id: 'linear_rel_mse', title: 'relMSE', value: (row) => errorsOf(row).linear.rel_mse },
    { id: 'linear_rel_mse_trimmed', title: 'relMSE trimmed', value: (row) => errorsOf(row).linear.rel_mse_trimmed ?? null, optional: true },
    { id: 'linear_smape', title: 'SMAPE', value: (row) => errorsOf(row).linear.smape },
  ]],
];

function drawTable() {
  const done = scene().rows.filter((row) => row.outcome === 'done');
  const has = (column) => !column.optional || done.some((row) => column.value(row) !== null);
  const groups = GROUPS.map(([title, columns]) => [title, columns.filter(has)]);
  const columns = groups.flatMap(([, list]) => list);
  const starts = new Set(groups.slice(1).map(([, list]) => list[0]));
  element('table-note').textContent = `${scene().name} against ${referenceName()}: ${scene().references[state.reference]}. Choose a column to sort, a method to see its picture.`;
  const table = element('table');
  table.replaceChildren(
    make('thead', {},
      make('tr', {}, ...groups.map(([title, list], index) => make('th', { colspan: list.length, scope: 'colgroup', class: index ? 'start' : '' }, title))),
      make('tr', {}, ...columns.map((column) => headCell(column, starts)))),
    make('tbody', {}, ...sorted(columns).map((row) => bodyRow(row, columns, starts, done))),
    make('tfoot', {}, floorRow(columns, starts)));
  markRow();
}

/** Marks the row of the picture shown. */
function markRow() {
  const shown = String(scene().pictures[state.picture].row);
  for (const line of document.querySelectorAll('#table tbody tr')) {
    line.classList.toggle('on', line.dataset.row === shown);
  }
}

const cellClass = (column, starts) => `${starts.has(column) ? 'start ' : ''}${column.left ? 'text' : ''}${column.id === 'method' ? 'method' : ''}`;

function headCell(column, starts) {
  const button = make('button', { type: 'button' }, column.title);
  const { sort } = state;
  button.addEventListener('click', () => sortBy(column.id));
  const cell = make('th', { scope: 'col', class: cellClass(column, starts), 'data-column': column.id }, button);
  if (sort.column === column.id) cell.setAttribute('aria-sort', sort.descending ? 'descending' : 'ascending');
  return cell;
}

function sortBy(column) {
  const again = state.sort.column === column;
  change({ sort: { column, descending: again && !state.sort.descending } });
  document.querySelector(`#table [data-column="${column}"] button`).focus({ preventScroll: true });
}

/** Rows in the order asked for; those without a picture last. */
function sorted(columns) {
  const column = columns.find(({ id }) => id === state.sort.column) ?? columns[0];
  const sign = state.sort.descending ? -1 : 1;
  const done = scene().rows.filter((row) => row.outcome === 'done');
  const key = (row) => column.value(row) ?? Infinity;
  done.sort((a, b) => (key(a) === key(b) ? a.variant - b.variant : sign * (key(a) < key(b) ? -1 : 1)));
  return [...done, ...scene().rows.filter((row) => row.outcome !== 'done')];
}

function methodCell(row, picture) {
  const variant = variantOf(row);
  const swatch = make('span', { class: 'swatch', style: `background:${variant.color}`, 'aria-hidden': 'true' });
  const mark = row.variant === data.baseline ? ' ●' : '';
  const cell = make('th', { scope: 'row', class: 'method row', title: variant.title });
  if (picture < 0) {
    cell.append(swatch, rowLabel(row) + mark);
    return cell;
  }
  const button = make('button', { type: 'button' }, swatch, rowLabel(row) + mark);
  button.addEventListener('click', () => change({ picture }));
  cell.append(button);
  return cell;
}

function bodyRow(row, columns, starts, done) {
  const index = scene().rows.indexOf(row);
  const picture = scene().pictures.findIndex((candidate) => candidate.row === index);
  const line = make('tr', { 'data-row': index });
  if (row.outcome !== 'done') {
    line.append(make('td'), methodCell(row, -1), make('td', { class: 'text start', colspan: columns.length - 2 }, `${row.outcome}: ${row.reason}`));
    return line;
  }
  for (const column of columns) {
    if (column.id === 'method') {
      line.append(methodCell(row, picture));
      continue;
    }
    const value = column.value(row);
    const best = column.best && value === column.best(...done.map(column.value));
    const text = value === null ? '' : (column.text ?? ((_, number) => short(number)))(row, value);
    line.append(make('td', { class: cellClass(column, starts) + (best ? ' best' : '') }, text));
  }
  return line;
}

function floorRow(columns, starts) {
  const floor = scene().floors[referenceName()];
  const value = { rmse: floor?.display, linear_rmse: floor?.linear };
  return make('tr', {}, ...columns.map((column) => (column.id === 'method'
    ? make('th', { scope: 'row', class: 'method' }, 'noise of the reference')
    : make('td', { class: cellClass(column, starts) }, short(value[column.id])))));
}
