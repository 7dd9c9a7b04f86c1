import { element, table } from "../dom.js";

/** The study's numbers, where they come from, and how to repeat everything. */
export function study(data) {
  const sources = data.sources ?? [];
  return element("section", { id: "study" },
    element("h2", {}, "The study's numbers"),
    sources.length ? element("details", {}, element("summary", {}, `${sources.length} numbers with their sources`),
      table(["key", "value", "where from"], sources.map((s) => [s.path, s.value, s.source]))) : null,
    element("details", {}, element("summary", {}, "The whole study file as it was used"), element("pre", { tabindex: 0 }, data.study.text)),
    element("h2", {}, "To repeat it"),
    element("pre", { tabindex: 0 }, data.study.commands.join("\n")),
    table(["what", "version"], Object.entries(data.versions)));
}
