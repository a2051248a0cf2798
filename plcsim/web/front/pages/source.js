// Source: the programs as they are written, with the live values beside the lines.

import { attempt, h, put, remember, remembered, setText } from "../dom.js";
import { shown } from "../format.js";
import { highlighter } from "../highlight.js";
import { link } from "../link.js";
import { change } from "./variables.js";

export async function show(page, ears) {
  let watching = null;
  ears.later(() => watching?.end());
  const select = h("select", { "aria-label": "File", onchange: () => open() });
  const place = h("div", { class: "card source-card" }, h("p", { class: "muted" }, "Reading …"));
  put(page, h("h1", {}, "Source"), h("div", { class: "toolbar" }, select), place);
  const programs = await attempt(() => link.ask("sources"));
  if (!programs) return;
  put(select, programs.map((program) => h("optgroup", { label: program.name }, program.files.map((file) => h("option", { value: JSON.stringify([program.name, file]) }, file)))));
  const last = remembered("source", "");
  if ([...select.options].some((option) => option.value === last)) select.value = last;

  const open = async () => {
    if (!select.value) { put(place, h("p", { class: "muted" }, "No program of this project has a source here.")); return; }
    remember("source", select.value);
    const [program, file] = JSON.parse(select.value);
    const read = await attempt(() => link.ask("source", { program, file }));
    if (!read) return;
    const described = new Map();
    const paths = [...new Set(read.lines.flatMap(([, names]) => names.map(([, path]) => path)))].slice(0, 1000);
    for (const one of (await attempt(() => link.ask("describe", { tags: paths }))) ?? []) if (one) described.set(one.path, one);
    const cells = new Map();
    const colour = highlighter(file);
    const body = h("tbody", {}, read.lines.map(([text, names], at) => h("tr", {},
      h("td", { class: "no" }, String(at + 1)), h("td", { class: "code" }, colour(text).map(([kind, part]) => (kind && !own(names).has(part) ? h("span", { class: `hl-${kind}` }, part) : part))),
      h("td", { class: "values" }, names.filter(([, path]) => described.has(path)).map(([name, path]) => {
        const value = h("span", { class: "num" }, "…");
        if (!cells.has(path)) cells.set(path, []);
        const chip = h("button", { class: "chip", title: path, onclick: () => change(described.get(path)) }, `${name} `, value);
        cells.get(path).push({ chip, value });
        return chip;
      })))));
    put(place, h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": file }, h("table", { class: "source" }, body)));
    const mark = () => { for (const [path, found] of cells) for (const { chip } of found) chip.classList.toggle("forced", Boolean(link.forceOf(path))); };
    ears.on("forces", mark);
    const before = watching;
    watching = link.watch([...cells.keys()], (path, value) => {
      for (const found of cells.get(path) ?? []) {
        setText(found.value, shown(value, described.get(path).kind));
        found.chip.classList.toggle("true", value === true);
      }
    });
    before?.end();
    mark();
  };
  await open();
}

// names of variables on a line: one that is called like a keyword is none
function own(names) { return new Set(names.flatMap(([name]) => name.split(/\W+/))); }
