// Logbook: live, filtered, to be downloaded.

import { download, h, put, setText } from "../dom.js";
import { link } from "../link.js";

const SEVERITIES = ["error", "warning", "information"];
const MOST = 2000;

export function show(page, ears) {
  let entries = [];
  const wanted = new Set(SEVERITIES);
  const text = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter the logbook", oninput: () => draw() });
  const kinds = SEVERITIES.map((each) => h("label", { class: "check" }, h("input", { type: "checkbox", checked: true, onchange: (event) => {
    if (event.target.checked) wanted.add(each); else wanted.delete(each);
    draw();
  } }), ` ${each}`));
  const body = h("tbody");
  const note = h("p", { class: "muted" });
  const get = h("button", { onclick: () => download(`${link.facts.project}-logbook.txt`, [shown().map((e) => `${stamp(e)}  ${e.severity.padEnd(11)}  ${e.source}: ${oneLine(e.text)}\n`).join("")], "text/plain") }, "Download");
  put(page, h("h1", {}, "Logbook"), h("div", { class: "toolbar" }, text, kinds, get),
    h("div", { class: "card" }, h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Logbook" }, h("table", { class: "logbook" },
      h("thead", {}, h("tr", {}, ["Time", "", "Source", "Text"].map((title, at) => h("th", { scope: "col", class: at ? "" : "end" }, title || h("span", { class: "hidden" }, "Severity"))))), body)), note));

  const shown = () => {
    const words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    return entries.filter((e) => wanted.has(e.severity) && words.every((word) => `${e.source} ${e.text}`.toLowerCase().includes(word)));
  };
  const draw = () => {
    const rows = shown();
    put(body, rows.slice(-500).reverse().map((e) => h("tr", { class: `is-${e.severity}` },
      h("td", { class: "end num" }, stamp(e)), h("td", {}, h("span", { class: `pill ${{ error: "bad", warning: "warn" }[e.severity] ?? ""}` }, e.severity)),
      h("td", {}, e.source), h("td", { class: "wrap" }, e.text))));
    setText(note, rows.length > 500 ? `The last 500 of ${rows.length}; the download has all.` : rows.length ? "" : "No entry.");
  };
  ears.keep(link.follow("logbook"));
  ears.on("hello", () => { entries = []; });
  ears.on("logbook", (told) => { entries = [...entries, ...told.entries].slice(-MOST); draw(); });
}

// an entry is one line of the file, whatever a program wrote into it
function oneLine(text) { return text.replace(/[\x00-\x1f\x7f-\x9f\u2028\u2029]+/g, " "); }

function stamp(entry) {
  const us = Math.floor(entry.time_ns / 1000);
  return `${Math.floor(us / 1e6)}.${String(us % 1e6).padStart(6, "0")}`;
}
