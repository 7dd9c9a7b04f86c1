/**
 * What the page is given: one JSON text in the page itself. docs/report.md describes it.
 *
 * @typedef {Object} Packed  numbers as 16-bit steps between `least` and `greatest`
 * @property {number} width     values per row
 * @property {number} least
 * @property {number} greatest
 * @property {string} steps     base64 of little-endian unsigned 16-bit numbers, row after row
 */

/** @returns {object} the page's data */
export function read(document) {
  return JSON.parse(document.getElementById("data").textContent);
}

/** @param {string} text @returns {Uint8Array} */
export function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
  return out;
}

/**
 * Unpacks numbers. The error is at most half a step, (greatest - least) / 131070.
 * @param {Packed} packed @returns {Float32Array}
 */
export function unpack(packed) {
  const raw = bytes(packed.steps);
  const view = new DataView(raw.buffer);
  const step = (packed.greatest - packed.least) / 65535;
  const out = new Float32Array(raw.length / 2);
  for (let i = 0; i < out.length; ++i) out[i] = packed.least + step * view.getUint16(2 * i, true);
  return out;
}

/** @param {string} text base64 of little-endian 32-bit floats @returns {Float32Array} */
export function floats(text) {
  const raw = bytes(text);
  const view = new DataView(raw.buffer);
  const out = new Float32Array(raw.length / 4);
  for (let i = 0; i < out.length; ++i) out[i] = view.getFloat32(4 * i, true);
  return out;
}

/**
 * The row of a rising column that lies at or before a value, and the share of the way to the next.
 * @param {ArrayLike<number>} column @param {number} value @returns {[number, number]}
 */
export function locate(column, value) {
  let low = 0;
  let high = column.length - 1;
  if (high < 1 || !(value > column[0])) return [0, 0];
  if (value >= column[high]) return [high - 1, 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (column[middle] <= value) low = middle;
    else high = middle;
  }
  return [low, (value - column[low]) / (column[high] - column[low])];
}

/** A table as CSV: names with units in the heading, dot as decimal mark. */
export function csv(columns, rows) {
  const quote = (cell) => {
    const text = cell == null || Number.isNaN(cell) ? "" : String(cell);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [columns, ...rows].map((row) => row.map(quote).join(",")).join("\n") + "\n";
}

/** "95.7 %", with as many digits as the half-width of its interval deserves. */
export function percent(value, interval) {
  if (value == null || Number.isNaN(value)) return "–";
  const half = interval ? 50 * Math.abs(interval[1] - interval[0]) : 0.05;
  const digits = Math.max(1, Math.min(6, Math.ceil(-Math.log10(Math.max(half, 1e-7))) + 1));
  return `${(100 * value).toFixed(digits)} %`;
}
