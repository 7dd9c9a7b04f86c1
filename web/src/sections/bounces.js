import * as Plot from "@observablehq/plot";
import { interpolatePlasma } from "d3";
import { element } from "../dom.js";
import { acrossAxis, below, figure, key, plotStyle } from "../figure.js";

/** Steps from dark violet to orange, told apart in grey as well. */
const ramp = (count) => Array.from({ length: count }, (_, i) => interpolatePlasma((0.85 * i) / Math.max(1, count - 1)));

/** How the hook bounces over a key: Figs. 14 to 16 of the reference study. */
export function bounces(data) {
  const sweeps = data.bounces ?? [];
  if (!sweeps.length) return null;
  return element("section", { id: "bounces" }, element("h2", {}, "How the hook bounces"),
    ...sweeps.map((sweep) => {
      const labels = sweep.curves.map((c) => c.label);
      const points = sweep.curves.flatMap((c) => c.travelled.map((x, i) => ({ x, height: 1000 * c.height[i], value: c.label })));
      return figure({
        name: `bounces-${sweep.key.replaceAll(".", "-")}`, caption: sweep.caption,
        columns: [sweep.key, "travelled [m]", "height [mm]"], rows: points.map((p) => [p.value, p.x, p.height]),
        draw: (width) => Plot.plot({
          width, height: 300, style: plotStyle, ...below, color: { legend: false, range: ramp(labels.length), domain: labels },
          x: acrossAxis("along the deck from first contact, m"), y: { label: "height of the hook, mm", grid: true },
          marks: [Plot.line(points, { x: "x", y: "height", stroke: "value", z: "value" }),
            ...key(labels, (_, i) => ramp(labels.length)[i])],
        }),
      });
    }));
}
