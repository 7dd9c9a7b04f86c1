import * as Plot from "@observablehq/plot";
import { floats } from "../data.js";
import { element, table } from "../dom.js";
import { acrossAxis, below, colours, figure, plotStyle, symbols } from "../figure.js";

const MOST = 3000;

/** The landings of the ledger as objects: inputs in display units, mode, margin. */
export function landings(data) {
  const packed = data.landings;
  if (!packed) return [];
  const width = data.inputs.length;
  const values = floats(packed.inputs);
  const margins = floats(packed.margins);
  return packed.modes.split("").map((code, i) => ({
    run: packed.runs ? packed.runs[i] : i,
    x: data.inputs.map((input, k) => values[i * width + k] * input.factor),
    mode: data.modes[code.charCodeAt(0) - 97],
    margin_mm: margins[i] * 1000,
  }));
}

/** Every miss, and as many of the caught as fit, evenly picked. */
export function thinned(all, most = MOST) {
  const caught = all.filter((l) => l.mode === "direct" || l.mode === "arm");
  const others = all.filter((l) => l.mode !== "direct" && l.mode !== "arm");
  const step = Math.max(1, caught.length / Math.max(1, most - others.length));
  const picked = [];
  for (let i = 0; i < caught.length; i += step) picked.push(caught[Math.floor(i)]);
  return [...picked, ...others.slice(0, most)];
}

function choice(label, inputs, value, act) {
  return element("label", {}, `${label} `,
    element("select", { onchange: (event) => act(Number(event.target.value)) },
      ...inputs.map((input, i) => element("option", { value: i, selected: i === value }, input.label))));
}

/** @param show called with a landing that was picked */
export function atlas(data, show) {
  const all = landings(data);
  if (!all.length) return null;
  const shown = thinned(all);
  const axis = [data.inputs.length - 1, 0];
  const present = [...new Set(shown.map((l) => l.mode))];
  const told = element("p", { "aria-live": "polite", class: "note" }, "Pick a point to see that landing.");
  const pick = (landing) => {
    told.textContent = `Landing ${landing.run}: ${landing.mode.replaceAll("_", " ")}` +
      (Number.isFinite(landing.margin_mm) ? `, margin ${landing.margin_mm.toFixed(1)} mm` : "") + "; " +
      data.inputs.map((input, k) => `${input.label} ${landing.x[k].toPrecision(4)} ${input.unit}`).join(", ") +
      `. To see it again: bolter replay ${data.study.file} ${landing.run}`;
    show(landing);
  };
  const made = figure({
    name: "atlas",
    caption: `Landings of the campaign by two inputs and how they ended (${shown.length.toLocaleString("en")} of ` +
      `${(data.counts?.landings ?? all.length).toLocaleString("en")} drawn: every miss, and a share of the rest).`,
    columns: ["run", ...data.inputs.map((i) => `${i.path} [${i.unit}]`), "mode", "margin [mm]"],
    rows: all.map((l) => [l.run, ...l.x, l.mode, l.margin_mm]),
    draw: (width) => {
      const [a, b] = axis.map((k) => data.inputs[k]);
      const svg = Plot.plot({
        width, height: Math.min(520, 0.7 * width), style: plotStyle, ...below,
        x: acrossAxis(`${a.label}, ${a.unit}`), y: { label: `${b.label}, ${b.unit}`, grid: true },
        color: { domain: present, range: present.map((m) => colours[m] ?? "#000") },
        symbol: { domain: present, range: present.map((m) => symbols[m] ?? "circle") },
        marks: [Plot.dot(shown, { x: (l) => l.x[axis[0]], y: (l) => l.x[axis[1]], stroke: "mode", symbol: "mode", r: 2.5, strokeOpacity: 0.8 })],
      });
      svg.querySelectorAll("g[aria-label=dot] > *").forEach((dot, i) => {
        dot.style.cursor = "pointer";
        dot.addEventListener("click", () => pick(shown[dot.__index ?? i]));
      });
      return svg;
    },
  });
  const total = data.counts?.landings ?? all.length;
  const legend = element("p", { class: "legend" }, ...present.map((mode) => {
    const count = data.counts?.modes?.[mode] ?? all.filter((l) => l.mode === mode).length;
    return element("span", {}, element("i", { style: `background:${colours[mode] ?? "#000"}` }),
      `${mode.replaceAll("_", " ")} ${count.toLocaleString("en")} (${((100 * count) / total).toFixed(1)} %)`);
  }));
  const select = (k) => (value) => { axis[k] = value; made.redraw(); };
  return element("section", { id: "atlas" },
    element("h2", {}, "Where landings miss"),
    element("p", { class: "controls" }, choice("across", data.inputs, axis[0], select(0)), " ", choice("up", data.inputs, axis[1], select(1))),
    legend, made, told,
    data.atlas?.length ? table(["how", "where", "share of the misses", "typical landing"],
      data.atlas.map((g) => [g.mode.replaceAll("_", " "), g.region, `${(100 * g.share).toFixed(1)} %`, g.run])) : null);
}
