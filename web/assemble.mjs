/**
 * Puts style and bundled script into the page: dist/page.html with @DATA@ where the data go.
 * usage: node assemble.mjs [OUT.html [DATA.json]]   with data: a page that can be opened
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const text = (name) => readFileSync(`${here}/${name}`, "utf8");

/** JSON that may stand inside a script element: no "<" can end it. */
export const safe = (json) => json.replaceAll("<", "\\u003c");

export function page(data = "@DATA@") {
  const parts = { STYLE: text("style.css"), SCRIPT: text("dist/page.js").replaceAll("</script", "<\\/script"), DATA: data };
  return text("page.html").replace(/@(STYLE|SCRIPT|DATA)@/g, (_, name) => parts[name]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const out = process.argv[2] ?? `${here}/dist/page.html`;
  mkdirSync(dirname(out), { recursive: true });
  writeFileSync(out, page(process.argv[3] ? safe(readFileSync(process.argv[3], "utf8")) : undefined));
}
