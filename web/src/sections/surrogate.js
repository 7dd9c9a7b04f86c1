import * as Plot from "@observablehq/plot";
import { percent } from "../data.js";
import { element, table } from "../dom.js";
import { acrossAxis, below, figure, plotStyle, series } from "../figure.js";

/** How well the classifier does: hold-out, confusion, calibration. */
export function surrogate(data) {
  const s = data.surrogate;
  if (!s) return null;
  const c = s.confusion;
  const calibration = s.calibration ?? [];
  return element("section", { id: "surrogate" }, element("h2", {}, "The classifier"),
    element("p", {}, `Correct on ${percent(s.holdout_accuracy, s.holdout_ci95)} of ${s.holdout_n.toLocaleString("en")} held-out landings; ` +
      `on its own training landings ${percent(s.train_accuracy)}, which is no evidence of accuracy. ` +
      `${s.support_vectors.toLocaleString("en")} support vectors, C ${s.C}, gamma ${s.gamma}.`),
    c ? table(["held-out landings", "predicted engaged", "predicted missed"],
      [["engaged", c.engaged_engaged, c.engaged_missed], ["missed", c.missed_engaged, c.missed_missed]]) : null,
    calibration.length ? figure({
      name: "calibration", caption: "Share engaged of the landings in each class of decision value, with 95 % intervals: a good classifier steps from 0 to 1 at 0.",
      columns: ["decision", "share", "lower", "upper", "landings"], rows: calibration.map((r) => [r.decision, r.share, ...r.ci95, r.n]),
      draw: (width) => Plot.plot({
        width, height: 260, style: plotStyle, ...below, x: acrossAxis("decision value"), y: { label: "share engaged", domain: [0, 1], grid: true },
        marks: [Plot.ruleX(calibration, { x: "decision", y1: (r) => r.ci95[0], y2: (r) => r.ci95[1], stroke: series[0] }),
          Plot.dot(calibration, { x: "decision", y: "share", fill: series[0] }), Plot.ruleX([0], { strokeDasharray: "4" })],
      }),
    }) : null);
}
