// Variables: the tree with live values, search, lists that stay, and what is written and forced.

import { attempt, dialog, h, put, remember, remembered, setText, toast } from "../dom.js";
import { FORMATS, editable, shown } from "../format.js";
import { link } from "../link.js";

const TREE = "";
const formats = remembered("formats", {});
const lists = remembered("lists", { Watch: [] });
let current = remembered("list", TREE);
const opened = new Set(remembered("opened", []));

export function show(page, ears) {
  const view = new View(ears);
  put(page, h("h1", {}, "Variables"), view.bar, view.place);
  view.draw();
  ears.on("forces", () => view.mark());
}

class View {
  constructor(ears) {
    this.rows = new Map();
    this.generation = 0;
    this.watching = null;
    this.ears = ears;
    ears.later(() => this.watching?.end());
    this.place = h("div", { class: "card tree-card" });
    this.search = h("input", { type: "search", placeholder: "Search variables", "aria-label": "Search variables", oninput: () => this.type() });
    this.select = h("select", { "aria-label": "What is shown", onchange: () => this.choose(this.select.value) });
    this.newList = h("button", { onclick: () => this.addList() }, "New list");
    this.dropList = h("button", { onclick: () => this.removeList() }, "Delete list");
    this.bar = h("div", { class: "toolbar" }, this.search, this.select, this.newList, this.dropList);
    this.fillSelect();
  }

  fillSelect() {
    if (current !== TREE && !(current in lists)) current = TREE;
    put(this.select, h("option", { value: TREE }, "All variables"), Object.keys(lists).map((name) => h("option", { value: name }, `List: ${name} (${lists[name].length})`)));
    this.select.value = current;
    this.dropList.hidden = current === TREE;
  }

  choose(name) {
    current = name;
    remember("list", current);
    this.search.value = "";
    this.fillSelect();
    this.draw();
  }

  addList() {
    dialog("New list", (box) => {
      const name = h("input", { id: "list-name", required: true, maxLength: 40, autofocus: true });
      const make = (event) => {
        event.preventDefault();
        lists[name.value.trim() || "Watch"] ??= [];
        remember("lists", lists);
        box.close();
        this.choose(name.value.trim() || "Watch");
      };
      return h("form", { class: "fields", onsubmit: make }, h("label", { for: "list-name" }, "Name"), name,
        h("div", { class: "buttons" }, h("button", { class: "primary" }, "Make")));
    });
  }

  removeList() {
    delete lists[current];
    if (!Object.keys(lists).length) lists.Watch = [];
    remember("lists", lists);
    this.choose(TREE);
  }

  type() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.draw(), 150);
  }

  async draw() {
    const generation = ++this.generation;
    const text = this.search.value.trim();
    const body = h("tbody");
    let note = "";
    try {
      if (text) {
        const { found, count } = await link.ask("search", { text });
        if (count > found.length) note = `${found.length} of ${count} shown; type more to narrow it down.`;
        if (!count) note = "No variable has this in its name.";
        this.begin();
        body.append(...found.map((one) => this.row(one, 0, one.path)));
      } else if (current === TREE) {
        this.begin();
        await this.expand("", 0, body, null);
      } else {
        const found = lists[current].length ? await link.ask("describe", { tags: lists[current] }) : [];
        this.begin();
        found.forEach((one, at) => body.append(one ? this.row(one, 0, one.path) : this.gone(lists[current][at])));
        if (!found.length) note = "This list is empty. Star variables in the tree to see them here.";
      }
    } catch (error) {
      note = error.message;
    }
    if (generation !== this.generation) return;
    const head = h("tr", {}, ["Variable", "Value", "Type", ""].map((title, at) => h("th", { scope: "col", class: at === 1 ? "end" : "" }, title || h("span", { class: "hidden" }, "Keep"))));
    put(this.place, h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Variables" }, h("table", { class: "tree" }, h("thead", {}, head), body)),
      note ? h("p", { class: "muted" }, note) : null);
    this.watch();
  }

  begin() { this.rows.clear(); }

  // puts what lies in a variable behind its row; those opened before are opened again
  async expand(path, depth, body, after) {
    const { children, count } = await link.ask("children", { path, first: 0 });
    let last = after;
    const add = (row) => { if (last) last.after(row); else body.append(row); last = row; };
    for (const one of children) {
      add(this.row(one, depth, one.name));
      if (opened.has(one.path)) last = await this.unfold(one, depth + 1, body, last);
    }
    if (count > children.length) add(this.more(path, depth, body, children.length, count));
    return last;
  }

  // what lies in a variable, or where a pointer leads; one that leads nowhere says so
  async unfold(one, depth, body, after) {
    if (one.kind === "branch") return this.expand(one.path, depth, body, after);
    if (!one.pointer) return after;
    try {
      return await this.expand(`${one.path}^`, depth, body, after);
    } catch (error) {
      const row = h("tr", { "data-under": one.path }, h("td", { class: `name d${Math.min(depth, 8)} muted`, colSpan: 4 }, error.message));
      after.after(row);
      return row;
    }
  }

  more(path, depth, body, first, count) {
    const row = h("tr", { "data-under": path }, h("td", { colSpan: 4 }, h("button", { class: "quiet", onclick: async () => {
      const next = await attempt(() => link.ask("children", { path, first }));
      if (!next) return;
      const rows = next.children.map((one) => this.row(one, depth, one.name));
      if (first + rows.length < count) rows.push(this.more(path, depth, body, first + rows.length, count));
      row.replaceWith(...rows);
      this.watch();
    } }, `… ${count - first} more`)));
    return row;
  }

  row(one, depth, label) {
    const isBranch = one.kind === "branch";
    const name = isBranch || one.pointer
      ? h("button", { class: "twist", "aria-expanded": String(opened.has(one.path)), onclick: (event) => this.twist(one, depth, event) }, label)
      : h("span", { class: "leaf" }, label);
    const value = isBranch ? h("span", { class: "muted" }, one.section ? one.section.replace("VAR_", "").toLowerCase() : "")
      : h("button", { class: "value", "aria-label": `Value of ${one.path}`, onclick: () => change(one, this) }, "…");
    const star = h("button", { class: "star", "aria-label": `Keep ${one.path} in a list`, onclick: () => this.star(one.path, star) }, "☆");
    const row = h("tr", { "data-path": one.path }, h("td", { class: `name d${Math.min(depth, 8)}` }, name), h("td", { class: "end" }, value),
      h("td", { class: "type muted" }, one.pointer ? `→ ${one.pointer}` : one.constant ? `CONSTANT ${one.type}` : one.type), h("td", { class: "end" }, isBranch ? null : star));
    if (!isBranch) {
      this.rows.set(one.path, { one, row, value });
      this.drawStar(one.path, star);
    }
    return row;
  }

  gone(path) {
    const star = h("button", { class: "star on", "aria-label": `Drop ${path}`, onclick: () => { this.star(path, star); this.draw(); } }, "★");
    return h("tr", {}, h("td", { class: "name d0" }, path), h("td", { class: "end muted" }, "not in this project"), h("td"), h("td", { class: "end" }, star));
  }

  async twist(one, depth, event) {
    const button = event.currentTarget;
    const row = button.closest("tr");
    const isOpen = opened.has(one.path);
    if (isOpen) opened.delete(one.path); else opened.add(one.path);
    remember("opened", [...opened].slice(-200));
    button.setAttribute("aria-expanded", String(!isOpen));
    if (isOpen) this.close(one.path, row);
    else await attempt(() => this.unfold(one, depth + 1, row.parentNode, row));
    this.watch();
  }

  close(path, row) {
    const inside = (each) => each && [".", "[", "^"].some((sign) => each.startsWith(path + sign));
    while (row.nextSibling && (inside(row.nextSibling.dataset.path) || row.nextSibling.dataset.under === path || inside(row.nextSibling.dataset.under))) {
      this.rows.delete(row.nextSibling.dataset.path);
      row.nextSibling.remove();
    }
  }

  star(path, button) {
    const name = current === TREE ? Object.keys(lists)[0] : current;
    const list = lists[name];
    const at = list.indexOf(path);
    if (at >= 0) list.splice(at, 1); else list.push(path);
    remember("lists", lists);
    this.fillSelect();
    this.drawStar(path, button);
    toast(at >= 0 ? `Taken off the list ${name}` : `Kept in the list ${name}`, "ok");
  }

  drawStar(path, button) {
    const isKept = (current === TREE ? Object.values(lists) : [lists[current]]).some((list) => list.includes(path));
    setText(button, isKept ? "★" : "☆");
    button.classList.toggle("on", isKept);
  }

  watch() {
    const before = this.watching;
    const rows = this.rows;
    this.watching = link.watch([...rows.keys()], (path, value) => this.showValue(path, value));
    before?.end();
    this.mark();
  }

  showValue(path, value) {
    const found = this.rows.get(path);
    if (!found) return;
    const kind = found.one.kind;
    setText(found.value, shown(value, kind, formats[path] ?? (found.one.pointer ? "hex" : undefined)));
    if (found.one.pointer && found.to !== value) {
      const leads = found.to === undefined;
      found.to = value;
      if (!leads && opened.has(path)) this.again(found, path);
    }
    if (found.one.kind === "bool") found.value.classList.toggle("true", value === true);
  }

  // a pointer that has changed is followed anew
  async again(found, path) {
    const depth = Number(/ d(\d)/.exec(found.row.firstChild.className)?.[1] ?? 0);
    this.close(path, found.row);
    await this.unfold(found.one, depth + 1, found.row.parentNode, found.row);
    this.watch();
  }

  mark() {
    for (const [path, { row, value }] of this.rows) {
      const force = link.forceOf(path);
      row.classList.toggle("forced-row", Boolean(force));
      value.title = force ? `Forced by ${force.by}` : "";
    }
  }
}

// the dialog in which a value is written, forced and released
export function change(one, view = null) {
  let watching;
  dialog(one.path, (box) => {
    const now = h("output", { class: "now num" }, "…");
    const field = fieldFor(one);
    const mayWrite = link.may("operate") && !one.constant && !one.followed;
    const mayForce = link.may("engineer") && !one.constant && !one.followed;
    const forced = h("p", { class: "forced-note" });
    const release = h("button", { type: "button", disabled: !mayForce, onclick: () => act("release", "is released") }, "Release");
    const act = async (name, done) => {
      const args = name === "release" ? { tag: link.forceOf(one.path)?.path ?? one.path } : { tag: one.path, value: field.input.value };
      const answer = await attempt(() => link.ask(name, args), `${one.path} ${done}`);
      if (answer && name === "write") box.close();
    };
    const draw = () => {
      const force = link.forceOf(one.path);
      release.hidden = !force;
      forced.hidden = !force;
      setText(forced, force ? `Forced to ${force.value} by ${force.by}` : "");
    };
    link.addEventListener("forces", draw);
    box.addEventListener("close", () => link.removeEventListener("forces", draw));
    const isInteger = one.kind.startsWith("integer");
    const format = h("select", { id: "format", onchange: () => {
      if (format.value === "dec") delete formats[one.path]; else formats[one.path] = format.value;
      remember("formats", formats);
      drawNow(link.values.get(one.path));
      view?.showValue(one.path, link.values.get(one.path));
    } }, FORMATS.map((each) => h("option", { value: each, selected: (formats[one.path] ?? "dec") === each }, each)));
    let isUntouched = true;
    field.input.addEventListener("input", () => { isUntouched = false; });
    const drawNow = (value) => {
      setText(now, shown(value, one.kind, formats[one.path]));
      if (isUntouched && value !== undefined && value !== null) {
        field.input.value = editable(value, one.kind);
        // select() would take the focus from where the user went meanwhile
        if (document.activeElement === field.input) field.input.select?.();
        isUntouched = false;
      }
    };
    watching = link.watch([one.path], (_path, value) => drawNow(value));
    draw();
    return h("form", { class: "fields", onsubmit: (event) => { event.preventDefault(); act("write", "is written"); } },
      h("p", { class: "muted" }, one.type, one.constant ? " · CONSTANT" : "", one.followed ? " · reached by a pointer: shown only" : ""),
      h("div", { class: "now-line" }, h("span", { class: "muted" }, "Now"), now),
      isInteger ? [h("label", { for: "format" }, "Shown as"), format] : null,
      mayWrite ? [h("label", { for: "new-value" }, "New value"), field.shown] : null,
      forced,
      h("div", { class: "buttons" },
        h("button", { class: "primary", disabled: !mayWrite }, "Write"),
        h("button", { type: "button", class: "force", disabled: !mayForce, onclick: () => act("force", "is forced") }, "Force"),
        release),
      mayWrite ? h("p", { class: "hint" }, "Written as in Structured Text: TRUE, -7, 16#FF, 1.5, T#1m30s, 'text'.") : null);
  }, { closed: () => watching?.end() });
}

function fieldFor(one) {
  if (one.kind === "bool" || one.kind === "enumeration") {
    const names = one.names ?? ["FALSE", "TRUE"];
    const input = h("select", { id: "new-value", autofocus: true }, names.map((name) => h("option", { value: name }, name)));
    return { input, shown: input };
  }
  const input = h("input", { id: "new-value", autocomplete: "off", spellcheck: "false", autofocus: true });
  return { input, shown: input };
}
