import * as Plot from "@observablehq/plot";
import { element, table } from "../dom.js";
import { acrossAxis, below, figure, key, plotStyle, series } from "../figure.js";

/** Rigs beside their references, with their curves. */
export function rigs(data) {
  const all = data.rigs ?? [];
  if (!all.length) return null;
  return element("section", { id: "rigs" }, element("h2", {}, "Verification rigs"),
    ...all.flatMap((rig) => [
      element("h3", {}, rig.title),
      table(["quantity", "value", "unit", "reference", "error, %"], rig.metrics.map((m) => [m.name, m.value, m.unit,
        m.reference ?? "", m.error_percent == null ? "" : Number(m.error_percent.toFixed(2))])),
      ...rig.figures.map((f) => {
        const points = f.y.flatMap((curve) => f.x.values.map((x, i) => ({ x, y: curve.values[i], what: curve.label })));
        return figure({
          name: `${rig.name}-${f.name}`, caption: f.caption,
          columns: [f.x.label, ...f.y.map((c) => c.label)], rows: f.x.values.map((x, i) => [x, ...f.y.map((c) => c.values[i])]),
          draw: (width) => Plot.plot({
            width, height: 280, style: plotStyle, marginLeft: 60, ...below,
            color: { domain: f.y.map((c) => c.label), range: series }, x: acrossAxis(f.x.label), y: { label: f.label, grid: true },
            marks: [Plot.line(points, { x: "x", y: "y", stroke: "what", z: "what" }),
              ...key(f.y.map((c) => c.label), (_, i) => series[i]),
              Plot.dot(f.measured ?? [], { x: "x", y: "y", stroke: "currentColor" })],
          }),
        });
      })]));
}
