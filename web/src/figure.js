import * as Plot from "@observablehq/plot";
import { csv } from "./data.js";
import { element, save } from "./dom.js";

/** Colours that colour-blind readers can tell apart (Okabe and Ito), and a shape for each. */
export const colours = {
  engaged: "#0072b2", missed: "#d55e00", failed: "#777777",
  direct: "#0072b2", arm: "#56b4e9", ridden_over: "#d55e00", bounced_over: "#cc79a7",
  passed_over: "#e69f00", passed_beside: "#009e73", stopped: "#f0e442", none: "#777777",
};
export const symbols = {
  engaged: "circle", missed: "times", failed: "square",
  direct: "circle", arm: "circle", ridden_over: "times", bounced_over: "triangle",
  passed_over: "diamond", passed_beside: "plus", stopped: "star", none: "square",
};
export const series = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

const style = "font: 13px system-ui, sans-serif; overflow: visible; max-width: 100%;";

/** The styles of an SVG that leaves the page travel with it. */
function standalone(svg) {
  const copy = svg.cloneNode(true);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("style", `${style} color: black; background: white;`);
  return new XMLSerializer().serializeToString(copy);
}

/**
 * A figure: an SVG that is drawn anew at each width, its caption, and links to its picture and data.
 * @param {Object} of
 * @param {string} of.name      file name of picture and data
 * @param {string} of.caption
 * @param {(width: number) => SVGElement} of.draw
 * @param {string[]} of.columns
 * @param {any[][]} of.rows
 * @param {[string, string][]} [of.legend]  what the colours mean
 */
export function figure({ name, caption, draw, columns, rows, legend = [], max = 760 }) {
  const holder = element("div", { class: "drawing" });
  const link = (text, act) => element("button", { type: "button", class: "link", onclick: act }, text);
  let width = 0;
  const render = () => {
    const wanted = Math.max(280, Math.min(max, Math.floor(holder.clientWidth || max)));
    if (wanted === width) return;
    width = wanted;
    const svg = draw(width);
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", caption);
    holder.replaceChildren(svg);
  };
  const made = element("figure", { id: `figure-${name}` }, holder,
    element("figcaption", {}, caption, " ",
      ...legend.map(([what, colour]) => element("span", { class: "legend" }, element("span", {}, element("i", { style: `background:${colour}` }), what))), " ",
      element("span", { class: "links" },
        link("CSV", () => save(`${name}.csv`, csv(columns, rows), "text/csv")), " ",
        link("SVG", () => save(`${name}.svg`, standalone(holder.querySelector("svg")), "image/svg+xml")))));
  made.redraw = () => { width = 0; render(); };
  new ResizeObserver(render).observe(holder);
  queueMicrotask(render);
  return made;
}

export const plotStyle = style;

/** Room for the label of the x axis below its numbers. */
export const below = { marginBottom: 44 };
export const acrossAxis = (label) => ({ label, grid: true, labelOffset: 40 });

/** What the colours mean, in the picture itself: one line of text for each, at a corner. */
export function key(labels, colour, { anchor = "top-right", dx = -4, dy = 4 } = {}) {
  return labels.map((label, i) => Plot.text([label], {
    frameAnchor: anchor, text: (d) => d, fill: colour(label, i), dx, dy: dy + 16 * i, fontWeight: 600,
    stroke: "var(--plot-background, white)", strokeWidth: 4, paintOrder: "stroke",
  }));
}
