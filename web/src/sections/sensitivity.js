import * as Plot from "@observablehq/plot";
import { element } from "../dom.js";
import { acrossAxis, below, figure, plotStyle, series } from "../figure.js";

/** Which input drives the scatter of outcomes: Sobol' indices with their intervals. */
export function sensitivity(data) {
  const rows = data.sensitivity ?? [];
  if (!rows.length) return null;
  const label = (row) => data.inputs.find((i) => i.path === row.path)?.label ?? row.path;
  const tall = rows.flatMap((r) => [
    { label: label(r), what: "alone", ...r.first, low: r.first_ci95?.[0], high: r.first_ci95?.[1], value: r.first },
    { label: label(r), what: "with interactions", low: r.total_ci95?.[0], high: r.total_ci95?.[1], value: r.total }]);
  return element("section", { id: "sensitivity" },
    element("h2", {}, "Which input decides"),
    element("p", { class: "legend" }, ...["alone", "with interactions"].map((what, i) =>
      element("span", {}, element("i", { style: `background:${series[i]}` }), what))),
    figure({
      name: "sensitivity", caption: "Sobol' indices: share of the variance of the outcome, by each input alone and with its interactions.",
      columns: ["input", "which", "value", "lower", "upper"], rows: tall.map((r) => [r.label, r.what, r.value, r.low, r.high]),
      draw: (width) => Plot.plot({
        width, height: 80 + 52 * rows.length, style: plotStyle, marginLeft: 130, ...below,
        x: { ...acrossAxis("share of the variance"), domain: [0, 1], clamp: true }, fy: { label: null }, y: { axis: null },
        color: { domain: ["alone", "with interactions"], range: series },
        marks: [
          Plot.barX(tall, { x: "value", y: "what", fy: "label", fill: "what" }),
          Plot.ruleY(tall, { x1: "low", x2: "high", y: "what", fy: "label" })],
      }),
    }));
}
