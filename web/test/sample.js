/** A small page's data, made up: enough to draw every section and to play one landing. */

const base64 = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");

/** Numbers as the page's Packed. */
export function pack(values, width) {
  const least = Math.min(...values);
  const greatest = Math.max(...values, least + 1e-9);
  const steps = Uint16Array.from(values, (v) => Math.round((65535 * (v - least)) / (greatest - least)));
  return { width, least, greatest, steps: base64(steps) };
}

export const floats32 = (values) => base64(Float32Array.from(values));

const BODIES = ["fuselage", "nose_piston", "left_piston", "right_piston", "nose_wheel", "left_wheel", "right_wheel", "hook"];
const PLACES = [[0, 0, 2.6], [4.3, 0, 1.2], [-1.2, 2.4, 1.2], [-1.2, -2.4, 1.2], [4.3, 0, 0.4], [-1.2, 2.4, 0.47], [-1.2, -2.4, 0.47], [-6, 0, 1]];

/** A landing that glides along x at 40 m/s for 0.2 s. */
export function landing(run, outcome = "missed", mode = "ridden_over") {
  const rows = 101;
  const times = Array.from({ length: rows }, (_, i) => i * 0.002);
  const shift = (t) => -6 + 40 * t;
  const nodes = 41;
  const ropeY = Array.from({ length: nodes }, (_, i) => -18 + (36 * i) / (nodes - 1));
  const each = (f) => pack(times.flatMap(f), 1);
  return {
    run, name: `landing ${run}`, outcome, mode, margin_m: -0.0088,
    events: [{ time_s: 0, what: "touchdown" }, { time_s: 0.15, what: "hook meets cable" }],
    time: floats32(times),
    bodies: {
      names: BODIES,
      position: pack(times.flatMap((t) => PLACES.flatMap(([x, y, z]) => [x + shift(t), y, z])), 24),
      attitude: pack(times.flatMap(() => BODIES.flatMap((b) => (b === "hook" ? [Math.cos(0.45), 0, Math.sin(0.45), 0] : [1, 0, 0, 0]))), 32),
    },
    cable: {
      nodes,
      position: pack(times.flatMap((t) => ropeY.flatMap((y) => [0, y, 0.1 - 0.05 * Math.exp(-y * y) * Math.sin(20 * t)])), 3 * nodes),
      tension: pack(times.flatMap((t) => ropeY.map((y) => 24e3 + 1e5 * t * Math.exp(-y * y))), nodes),
    },
    curves: {
      lip_x_m: each((t) => shift(t) - 7), lip_y_m: each(() => 0), lip_z_m: each((t) => 0.05 + 0.02 * Math.sin(30 * t)),
      hook_height_m: each((t) => 0.02 * Math.abs(Math.sin(30 * t))), cable_height_m: each((t) => 0.1 - 0.05 * Math.sin(20 * t)),
      cable_tension_N: each((t) => 24e3 + 1e5 * t), tyre_nose_N: each(() => 0), tyre_left_N: each((t) => 2e5 * t), tyre_right_N: each((t) => 2e5 * t),
      strut_nose_N: each(() => 0), strut_left_N: each((t) => 1.5e5 * t), strut_right_N: each((t) => 1.5e5 * t), left_x_m: each((t) => shift(t) - 1.2),
    },
    geometry: {
      fuselage: { radius_m: 0.9, length_m: 14, middle_m: -0.5, height_m: 0.2, span_m: 12, chord_m: 3,
        struts: [{ top: [4.3, 0, 0], foot: [4.3, 0, -1.4] }, { top: [-1.2, 2.4, 0], foot: [-1.2, 2.4, -1.4] }, { top: [-1.2, -2.4, 0], foot: [-1.2, -2.4, -1.4] }] },
      pistons: [], wheels: [
        { body: "nose_wheel", radius_m: 0.28, width_m: 0.3 }, { body: "left_wheel", radius_m: 0.47, width_m: 0.29 }, { body: "right_wheel", radius_m: 0.47, width_m: 0.29 }],
      hook: { outline: [[-0.08, 0], [0, -0.08], [0.06, -0.05], [0.02, 0], [0.02, 0.02], [-0.05, 0.05]], width_m: 0.12, shoe_m: [1.06, 0, 0],
        shank: [[1, 0, 0], [-1.3, 0, 0]], arm_radius_m: 0.02 },
      deck: { span_m: 36, supports_m: [-5.7, 5.7], support_height_m: 0.097, sheave_height_m: 0.1, rope_radius_m: 0.018 },
      forces: [{ curve: "tyre_left_N", x: "left_x_m", side: 2.4, metres_per_newton: 1e-5 }],
    },
  };
}

export function sample(title = "Hook and cable, a made-up study") {
  const inputs = [
    { path: "landing.sink_speed", label: "sink speed", unit: "m/s", factor: 1 },
    { path: "landing.distance", label: "distance", unit: "m", factor: 1 }];
  const modes = ["direct", "arm", "ridden_over", "bounced_over"];
  const n = 400;
  const x = Array.from({ length: n }, (_, i) => [2 + 0.01 * (i % 97) * 4, 1 + 0.02 * ((i * 37) % n)]);
  return {
    title, reference_study: true, inputs, modes,
    counts: { landings: n, engaged: 300, missed: 100, failed: 0 },
    reliability: {
      overall: { corrected: 0.957, corrected_ci95: [0.953, 0.961], landings: n }, warnings: [],
      conditions: [2, 4, 5, 6, 8, 10].map((value, i) => ({ parameter: "landing.distance", value, unit: "m", corrected: [0.58, 0.93, 0.96, 0.94, 0.91, 0.96][i],
        corrected_ci95: [[0.57, 0.59], [0.92, 0.94], [0.95, 0.97], [0.93, 0.95], [0.9, 0.92], [0.95, 0.97]][i], surrogate: [0.59, 0.93, 0.965, 0.946, 0.937, 0.988][i] })),
      differences: [{ parameter: "landing.distance", from: 6, to: 8, difference: -0.038, ci95: [-0.044, -0.032] }],
    },
    convergence: [{ landings: 1024, overall: 0.006, median: 0.012, largest: 0.03 }, { landings: 4096, overall: 0.003, median: 0.006, largest: 0.014 }, { landings: 8192, overall: 0.002, median: 0.0045, largest: 0.009 }],
    landings: {
      inputs: floats32(x.flat()), margins: floats32(x.map(([, d]) => (d < 3 ? -0.005 : 0.03))),
      modes: x.map(([, d], i) => (d < 3 ? "c" : i % 7 ? "b" : "a")).join(""),
    },
    atlas: [{ mode: "ridden_over", region: "distance 1 .. 3 m", share: 1, run: 17 }],
    playback: [landing(17), landing(18, "engaged", "arm")],
    sensitivity: inputs.map((i, k) => ({ path: i.path, first: 0.2 + 0.2 * k, first_ci95: [0.15 + 0.2 * k, 0.25 + 0.2 * k], total: 0.4 + 0.2 * k, total_ci95: [0.3 + 0.2 * k, 0.5 + 0.2 * k] })),
    bounces: [{ key: "landing.sink_speed", caption: "First bounce of the hook over sink speed (Fig. 14).", curves: [3.6, 6.3].map((v) => ({
      label: `${v} m/s`, travelled: Array.from({ length: 30 }, (_, i) => i * 0.1), height: Array.from({ length: 30 }, (_, i) => 0.01 * v * Math.abs(Math.sin(i / 8))) })) }],
    rigs: [{ name: "nose_drop", title: "Drop of the nose gear", metrics: [{ name: "stroke_max_m", value: 0.4352, unit: "m", reference: 0.435, error_percent: 0.05 }],
      figures: [{ name: "stroke", caption: "Stroke over time.", label: "stroke, m", x: { label: "time, s", values: [0, 0.1, 0.2] }, y: [{ label: "stroke", values: [0, 0.4, 0.3] }] }] }],
    surrogate: { holdout_accuracy: 0.981, holdout_ci95: [0.975, 0.986], holdout_n: 1639, train_accuracy: 0.99, support_vectors: 400, C: 1000, gamma: 0.1,
      confusion: { engaged_engaged: 1300, engaged_missed: 12, missed_engaged: 18, missed_missed: 309 },
      calibration: [-2, -1, -0.5, 0.5, 1, 2].map((d) => ({ decision: d, share: d > 0 ? 0.98 : 0.03, ci95: d > 0 ? [0.96, 0.99] : [0.01, 0.05], n: 100 })) },
    sources: [{ path: "aircraft.mass", value: "18200 kg", source: "assumed" }],
    study: { file: "study.yaml", text: "title: made up\n", commands: ["bolter study study.yaml"] },
    versions: { bolter: "0.2.0" },
  };
}
