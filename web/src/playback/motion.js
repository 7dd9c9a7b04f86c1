import { floats, locate, unpack } from "../data.js";

/**
 * A recorded landing, ready to be asked where everything is at a time. Deck frame: x forward, y to
 * port, z up; the cable rests at x = 0.
 */
export class Motion {
  /** @param {object} record one entry of data.playback */
  constructor(record) {
    this.record = record;
    this.time = floats(record.time);
    this.begin = this.time[0];
    this.end = this.time[this.time.length - 1];
    this.bodies = record.bodies.names.length;
    this.position = unpack(record.bodies.position);
    this.attitude = unpack(record.bodies.attitude);
    this.nodes = record.cable.nodes;
    this.cable = unpack(record.cable.position);
    this.tension = unpack(record.cable.tension);
    this.curves = Object.fromEntries(Object.entries(record.curves).map(([name, c]) => [name, { ...c, values: unpack(c) }]));
  }

  /** Three coordinates of a body's centre, m. */
  place(body, time, out = [0, 0, 0]) {
    const [row, share] = locate(this.time, time);
    const width = 3 * this.bodies;
    for (let i = 0; i < 3; ++i) {
      const a = this.position[row * width + 3 * body + i];
      const b = this.position[Math.min(row + 1, this.time.length - 1) * width + 3 * body + i];
      out[i] = a + share * (b - a);
    }
    return out;
  }

  /** Euler parameters e0..e3 of a body; between two rows along the shorter arc. */
  turn(body, time, out = [1, 0, 0, 0]) {
    const [row, share] = locate(this.time, time);
    const width = 4 * this.bodies;
    const next = Math.min(row + 1, this.time.length - 1);
    let along = 0;
    for (let i = 0; i < 4; ++i) along += this.attitude[row * width + 4 * body + i] * this.attitude[next * width + 4 * body + i];
    const sign = along < 0 ? -1 : 1;
    let norm = 0;
    for (let i = 0; i < 4; ++i) {
      const a = this.attitude[row * width + 4 * body + i];
      out[i] = a + share * (sign * this.attitude[next * width + 4 * body + i] - a);
      norm += out[i] * out[i];
    }
    for (let i = 0; i < 4; ++i) out[i] /= Math.sqrt(norm);
    return out;
  }

  /** The cable's nodes, [3 * nodes] m, and tensions, [nodes] N. */
  rope(time, points, tensions) {
    const [row, share] = locate(this.time, time);
    const next = Math.min(row + 1, this.time.length - 1);
    const width = 3 * this.nodes;
    for (let i = 0; i < width; ++i) {
      const a = this.cable[row * width + i];
      points[i] = a + share * (this.cable[next * width + i] - a);
    }
    for (let i = 0; i < this.nodes; ++i) {
      const a = this.tension[row * this.nodes + i];
      tensions[i] = a + share * (this.tension[next * this.nodes + i] - a);
    }
  }

  /** A recorded quantity at a time, SI. */
  value(name, time) {
    const curve = this.curves[name];
    if (!curve) return NaN;
    const [row, share] = locate(this.time, time);
    const a = curve.values[row];
    return a + share * (curve.values[Math.min(row + 1, curve.values.length - 1)] - a);
  }

  /** The time at which the hook's lip has come to a place along the deck. */
  when(place) {
    const x = this.curves.lip_x_m?.values;
    if (!x) return this.begin;
    const [row, share] = locate(x, place);
    return this.time[row] + share * (this.time[Math.min(row + 1, x.length - 1)] - this.time[row]);
  }
}
