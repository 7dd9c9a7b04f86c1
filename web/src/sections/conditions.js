import * as Plot from "@observablehq/plot";
import { percent } from "../data.js";
import { element, table } from "../dom.js";
import { acrossAxis, below, figure, plotStyle, series } from "../figure.js";

const figures = {
  "landing.sink_speed": "Fig. 19", "landing.pitch": "Fig. 20",
  "landing.horizontal_speed": "Fig. 21", "landing.distance": "Fig. 22",
};

/** Reliability over the mean of one input: corrected with its interval, surrogate beside it. */
function curve(data, input, rows) {
  const at = (row) => row.value * input.factor;
  const paper = data.reference_study && figures[input.path] ? ` (the paper's ${figures[input.path]})` : "";
  return figure({
    name: `reliability-${input.path.replaceAll(".", "-")}`,
    caption: `Probability of engagement over the mean of ${input.label}${paper}. Bars: 95 % interval of the corrected estimate; ` +
      "crosses: the classifier alone; diamonds: landings of the campaign weighted, without a classifier.",
    columns: [`${input.path} [${input.unit}]`, "corrected", "lower", "upper", "surrogate", "surrogate_lower", "surrogate_upper",
      "reweighted", "reweighted_lower", "reweighted_upper"],
    rows: rows.map((r) => [at(r), r.corrected, ...(r.corrected_ci95 ?? []), r.surrogate, ...(r.surrogate_ci95 ?? ["", ""]), r.reweighted, ...(r.reweighted_ci95 ?? [])]),
    legend: ["corrected", "classifier alone", ...(rows.some((r) => r.reweighted != null) ? ["reweighted"] : [])].map((what, i) => [what, series[i]]),
    draw: (width) => Plot.plot({
      width, height: 320, style: plotStyle, marginLeft: 50, ...below,
      x: { ...acrossAxis(`mean of ${input.label}, ${input.unit}`), nice: true, inset: 6 },
      y: { label: "probability of engagement, %", percent: true, grid: true },
      marks: [
        Plot.ruleX(rows, { x: at, y1: (r) => r.corrected_ci95?.[0], y2: (r) => r.corrected_ci95?.[1], stroke: series[0], strokeWidth: 2 }),
        Plot.line(rows, { x: at, y: "corrected", stroke: series[0] }),
        Plot.dot(rows, { x: at, y: "corrected", fill: series[0], r: 4,
          title: (r) => `${at(r).toPrecision(4)} ${input.unit}: ${percent(r.corrected, r.corrected_ci95)}`, tip: true }),
        Plot.dot(rows, { x: at, y: "surrogate", stroke: series[1], symbol: "times", r: 4 }),
        Plot.dot(rows.filter((r) => r.reweighted != null), { x: at, y: "reweighted", stroke: series[2], symbol: "diamond", r: 4 }),
      ],
    }),
  });
}

export function conditions(data) {
  const all = data.reliability?.conditions ?? [];
  if (!all.length) return null;
  const inputs = data.inputs.filter((input) => all.some((row) => row.parameter === input.path));
  const differences = data.reliability.differences ?? [];
  return element("section", { id: "conditions" },
    element("h2", {}, "Reliability by condition"),
    ...inputs.map((input) => curve(data, input, all.filter((row) => row.parameter === input.path && row.corrected != null)
      .sort((a, b) => a.value - b.value))),
    differences.length ? element("details", {}, element("summary", {}, "Differences between conditions"),
      table(["input", "from", "to", "difference", "95 % interval"], differences.map((d) => {
        const input = inputs.find((i) => i.path === d.parameter);
        const value = (x) => (input ? `${(x * input.factor).toPrecision(3)} ${input.unit}` : String(x));
        return [input?.label ?? d.parameter, value(d.from), value(d.to), percent(d.difference, d.ci95),
          `${percent(d.ci95[0], d.ci95)} to ${percent(d.ci95[1], d.ci95)}`];
      }))) : null);
}
