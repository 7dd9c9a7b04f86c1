import * as Plot from "@observablehq/plot";
import { element } from "../dom.js";
import { figure, plotStyle } from "../figure.js";

/** How the hook bounces over a key: Figs. 14 to 16 of the reference study. */
export function bounces(data) {
  const sweeps = data.bounces ?? [];
  if (!sweeps.length) return null;
  return element("section", { id: "bounces" }, element("h2", {}, "How the hook bounces"),
    ...sweeps.map((sweep) => {
      const points = sweep.curves.flatMap((c) => c.travelled.map((x, i) => ({ x, height: 1000 * c.height[i], value: c.label })));
      return figure({
        name: `bounces-${sweep.key.replaceAll(".", "-")}`, caption: sweep.caption,
        columns: [sweep.key, "travelled [m]", "height [mm]"], rows: points.map((p) => [p.value, p.x, p.height]),
        draw: (width) => Plot.plot({
          width, height: 280, style: plotStyle, color: { legend: false, scheme: "viridis", type: "ordinal", domain: sweep.curves.map((c) => c.label) },
          x: { label: "along the deck from first contact, m", grid: true }, y: { label: "height of the hook, mm", grid: true },
          marks: [Plot.line(points, { x: "x", y: "height", stroke: "value", z: "value" }),
            Plot.text(points, Plot.selectMaxY({ x: "x", y: "height", z: "value", text: "value", dy: -8 }))],
        }),
      });
    }));
}
