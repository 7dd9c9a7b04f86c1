import { read } from "./data.js";
import { element } from "./dom.js";
import { Player } from "./playback/player.js";
import { answer } from "./sections/answer.js";
import { atlas } from "./sections/atlas.js";
import { bounces } from "./sections/bounces.js";
import { conditions } from "./sections/conditions.js";
import { convergence } from "./sections/convergence.js";
import { rigs } from "./sections/rigs.js";
import { sensitivity } from "./sections/sensitivity.js";
import { study } from "./sections/study.js";
import { surrogate } from "./sections/surrogate.js";

const data = read(document);
document.title = data.title;
const player = data.playback?.length ? new Player(data.playback) : null;

/** A landing picked in the atlas, if it was recorded. */
function show(landing) {
  const index = data.playback?.findIndex((record) => record.run === landing.run) ?? -1;
  if (index < 0) return;
  player.choose(0, index);
  document.getElementById("playback").scrollIntoView({ behavior: "smooth" });
}

const sections = [
  answer(data), conditions(data), convergence(data), atlas(data, show),
  player ? element("section", { id: "playback" }, element("h2", {}, "Landings to look at"), player.node) : null,
  sensitivity(data), bounces(data), rigs(data), surrogate(data), data.study ? study(data) : null,
].filter(Boolean);
const titles = sections.flatMap((s) => [...s.querySelectorAll("h2")].slice(0, 1).map((h) => [s.id, h.textContent]));
document.getElementById("page").append(
  element("nav", { "aria-label": "contents" }, ...titles.map(([id, text]) => element("a", { href: `#${id}` }, text))),
  ...sections);
if (player) {
  globalThis.bolterPlayer = player;
  // The pictures in three dimensions are made when they are first looked at.
  const start = () => {
    try {
      player.start();
    } catch (error) {
      player.node.replaceChildren(element("p", { class: "warning" }, `The three-dimensional picture cannot be drawn here (${error.message}).`));
    }
  };
  const sight = new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) start(); }, { rootMargin: "200px" });
  sight.observe(player.node);
  addEventListener("beforeprint", start);
  new ResizeObserver(() => player.resize()).observe(player.node);
}
