#!/usr/bin/env node
/**
 * Pictures of docs/tutorial-dip.md, taken of pages that bolter writes, in Debian's chromium.
 * usage: node scripts/pictures.mjs [BUILD]      from the root of the repository
 */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const build = resolve(process.argv[2] ?? "build");
const out = resolve("docs/figures");
const { chromium } = await import(pathToFileURL(join(build, "web/node_modules/playwright-core/index.mjs")));
const folder = mkdtempSync(join(tmpdir(), "bolter-pictures-"));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

async function landing(distance) {
  const file = join(folder, `${distance.replace(" ", "")}.html`);
  execFileSync(join(build, "bolter"), ["land", "studies/reference/study.yaml", "--set", `landing.distance=${distance}`, "-o", file]);
  const page = await browser.newPage({ viewport: { width: 860, height: 900 }, offline: true });
  await page.goto(`file://${file}`);
  await page.evaluate(() => bolterPlayer.start());
  return page;
}

/** One camera at a time that `at` finds in the landing's events. */
async function shot(page, view, event, after, name) {
  await page.evaluate(([view, event, after]) => {
    bolterPlayer.look(view);
    bolterPlayer.time = bolterPlayer.stages[0].motion.record.events.find((e) => e.what.includes(event)).time_s + after;
    bolterPlayer.draw();
  }, [view, event, after]);
  await page.locator(".stage canvas").screenshot({ path: join(out, name) });
}

/** Heights over time, by gnuplot, until the hook has met the cable. */
function drawHeights(rows) {
  writeFileSync(join(folder, "heights.dat"), rows.filter((row) => row[0] <= 0.2).map((row) => row.join(" ")).join("\n") + "\n");
  execFileSync("gnuplot", ["-e", `
    set terminal svg size 820,330 font 'sans-serif,13' background 'white'; set output '${join(out, "dip_heights.svg")}';
    set border 3 lc rgb '#404040'; set tics nomirror out; set grid lc rgb '#d8d8d8'; set key top right;
    set xlabel 'time from first contact, s'; set ylabel 'height above the deck, mm'; set yrange [0:100]; set xrange [0:0.2];
    set arrow from 0.0662,0 to 0.0662,84 nohead dt 2 lc rgb '#808080'; set label 'wheels on the cable' at 0.0645,90 right;
    data = '${join(folder, "heights.dat")}';
    plot data using 1:4 with lines lw 2 lc rgb '#009e73' title 'centre of the cable where the hook comes',
         data using 1:3 with lines lw 2 lc rgb '#d55e00' title 'lip of the hook',
         data using 1:2 with lines lw 2 lc rgb '#0072b2' title 'lowest point of the hook'`]);
}

try {
  const missed = await landing("8 m");
  await shot(missed, "side", "left wheel on the cable", 0.0005, "dip_wheels.png");
  await shot(missed, "hook", "hook meets the cable", 0.0003, "dip_missed.png");
  drawHeights(await missed.evaluate(() => {
    const { time, curves } = bolterPlayer.stages[0].motion;
    return Array.from(time, (t, i) => [t, ...["hook_height_m", "lip_z_m", "cable_height_m"].map((name) => 1000 * curves[name].values[i])]);
  }));
  const caught = await landing("9 m");
  await shot(caught, "hook", "hook meets the cable", 0.0003, "dip_caught.png");
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
