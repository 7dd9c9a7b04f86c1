/** Elements without markup: every text becomes a text node, so nothing a study says is ever read as HTML. */

/**
 * @param {string} name @param {Object<string, any>} [attributes] `on…` are listeners
 * @param {...(Node|string|null|undefined)} children @returns {HTMLElement}
 */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value == null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? "" : String(value));
  }
  made.append(...children.filter((child) => child != null));
  return made;
}

/** A table with a heading row; numbers are aligned to the right. */
export function table(columns, rows) {
  const cell = (name) => (value) =>
    element(name, { class: typeof value === "number" ? "number" : null }, value instanceof Node ? value : String(value ?? ""));
  return element("div", { class: "wide", tabindex: 0 },
    element("table", {},
      element("thead", {}, element("tr", {}, ...columns.map((name) => element("th", { scope: "col" }, name)))),
      element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell("td")))))));
}

/** Hands the reader a file made of a text. */
export function save(name, text, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
