import { percent } from "../data.js";
import { element } from "../dom.js";

/** The answer in one sentence, and what it does not say. */
export function answer(data) {
  const all = data.reliability?.overall;
  const interval = all?.corrected_ci95;
  const parts = [element("h1", {}, data.title)];
  if (all)
    parts.push(element("p", { class: "answer" },
      "The hook catches the wire in ", element("strong", {}, percent(all.corrected, interval)),
      ` of landings drawn as this study says (95\u00a0% interval ${percent(interval?.[0], interval)} to ${percent(interval?.[1], interval)}).`));
  const counts = data.counts;
  if (counts)
    parts.push(element("p", {},
      `${counts.landings.toLocaleString("en")} landings of the full model were computed: ` +
      `${counts.engaged.toLocaleString("en")} engaged, ${counts.missed.toLocaleString("en")} missed, ` +
      `${counts.failed.toLocaleString("en")} failed (failed runs count as neither).`));
  if (all || counts) parts.push(element("p", { class: "note" },
    "The interval covers sampling and the error of the classifier. It does not cover how well the model and its numbers " +
    "describe a real aircraft, deck and pilot: numbers marked assumed or calibrated below have no measurement behind them."));
  for (const warning of data.reliability?.warnings ?? []) parts.push(element("p", { class: "warning" }, warning));
  return element("section", { id: "answer" }, ...parts);
}
