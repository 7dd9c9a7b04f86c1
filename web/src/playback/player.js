import * as Plot from "@observablehq/plot";
import { element } from "../dom.js";
import { below, figure, plotStyle, series } from "../figure.js";
import { lanes } from "./lanes.js";
import { Motion } from "./motion.js";
import { Stage } from "./scene.js";

const SPEEDS = [1, 0.5, 0.1, 0.05, 0.02, 0.01, 0.005, 0.001];
const PANELS = [
  { label: "height, mm", scale: 1000, curves: { hook_height_m: "lowest point of the hook", lip_z_m: "its lip", cable_height_m: "cable at the hook" } },
  { label: "cable tension, kN", scale: 1e-3, curves: { cable_tension_N: "largest tension" } },
  { label: "tyres, kN", scale: 1e-3, curves: { tyre_nose_N: "nose", tyre_left_N: "left", tyre_right_N: "right" } },
  { label: "struts, kN", scale: 1e-3, curves: { strut_nose_N: "nose", strut_left_N: "left", strut_right_N: "right" } },
];

const say = (record) => `${record.name}: ${record.outcome}, ${record.mode.replaceAll("_", " ")}` +
  (Number.isFinite(record.margin_m) ? `, margin ${(1000 * record.margin_m).toFixed(1)} mm` : "");

/** Curves under the picture, with a cursor that moves with the time. */
function panel(motion, { label, scale, curves }, cursors) {
  const present = Object.entries(curves).filter(([name]) => motion.curves[name]?.values.some((value) => value !== 0));
  if (!present.length) return null;
  const points = present.flatMap(([name, what]) => Array.from(motion.time, (t, i) => ({ t, y: scale * motion.curves[name].values[i], what })));
  return figure({
    name: `landing-${label.split(",")[0].replaceAll(" ", "-")}`, caption: label, legend: present.map(([, what], i) => [what, series[i]]),
    columns: ["time [s]", ...present.map(([name]) => name)],
    rows: Array.from(motion.time, (t, i) => [t, ...present.map(([name]) => motion.curves[name].values[i])]),
    draw: (width) => {
      const svg = Plot.plot({
        width, height: 140, style: plotStyle, marginLeft: 55, ...below, x: { label: "time, s", grid: true, labelOffset: 36 }, y: { label: null, grid: true, ticks: 4 },
        color: { domain: present.map(([, what]) => what), range: series },
        marks: [Plot.line(points, { x: "t", y: "y", stroke: "what", z: "what" })],
      });
      const x = svg.scale("x");
      const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
      for (const [key, value] of Object.entries({ y1: 18, y2: 96, stroke: "currentColor", "stroke-width": 1.5, class: "cursor" })) line.setAttribute(key, value);
      svg.append(line);
      cursors.set(label, (time) => { const at = x.apply(time); line.setAttribute("x1", at); line.setAttribute("x2", at); });
      return svg;
    },
  });
}

/** Where an event's mark stands along the slider; what is near the end is read to the left. */
function place(motion, event) {
  const share = (100 * (event.time_s - motion.begin)) / (motion.end - motion.begin);
  return share > 60 ? `right:${100 - share}%;border-right:2px solid var(--mark)` : `left:${share}%;border-left:2px solid var(--mark)`;
}

/** The recorded landings with their controls: one, or two side by side, driven by one clock. */
export class Player {
  constructor(records) {
    this.records = records;
    this.motions = new Map();
    this.stages = [];
    this.chosen = [0, -1];
    this.lock = "time";
    this.speed = 0.1;
    this.playing = false;
    this.cursors = new Map();
    this.node = this.build();
  }

  motion(index) {
    if (!this.motions.has(index)) this.motions.set(index, new Motion(this.records[index]));
    return this.motions.get(index);
  }

  build() {
    const option = (value, text, selected) => element("option", { value, selected }, text);
    const names = (none) => [none ? option(-1, "nothing beside", true) : null, ...this.records.map((r, i) => option(i, say(r), !none && i === 0))];
    this.stageBox = element("div", { class: "stages" });
    this.curveBox = element("div", { class: "curves" });
    this.status = element("output", { class: "clock" });
    this.slider = element("input", { type: "range", min: 0, max: 10000, value: 0, "aria-label": "time", oninput: () => this.seek(this.slider.value / 10000) });
    this.marks = element("div", { class: "marks" });
    new ResizeObserver(() => this.stack()).observe(this.slider);
    this.button = element("button", { type: "button", onclick: () => this.toggle() }, "Play");
    const views = { side: "side", hook: "hook close-up", above: "above", orbit: "free" };
    return element("div", { class: "player", tabindex: 0, onkeydown: (event) => this.key(event) },
      element("p", { class: "controls" },
        element("label", {}, "landing ", element("select", { onchange: (e) => this.choose(0, Number(e.target.value)) }, ...names(false))), " ",
        this.records.length > 1 ? element("label", {}, "beside ", element("select", { onchange: (e) => this.choose(1, Number(e.target.value)) }, ...names(true))) : null, " ",
        element("label", {}, "locked in ", element("select", { onchange: (e) => { this.lock = e.target.value; this.draw(); } }, option("time", "time", true), option("place", "place")))),
      this.stageBox,
      element("p", { class: "controls" }, this.button, " ",
        element("label", {}, "speed ", element("select", { onchange: (e) => { this.speed = Number(e.target.value); } },
          ...SPEEDS.map((s) => option(s, s === 1 ? "real time" : `1/${Math.round(1 / s)}`, s === 0.1)))), " ",
        ...Object.entries(views).map(([view, text]) => element("button", { type: "button", "data-view": view, onclick: () => this.look(view) }, text)), " ", this.status),
      this.slider, this.marks, this.curveBox,
      element("p", { class: "note" }, "Space plays and stops; arrow keys step; 1 to 4 choose the camera; drag to turn, wheel to come closer. " +
        "Cable: blue where slack to red at its largest tension. Arrows: forces, each kind as long as its largest in this landing. " +
        "Legs, wheels, hook, cable and deck have the model's dimensions; the fuselage is a sketch."));
  }

  /** Called once the node is in the page. */
  start() { if (!this.stages.length) this.choose(0, this.chosen[0]); }

  choose(side, index) {
    this.chosen[side] = index;
    this.stages.forEach((stage) => stage.dispose());
    this.stageBox.replaceChildren();
    this.stages = this.chosen.filter((i) => i >= 0).map((i) => {
      const canvas = element("canvas", { "aria-label": say(this.records[i]), role: "img" });
      this.stageBox.append(element("div", { class: "stage" }, canvas, element("p", { class: "outcome" }, say(this.records[i]))));
      return new Stage(canvas, this.motion(i));
    });
    const first = this.stages[0].motion;
    this.time = first.begin;
    this.cursors.clear();
    this.curveBox.replaceChildren(...PANELS.map((p) => panel(first, p, this.cursors)).filter(Boolean));
    this.marks.replaceChildren(...first.record.events.map((event) =>
      element("button", { type: "button", title: event.what, style: place(first, event),
        onclick: () => { this.time = event.time_s; this.draw(); } }, event.what)));
    this.stack();
    this.draw();
  }

  /** Puts the marks one below another where their texts would meet. */
  stack() {
    const buttons = [...this.marks.children];
    const lane = lanes(buttons.map((b) => [b.offsetLeft, b.offsetLeft + b.offsetWidth]));
    buttons.forEach((b, i) => { b.style.top = `${1.35 * lane[i]}rem`; });
    this.marks.style.height = `${1.35 * (1 + Math.max(-1, ...lane))}rem`;
  }

  look(view) { this.stages.forEach((stage) => stage.look(view)); this.draw(); }

  seek(share) {
    const m = this.stages[0].motion;
    this.time = m.begin + share * (m.end - m.begin);
    this.draw();
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "Stop" : "Play";
    if (!this.playing) return;
    if (this.time >= this.stages[0].motion.end) this.time = this.stages[0].motion.begin;
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      this.time += (this.speed * (now - before)) / 1000;
      before = now;
      if (this.time >= this.stages[0].motion.end) { this.time = this.stages[0].motion.end; this.toggle(); }
      this.draw();
      if (this.playing) requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  key(event) {
    const m = this.stages[0].motion;
    const step = (m.end - m.begin) / 200;
    const views = ["side", "hook", "above", "orbit"];
    if (["SELECT", "INPUT"].includes(event.target.tagName)) return;
    if (event.key === " ") this.toggle();
    else if (event.key === "ArrowRight") { this.time = Math.min(m.end, this.time + step); this.draw(); }
    else if (event.key === "ArrowLeft") { this.time = Math.max(m.begin, this.time - step); this.draw(); }
    else if (views["1234".indexOf(event.key)]) this.look(views["1234".indexOf(event.key)]);
    else return;
    event.preventDefault();
  }

  draw() {
    const [first, second] = this.stages;
    first.show(this.time);
    if (second) second.show(this.lock === "time" ? this.time : second.motion.when(first.motion.value("lip_x_m", this.time)));
    const m = first.motion;
    this.slider.value = (10000 * (this.time - m.begin)) / (m.end - m.begin);
    this.status.textContent = `t = ${this.time.toFixed(4)} s`;
    this.cursors.forEach((move) => move(this.time));
  }

  resize() { this.stages.forEach((stage) => stage.resize()); if (this.stages.length) this.draw(); }
}
