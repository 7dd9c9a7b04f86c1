import assert from "node:assert/strict";
import { test } from "node:test";
import { csv, locate, percent, unpack } from "../src/data.js";
import { Motion } from "../src/playback/motion.js";
import { landings, thinned } from "../src/sections/atlas.js";
import { landing, pack, sample } from "./sample.js";

test("packed numbers come back within half a step", () => {
  const values = Array.from({ length: 1000 }, (_, i) => Math.sin(i) * 37);
  const packed = pack(values, 1);
  const half = (packed.greatest - packed.least) / 131070;
  unpack(packed).forEach((v, i) => assert.ok(Math.abs(v - values[i]) <= half + 1e-5));
});

test("a value is found between its neighbours, and held at the ends", () => {
  const column = [0, 1, 2, 4];
  assert.deepEqual(locate(column, 3), [2, 0.5]);
  assert.deepEqual(locate(column, -1), [0, 0]);
  assert.deepEqual(locate(column, 9), [2, 1]);
  assert.deepEqual(locate([5], 9), [0, 0]);
});

test("CSV quotes what would break a row", () => {
  assert.equal(csv(["a", "b"], [["x,y", 'say "z"'], [NaN, 2]]), 'a,b\n"x,y","say ""z"""\n,2\n');
});

test("digits follow the interval", () => {
  assert.equal(percent(0.957, [0.953, 0.961]), "95.7 %".replace("95.7", (95.7).toFixed(2)));
  assert.equal(percent(0.99991, [0.99983, 0.99996]), "99.9910 %");
  assert.equal(percent(null), "–");
});

test("a recorded landing is where it should be between its rows", () => {
  const motion = new Motion(landing(1));
  const at = motion.place(0, 0.101);
  assert.ok(Math.abs(at[0] - (-6 + 40 * 0.101)) < 1e-3);
  const e = motion.turn(7, 0.05);
  assert.ok(Math.abs(Math.hypot(...e) - 1) < 1e-6 && Math.abs(e[2] - Math.sin(0.45)) < 1e-3);
  assert.ok(Math.abs(motion.value("cable_tension_N", 0.1) - 34e3) < 10);
  assert.ok(Math.abs(motion.when(-10) - (13 - 10) / 40) < 1e-3);
  const points = new Float32Array(3 * motion.nodes);
  const tensions = new Float32Array(motion.nodes);
  motion.rope(0.1, points, tensions);
  assert.ok(Math.abs(points[1] + 18) < 1e-2 && tensions[0] >= 23e3);
});

test("every miss is drawn, the caught are thinned", () => {
  const all = landings(sample());
  const few = thinned(all, 150);
  const missed = (l) => l.mode === "ridden_over";
  assert.equal(few.filter(missed).length, all.filter(missed).length);
  assert.ok(few.length <= 151 && few.length > 100);
});
