// Trace: variables in every cycle, drawn one below the other, with trigger, zoom, cursors and export.

import { attempt, download, h, put, remember, remembered, setText, toast } from "../dom.js";
import { link } from "../link.js";

const MOST_ROWS = 1_000_000;
const COLOURS = 8;

// columns of numbers that grow: time, cycle, then the variables
export class Store {
  constructor(columns) {
    this.columns = Array.from({ length: columns }, () => new Float64Array(4096));
    this.length = 0;
    this.dropped = 0;
  }

  add(columns, count) {
    if (this.length + count > MOST_ROWS) this.drop(Math.max(count, MOST_ROWS / 4));
    if (this.length + count > this.columns[0].length) {
      const size = Math.max(this.length + count, this.columns[0].length * 2);
      this.columns = this.columns.map((old) => { const made = new Float64Array(size); made.set(old.subarray(0, this.length)); return made; });
    }
    columns.forEach((column, at) => this.columns[at].set(column, this.length));
    this.length += count;
  }

  drop(count) {
    const less = Math.min(count, this.length);
    for (const column of this.columns) column.copyWithin(0, less, this.length);
    this.length -= less;
    this.dropped += less;
  }

  column(at) { return this.columns[at].subarray(0, this.length); }

  // the first row at or after a time
  rowAt(time) {
    let [low, high] = [0, this.length];
    const times = this.columns[0];
    while (low < high) { const middle = (low + high) >> 1; if (times[middle] < time) low = middle + 1; else high = middle; }
    return low;
  }
}

export function crossed(before, now, level, edge) {
  const rises = before < level && now >= level;
  const falls = before >= level && now < level;
  return edge === "rising" ? rises : edge === "falling" ? falls : rises || falls;
}

let uplot = null;
function loadUplot() {
  uplot ??= new Promise((resolve, reject) => {
    const script = h("script", { src: "vendor/uplot/uPlot.iife.min.js" });
    script.onload = () => resolve(globalThis.uPlot);
    script.onerror = () => reject(new Error("the plots cannot be loaded"));
    document.head.append(script);
  });
  return uplot;
}

export function show(page, ears) {
  const view = new View(ears);
  put(page, h("h1", {}, "Trace"), view.elements());
  ears.on("trace", (data) => view.took(data));
  ears.on("closed", () => view.stopped("the connection is lost"));
  ears.every(100, () => view.draw());
  ears.later(() => view.leave());
}

class View {
  constructor(ears) {
    this.ears = ears;
    this.tags = remembered("trace", []);
    this.store = null;
    this.number = 0;
    this.plots = [];
    this.state = "idle";
    this.zoom = null;
    this.cursors = [null, null];
    this.trigger = { row: -1, armed: false, done: false };
    this.isFresh = false;
  }

  elements() {
    this.search = h("input", { type: "search", placeholder: "Add a variable", "aria-label": "Add a variable", list: "trace-found", oninput: () => this.find(), onchange: () => this.addTyped() });
    this.found = h("datalist", { id: "trace-found" });
    this.chips = h("div", { class: "chips" });
    this.start = h("button", { class: "primary", onclick: () => this.toggle() }, "Start");
    const number = (id, value, attributes = {}) => h("input", { id, type: "number", value: String(value), step: "any", ...attributes });
    this.span = h("select", { id: "trace-span" }, [1, 5, 10, 30, 60].map((s) => h("option", { value: s, selected: s === remembered("trace-span", 10) }, `${s} s`)));
    this.source = h("select", { id: "trace-source" });
    this.level = number("trace-level", 0.5);
    this.edge = h("select", { id: "trace-edge" }, ["rising", "falling", "both"].map((each) => h("option", { value: each }, each)));
    this.before = number("trace-before", 25, { min: "0", max: "100", step: "5" });
    this.mode = h("select", { id: "trace-mode" }, [["off", "none"], ["single", "once"], ["normal", "again and again"]].map(([value, text]) => h("option", { value }, text)));
    this.note = h("p", { class: "num muted", role: "status" }, "Choose variables, then start.");
    this.place = h("div", { class: "lanes" });
    this.table = h("div");
    const field = (label, element) => h("span", { class: "field" }, h("label", { for: element.id }, label), element);
    this.drawChips();
    return [
      h("div", { class: "card" },
        h("div", { class: "toolbar" }, this.search, this.found, this.start, field("Window", this.span),
          h("button", { onclick: () => this.resetZoom() }, "Reset zoom"), h("button", { onclick: () => this.csv() }, "CSV"), h("button", { onclick: () => this.png() }, "PNG"), h("button", { onclick: () => attempt(() => this.bag()) }, "Bag")),
        this.chips,
        h("fieldset", { class: "toolbar" }, h("legend", {}, "Trigger"), field("Stop", this.mode), field("Variable", this.source), field("Level", this.level), field("Edge", this.edge), field("Before, %", this.before)),
        this.note),
      h("div", { class: "card" }, this.place, this.table,
        h("p", { class: "hint" }, "Drag to zoom, double-click to see all. Press A or B over a plot to set a cursor, Escape to clear both.")),
    ];
  }

  async find() {
    const text = this.search.value.trim();
    if (text.length < 1) return;
    const answer = await attempt(() => link.ask("search", { text }));
    if (answer) put(this.found, answer.found.filter((one) => one.kind !== "string" && one.kind !== "branch").slice(0, 40).map((one) => h("option", { value: one.path }, one.type)));
    if (answer?.found.some((one) => one.path === text)) this.add(text);
  }

  async addTyped() {
    const text = this.search.value.trim();
    if (!text) return;
    const [one] = (await attempt(() => link.ask("describe", { tags: [text] }))) ?? [];
    if (!one) toast(`There is no variable ${text}`); else this.add(one.path);
  }

  add(path) {
    this.search.value = "";
    if (this.tags.includes(path)) return;
    if (this.tags.length >= 32) { toast("A trace has 32 variables at most"); return; }
    this.change([...this.tags, path]);
  }

  async change(tags) {
    const ran = this.state === "running";
    if (ran) await this.halt();
    this.tags = tags;
    remember("trace", tags);
    this.drawChips();
    if (ran && tags.length) await this.run();
  }

  drawChips() {
    put(this.chips, this.tags.map((path, at) => h("span", { class: `chip-line s${at % COLOURS}` }, h("code", {}, path),
      h("button", { class: "quiet", "aria-label": `Remove ${path}`, onclick: () => this.change(this.tags.filter((each) => each !== path)) }, "×"))));
    const chosen = this.source.value;
    put(this.source, this.tags.map((path) => h("option", { value: path }, path)));
    if (this.tags.includes(chosen)) this.source.value = chosen;
  }

  async toggle() { if (this.state === "running") await this.halt(); else await this.run(); }

  async run() {
    if (!this.tags.length) { toast("Choose a variable first"); return; }
    const known = await attempt(() => link.ask("describe", { tags: this.tags }));
    if (!known) return;
    const gone = this.tags.filter((_, at) => !known[at]);
    if (gone.length) { await this.change(this.tags.filter((path) => !gone.includes(path))); toast(`Not in this project: ${gone.join(", ")}`); return; }
    this.kinds = known.map((one) => one.kind);
    this.names = known.map((one) => one.names);
    this.store = new Store(this.tags.length + 2);
    this.lost = 0;
    this.zoom = null;
    this.cursors = [null, null];
    this.trigger = { row: -1, armed: this.mode.value !== "off", done: false };
    remember("trace-span", Number(this.span.value));
    const answer = await attempt(async () => { await loadUplot(); return link.ask("trace", { tags: this.tags }); });
    if (!answer) return;
    this.number = answer.number;
    this.kept = answer.key;
    this.state = "running";
    setText(this.start, "Stop");
    this.makePlots();
    for (const early of this.early ?? []) this.took(early);
    this.early = null;
  }

  async halt() {
    const number = this.number;
    this.stopped("");
    await link.ask("untrace", { number }).catch(() => {});
  }

  stopped(why) {
    if (this.state !== "running") return;
    this.state = "idle";
    this.number = 0;
    setText(this.start, "Start");
    if (why) toast(`The trace has ended: ${why}`);
    this.isFresh = true;
    this.draw();
  }

  leave() {
    if (this.number) link.ask("untrace", { number: this.number }).catch(() => {});
    this.dropPlots();
  }

  took(data) {
    const [number, count, columns, lost] = new Uint32Array(data, 0, 4);
    if (number !== this.number) { if (!this.number) (this.early ??= []).push(data); this.early?.splice(0, this.early.length - 50); return; }
    if (columns !== this.tags.length) return;
    const first = this.store.length;
    this.lost = lost;
    const dropped = this.store.dropped;
    this.store.add(Array.from({ length: columns + 2 }, (_, at) => new Float64Array(data, 16 + at * count * 8, count)), count);
    const moved = this.store.dropped - dropped;
    if (this.trigger.row >= 0) this.trigger.row -= moved;
    this.isFresh = true;
    this.look(Math.max(1, first - moved));
  }

  // looks for the trigger in every sample from a row on
  look(from) {
    if (this.mode.value === "off") return;
    const at = this.tags.indexOf(this.source.value);
    const level = Number(this.level.value);
    const span = Number(this.span.value);
    const share = Math.min(100, Math.max(0, Number(this.before.value))) / 100;
    const times = this.store.column(0);
    if (this.trigger.armed && at >= 0) {
      const values = this.store.column(at + 2);
      for (let row = Math.max(1, from); row < values.length; row += 1) {
        if (crossed(values[row - 1], values[row], level, this.edge.value)) {
          this.trigger = { row, armed: false, done: false };
          break;
        }
      }
    }
    if (this.trigger.row >= 0 && !this.trigger.done && times[times.length - 1] >= times[this.trigger.row] + span * (1 - share)) {
      const time = times[this.trigger.row];
      this.zoom = [time - span * share, time + span * (1 - share)];
      this.shown = time;
      if (this.mode.value === "single") { this.trigger.done = true; this.halt(); } else this.trigger = { row: -1, armed: true, done: false };
    }
  }

  window() {
    if (this.zoom) return this.zoom;
    const times = this.store.column(0);
    const end = times[times.length - 1] ?? 0;
    if (this.state !== "running" && this.store.length) return [Math.max(times[0], end - Number(this.span.value)), end];
    return [end - Number(this.span.value), end];
  }

  draw() {
    if (!this.store || !this.plots.length || !this.isFresh) return;
    this.isFresh = false;
    const [start, end] = this.window();
    const from = Math.max(0, this.store.rowAt(start) - 1);
    const to = Math.min(this.store.length, this.store.rowAt(end) + 2);
    const times = this.store.columns[0].subarray(from, to);
    this.plots.forEach((plot, at) => {
      plot.setData([times, this.store.columns[at + 2].subarray(from, to)], false);
      plot.setScale("x", { min: start, max: end });
    });
    const armed = this.trigger.armed && this.state === "running" ? " · waiting for the trigger" : "";
    const hit = this.shown !== undefined && this.zoom ? ` · triggered at ${this.shown.toFixed(4)} s` : "";
    setText(this.note, `${this.store.length.toLocaleString("en").replaceAll(",", " ")} samples, ${this.lost} lost${armed}${hit}`);
    this.drawCursors();
  }

  makePlots() {
    this.dropPlots();
    this.shown = undefined;
    const styles = getComputedStyle(document.documentElement);
    const colour = (name) => styles.getPropertyValue(name).trim();
    const make = globalThis.uPlot;
    const width = () => this.place.clientWidth;
    const hooks = {
      setSelect: [(plot) => {
        if (plot.select.width < 4) return;
        this.zoom = [plot.posToVal(plot.select.left, "x"), plot.posToVal(plot.select.left + plot.select.width, "x")];
        plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
        this.isFresh = true;
      }],
    };
    this.plots = this.tags.map((path, at) => {
      const isLast = at === this.tags.length - 1;
      const isBool = this.kinds[at] === "bool";
      const names = this.names[at];
      const axis = { stroke: colour("--muted"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "12px system-ui" };
      const plot = new make({
        width: width(), height: (isBool ? 56 : 112) + (isLast ? 34 : 0), title: "", legend: { show: false }, padding: [8, 12, 0, 0],
        cursor: { y: false, sync: { key: "trace" }, drag: { x: true, y: false, setScale: false }, points: { size: 7 } },
        scales: { x: { time: false }, y: isBool ? { range: [-0.15, 1.15] } : { range: (_, low, high) => { const more = (high - low) * 0.08 || Math.max(0.5, Math.abs(high) * 0.05); return [low - more, high + more]; } } },
        axes: [
          { ...axis, size: isLast ? 30 : 0, values: (_, splits) => splits.map((each) => (isLast ? `${Number(each.toFixed(6))} s` : "")) },
          { ...axis, size: 74, splits: isBool ? () => [0, 1] : undefined, values: (_, splits) => splits.map((each) => (isBool ? ["FALSE", "TRUE"][each] ?? "" : names ? names[each] ?? each : String(Number(each.toPrecision(6))))) },
        ],
        series: [{}, { stroke: colour(`--s${(at % COLOURS) + 1}`), width: 1.6, paths: make.paths.stepped({ align: 1 }), points: { show: false } }],
        hooks: { ...hooks, draw: [(self) => this.drawMarks(self, colour)] },
      }, [[], []], h("div", { class: "lane", "aria-label": path }));
      const lane = plot.root.parentElement ?? plot.root;
      plot.over.addEventListener("dblclick", () => this.resetZoom());
      plot.root.prepend(h("div", { class: "lane-name" }, path));
      this.place.append(lane);
      return plot;
    });
    this.resize = new ResizeObserver(() => { for (const plot of this.plots) plot.setSize({ width: width(), height: plot.height }); });
    this.resize.observe(this.place);
    this.key = (event) => {
      if (event.target.matches?.("input, select, textarea") || document.querySelector("dialog[open]")) return;
      const time = this.plots[0]?.cursor.left >= 0 ? this.plots[0].posToVal(this.plots[0].cursor.left, "x") : null;
      if (event.key === "Escape") this.cursors = [null, null];
      else if (event.key.toLowerCase() === "a" && time !== null) this.cursors[0] = time;
      else if (event.key.toLowerCase() === "b" && time !== null) this.cursors[1] = time;
      else return;
      this.isFresh = true;
      this.draw();
    };
    window.addEventListener("keydown", this.key);
  }

  dropPlots() {
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    put(this.place);
    this.resize?.disconnect();
    if (this.key) window.removeEventListener("keydown", this.key);
  }

  drawMarks(plot, colour) {
    const context = plot.ctx;
    const { top, height, left, width } = plot.bbox;
    const line = (time, style, text) => {
      if (time === null || time === undefined) return;
      const x = Math.round(plot.valToPos(time, "x", true));
      if (x < left || x > left + width) return;
      context.save();
      context.strokeStyle = style;
      context.fillStyle = style;
      context.setLineDash([4, 3]);
      context.beginPath();
      context.moveTo(x, top);
      context.lineTo(x, top + height);
      context.stroke();
      context.textAlign = "left";
      context.font = `${12 * devicePixelRatio}px system-ui`;
      context.fillText(text, x + 4, top + 12 * devicePixelRatio);
      context.restore();
    };
    if (this.zoom && this.shown !== undefined) line(this.shown, colour("--bad"), "T");
    line(this.cursors[0], colour("--ink"), "A");
    line(this.cursors[1], colour("--ink"), "B");
  }

  drawCursors() {
    const [a, b] = this.cursors;
    if (a === null && b === null) { put(this.table); return; }
    const value = (time, at) => {
      if (time === null) return null;
      const row = Math.min(this.store.length - 1, Math.max(0, this.store.rowAt(time + 1e-9) - 1));
      return this.store.columns[at + 2][row];
    };
    const text = (number) => (number === null ? "–" : String(Number(number.toPrecision(9))));
    const rows = this.tags.map((path, at) => [path, value(a, at), value(b, at)]);
    const head = (time) => (time === null ? "–" : `${time.toFixed(6)} s`);
    put(this.table, h("table", { class: "cursors num" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Variable"), h("th", { scope: "col", class: "end" }, `A ${head(a)}`), h("th", { scope: "col", class: "end" }, `B ${head(b)}`), h("th", { scope: "col", class: "end" }, `B − A ${a === null || b === null ? "" : `${(b - a).toFixed(6)} s`}`))),
      h("tbody", {}, rows.map(([path, left, right]) => h("tr", {}, h("td", {}, path), h("td", { class: "end" }, text(left)), h("td", { class: "end" }, text(right)), h("td", { class: "end" }, left === null || right === null ? "–" : text(right - left)))))));
  }

  resetZoom() { this.zoom = null; this.shown = undefined; this.isFresh = true; this.draw(); }

  csv() {
    if (!this.store?.length) { toast("There is nothing to export yet"); return; }
    const quote = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const parts = [`time_s,cycle,${this.tags.map(quote).join(",")}\n`];
    const columns = this.store.columns;
    let lines = [];
    for (let row = 0; row < this.store.length; row += 1) {
      lines.push(columns.map((column, at) => (at ? column[row] : column[row].toFixed(9))).join(","));
      if (lines.length === 10000) { parts.push(`${lines.join("\n")}\n`); lines = []; }
    }
    if (lines.length) parts.push(`${lines.join("\n")}\n`);
    download(`${link.facts.project}-trace.csv`, parts, "text/csv");
  }

  async bag() {
    if (!this.store?.length) { toast("There is nothing to export yet"); return; }
    const answer = await fetch("trace.bag", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ key: this.kept }) });
    if (!answer.ok) throw new Error((await answer.json()).error);
    download(`${link.facts.project}-trace.bag`, [await answer.blob()], "application/octet-stream");
  }

  png() {
    if (!this.plots.length) { toast("There is nothing to export yet"); return; }
    const ratio = devicePixelRatio;
    const canvases = this.plots.map((plot) => plot.ctx.canvas);
    const picture = h("canvas");
    const label = 20 * ratio;
    picture.width = Math.max(...canvases.map((each) => each.width));
    picture.height = canvases.reduce((sum, each) => sum + each.height + label, 0);
    const context = picture.getContext("2d");
    const styles = getComputedStyle(document.documentElement);
    context.fillStyle = styles.getPropertyValue("--surface");
    context.fillRect(0, 0, picture.width, picture.height);
    context.fillStyle = styles.getPropertyValue("--ink");
    context.font = `${13 * ratio}px monospace`;
    let y = 0;
    canvases.forEach((each, at) => { context.fillText(this.tags[at], 8 * ratio, y + 15 * ratio); context.drawImage(each, 0, y + label); y += each.height + label; });
    picture.toBlob((blob) => download(`${link.facts.project}-trace.png`, [blob], "image/png"));
  }
}
