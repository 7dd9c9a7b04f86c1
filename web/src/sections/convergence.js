import * as Plot from "@observablehq/plot";
import { element } from "../dom.js";
import { acrossAxis, below, figure, key, plotStyle, series } from "../figure.js";

/** How the interval narrows as landings are added. */
export function convergence(data) {
  const rows = data.reliability?.convergence ?? data.convergence ?? [];
  if (rows.length < 2) return null;
  const tall = rows.flatMap((r) => [
    { landings: r.landings, width: 100 * r.median, what: "median of the conditions" },
    { landings: r.landings, width: 100 * r.largest, what: "largest of the conditions" }]);
  return element("section", { id: "convergence" },
    element("h2", {}, "How sure, after how many landings"),
    figure({
      name: "convergence", caption: "Half-width of the 95 % interval of the corrected estimate over the number of landings.",
      columns: ["landings", "median_half_width", "largest_half_width"], rows: rows.map((r) => [r.landings, r.median, r.largest]),
      draw: (width) => Plot.plot({
        width, height: 280, style: plotStyle, ...below, color: { legend: false, range: series, domain: tall.slice(0, 2).map((r) => r.what) },
        x: { ...acrossAxis("landings"), type: "log" }, y: { type: "log", label: "half-width, points", grid: true },
        marks: [
          Plot.line(tall, { x: "landings", y: "width", stroke: "what", marker: "circle" }),
          ...key(tall.slice(0, 2).map((r) => r.what), (_, i) => series[i])],
      }),
    }));
}
