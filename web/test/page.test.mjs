/** The page in headless Chromium with the network off: pages that bolter writes, opened from disk. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

const bolter = process.env.BOLTER;
const root = process.env.ROOT;
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const skip = !bolter || !root ? "BOLTER and ROOT are not set" : !chromium ? "there is no chromium" : false;

const hostile = '</script><img src=x onerror="window.injected=1"><b>title';
let browser, folder;

before(async () => {
  if (skip) return;
  const { chromium: launcher } = await import("playwright-core");
  folder = mkdtempSync(join(tmpdir(), "bolter-page-"));
  browser = await launcher.launch({
    executablePath: chromium,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

const run = (...words) => execFileSync(bolter, words, { cwd: root, encoding: "utf8" });

/** Opens a file offline; every error and every request of the page is a failure. */
async function open(file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 }, offline: true, ...options });
  page.faults = [];
  page.on("pageerror", (error) => page.faults.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") page.faults.push(message.text()); });
  page.on("request", (request) => { if (!/^(file|blob|data):/.test(request.url())) page.faults.push(request.url()); });
  await page.goto(`file://${file}`);
  await page.waitForSelector("nav");
  return page;
}

/** Numbers of a CSV of bolter's: columns by name. */
function table(file) {
  const lines = readFileSync(file, "utf8").trim().split("\n").filter((line) => !line.startsWith("#"));
  const names = lines[0].split(",").map((name) => name.replace(/ \[.*\]$/, ""));
  const rows = lines.slice(1).map((line) => line.split(",").map(Number));
  return Object.fromEntries(names.map((name, k) => [name, rows.map((row) => row[k])]));
}

test("playback puts the hook where the history has it", { skip }, async () => {
  const landing = ["land", "studies/reference/study.yaml", "--set", "landing.distance=8 m"];
  run(...landing, "-o", join(folder, "landing.html"));
  run(...landing, "-o", join(folder, "landing.csv"));
  const history = table(join(folder, "landing.csv"));
  const page = await open(join(folder, "landing.html"));
  await page.evaluate(() => bolterPlayer.start());
  const rows = history.time.length;
  for (const row of [Math.floor(0.2 * rows), Math.floor(0.5 * rows), Math.floor(0.95 * rows)]) {
    const shoe = await page.evaluate((time) => {
      bolterPlayer.time = time;
      bolterPlayer.draw();
      const stage = bolterPlayer.stages[0];
      const part = stage.parts[stage.hookBody];
      part.updateMatrixWorld(true);
      const point = part.position.clone().set(...stage.motion.record.geometry.hook.shoe_m);
      return part.localToWorld(point).toArray();
    }, history.time[row]);
    ["hook_shoe_x", "hook_shoe_y", "hook_shoe_z"].forEach((name, k) =>
      assert.ok(Math.abs(shoe[k] - history[name][row]) < 2e-3, `${name} at ${history.time[row]} s: ${shoe[k]}, history ${history[name][row]}`));
  }
  const drawn = await page.evaluate(() => bolterPlayer.stages[0].canvas.toDataURL().length);
  assert.ok(drawn > 5000, "the picture is empty");
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("a report shows the study, and what it says is never markup", { skip }, async () => {
  const study = join(folder, "study");
  run("study", "studies/reference/study.yaml", "--set", "campaign.samples=128", "--set", "reliability.samples=2000",
    "--set", "reliability.high_fidelity_runs=4", "--set", "surrogate.C=[1000]", "--set", "surrogate.gamma=[0.1]",
    "--set", `title=${hostile}`, "-o", study);
  const page = await open(join(study, "report.html"));
  assert.equal(await page.title(), hostile);
  assert.equal(await page.locator("h1").textContent(), hostile);
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.evaluate(() => globalThis.injected), undefined);
  for (const id of ["answer", "conditions", "atlas", "playback", "bounces", "rigs", "surrogate", "study"])
    assert.equal(await page.locator(`section#${id}`).count(), 1, id);
  const empty = await page.evaluate(() => [...document.querySelectorAll("figure svg")]
    .filter((svg) => svg.querySelectorAll("[aria-label=line] path, [aria-label=dot] *, [aria-label=bar] rect").length === 0).length);
  assert.equal(empty, 0, "figures without data");

  await page.evaluate(() => { bolterPlayer.start(); bolterPlayer.choose(1, 1); });
  assert.equal(await page.locator("#playback canvas").count(), 2);
  await page.locator(".player").focus();
  const before = await page.evaluate(() => bolterPlayer.time);
  await page.keyboard.press("ArrowRight");
  assert.ok((await page.evaluate(() => bolterPlayer.time)) > before);

  const paper = await page.pdf({ format: "A4" });
  assert.ok(paper.length > 50000);
  assert.deepEqual(page.faults, []);
  await page.close();

  const phone = await open(join(study, "report.html"), { viewport: { width: 390, height: 800 } });
  assert.ok((await phone.evaluate(() => document.documentElement.scrollWidth)) <= 390, "wider than a phone");
  assert.deepEqual(phone.faults, []);
  await phone.close();
});
