// Elements by name, attributes and children. Text is always text: nothing here parses HTML.

export function h(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "class") element.className = value;
    else if (key in element && typeof value !== "string") element[key] = value;
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

// the same for SVG
export function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

export function put(element, ...children) {
  element.replaceChildren(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function card(title, ...children) {
  return h("section", { class: "card" }, h("h2", {}, title), ...children);
}

export function table(columns, rows, attributes = {}) {
  const head = columns.map((column) => {
    const [text, kind] = Array.isArray(column) ? column : [column, ""];
    return h("th", { scope: "col", class: kind }, text);
  });
  const kinds = columns.map((column) => (Array.isArray(column) ? column[1] : ""));
  const body = rows.map((row) =>
    h("tr", {}, row.map((cell, at) => h("td", { class: kinds[at] }, cell ?? ""))));
  return h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": attributes.label ?? "Table" },
    h("table", {}, h("thead", {}, h("tr", {}, head)), h("tbody", {}, body)));
}

export function toast(text, kind = "bad") {
  const place = document.getElementById("toasts");
  const shown = h("div", { class: `toast ${kind}` }, h("span", {}, text),
    h("button", { class: "quiet", "aria-label": "Close", onclick: () => shown.remove() }, "×"));
  place.append(shown);
  while (place.children.length > 4) place.firstChild.remove();
  setTimeout(() => shown.remove(), kind === "bad" ? 10000 : 4000);
}

export async function attempt(act, done = "") {
  try {
    const result = await act();
    if (done) toast(done, "ok");
    return result;
  } catch (error) {
    toast(error.message);
    return undefined;
  }
}

export function download(name, parts, type) {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

export function dialog(title, build, attributes = {}) {
  const box = h("dialog", { class: attributes.class ?? "", "aria-label": title });
  box.append(h("form", { method: "dialog", class: "dialog-head" }, h("h2", {}, title),
    h("button", { class: "quiet", "aria-label": "Close" }, "×")));
  box.append(build(box));
  box.addEventListener("close", () => { attributes.closed?.(); box.remove(); });
  document.body.append(box);
  box.showModal();
  return box;
}

export function remembered(key, otherwise) {
  try {
    return JSON.parse(localStorage.getItem(`plcsim.${key}`)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

export function remember(key, value) {
  try {
    localStorage.setItem(`plcsim.${key}`, JSON.stringify(value));
  } catch {
    // a browser that keeps nothing: it is kept until the page is closed
  }
}
