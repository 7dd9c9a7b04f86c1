import * as Plot from "@observablehq/plot";
import { element } from "../dom.js";
import { acrossAxis, below, figure, key, plotStyle, series } from "../figure.js";

/** How the interval narrows as landings are added. */
export function convergence(data) {
  const rows = data.reliability?.convergence ?? data.convergence ?? [];
  if (rows.length < 2) return null;
  const widths = { overall: "all as distributed", median: "median of the conditions", largest: "largest of the conditions" };
  const names = Object.values(widths);
  const tall = rows.flatMap((r) => Object.entries(widths).map(([key, what]) => ({ landings: r.landings, width: 100 * r[key], what })));
  return element("section", { id: "convergence" },
    element("h2", {}, "How sure, after how many landings"),
    figure({
      name: "convergence", caption: "Half-width of the 95 % interval of the corrected estimate over the number of landings.",
      columns: ["landings", "overall_half_width", "median_half_width", "largest_half_width"],
      rows: rows.map((r) => [r.landings, r.overall, r.median, r.largest]),
      draw: (width) => Plot.plot({
        width, height: 280, style: plotStyle, ...below, color: { legend: false, range: series, domain: names },
        x: { ...acrossAxis("landings"), type: "log" }, y: { type: "log", label: "half-width, points", grid: true },
        marks: [
          Plot.line(tall, { x: "landings", y: "width", stroke: "what", marker: "circle" }),
          ...key(names, (_, i) => series[i])],
      }),
    }));
}
