// Task classes: figures, histograms, the last cycles as a Gantt chart, violations with their cause.

import { card, h, put, svg, table } from "../dom.js";
import { count, duration, uptime } from "../format.js";
import { link } from "../link.js";

const OF = [["lateness", "Lateness"], ["execution", "Execution"], ["response", "Response"], ["controller", "LATCH and PUBLISH"]];
const CAUSES = { program: "by_program", host: "by_host", preempted: "preempted", controller: "by_controller" };

export function show(page, ears) {
  const cards = new Map();
  const gantt = h("div", { class: "gantt", tabindex: "0", role: "region", "aria-label": "Last cycles" });
  const hold = h("button", { "aria-pressed": "false", onclick: () => {
    const isHeld = hold.getAttribute("aria-pressed") !== "true";
    hold.setAttribute("aria-pressed", String(isHeld));
    hold.classList.toggle("pressed", isHeld);
  } }, "Hold");
  const cycles = link.facts.classes.map((c) => c.cycle_ns);
  const spans = [...new Set([2 * Math.max(...cycles), 2 * Math.min(...cycles), Math.min(...cycles) / 5])];
  const span = h("select", { "aria-label": "Time shown" }, spans.map((ns) => h("option", { value: ns }, duration(ns))));
  const violations = h("div");
  for (const each of link.facts.classes) {
    const head = h("dl", { class: "facts" });
    const plots = h("div", { class: "histograms" });
    cards.set(each.number, { each, head, plots, section: card(`Task class #${each.number}`, head, plots) });
  }
  put(page, h("h1", {}, "Task classes"), [...cards.values()].map((c) => c.section),
    h("section", { class: "card" }, h("div", { class: "card-head" }, h("h2", {}, "Last cycles"), h("div", { class: "buttons" }, span, hold)), gantt,
      h("p", { class: "hint" }, "Light: from the start of a cycle to its end. Dark: its programs. Lines: releases on the grid.")),
    card("Violations", violations));

  const drawFigures = () => {
    for (const { each, head } of cards.values()) {
      const s = link.status?.cycles[each.number];
      if (!s) continue;
      const causes = Object.entries(CAUSES).filter(([, key]) => s[key]).map(([name, key]) => `${s[key]} ${name}`);
      put(head, [["Programs", each.tasks.join(", ")], ["Cycle time", duration(each.cycle_ns)], ["Tolerance", duration(each.tolerance_ns)],
        ["Violation leads to", each.policy], ["Cycles", count(s.cycles)], ["In tolerance", count(s.in_tolerance)], ["Missed points", count(s.missed)],
        ["Violations", s.violations ? h("span", { class: "bad-text" }, `${count(s.violations)} (${causes.join(", ")})`) : "0"]]
        .map(([title, text]) => h("div", {}, h("dt", {}, title), h("dd", { class: "num" }, text))));
    }
  };
  ears.keep(link.follow("classes"));
  ears.on("status", drawFigures);
  ears.on("classes", (told) => {
    for (const { each, plots } of cards.values()) {
      const own = OF.map(([of, title]) => [title, told.histograms.find((x) => x.of === of && x.name === String(each.number))]);
      const programs = each.tasks.map((name) => [name, told.histograms.find((x) => x.of === "program" && x.name === name)]);
      put(plots, [...own, ...programs].filter(([, found]) => found?.entries).map(([title, found]) => histogram(title, found)));
      if (!plots.children.length) put(plots, h("p", { class: "muted" }, "Histograms come while the scan is idle …"));
    }
    if (hold.getAttribute("aria-pressed") !== "true") put(gantt, chart(told.cycles, Number(span.value)));
    const rows = told.violations.slice().reverse().map((v) => [`#${v.task_class}`, count(v.cycle), uptime(v.release_ns), v.cause, v.program || "–",
      duration(v.response_ns), duration(v.limit_ns), duration(v.own_ns), duration(v.others_ns), v.location]);
    put(violations, rows.length
      ? table(["Class", ["Cycle", "end"], ["At", "end"], "Cause", "Program", ["Response", "end"], ["Limit", "end"], ["Own", "end"], ["Others", "end"], "Where"], rows, { label: "Violations" })
      : h("p", { class: "muted" }, "None so far."));
  });
  drawFigures();
}

// bars over a logarithmic axis of time; heights are logarithmic too, so that one late cycle is seen
function histogram(title, found) {
  const [width, height] = [240, 64];
  const low = Math.log2(Math.max(100, found.bars[0][0]));
  const high = Math.max(low + 1, Math.log2(Math.max(200, found.bars.at(-1)[1])));
  const x = (ns) => ((Math.log2(Math.max(100, ns)) - low) / (high - low)) * width;
  const top = Math.log(1 + Math.max(...found.bars.map((bar) => bar[2])));
  const bars = found.bars.map(([start, end, n]) => {
    const tall = Math.max(2, (Math.log(1 + n) / top) * height);
    return svg("rect", { x: x(start).toFixed(1), y: (height - tall).toFixed(1), width: Math.max(1.5, x(end) - x(start) - 0.7).toFixed(1), height: tall.toFixed(1), class: "bar" },
      svg("title", {}, `${duration(start)} to ${duration(end)}: ${count(n)}`));
  });
  const mark = (ns) => svg("line", { x1: x(ns).toFixed(1), x2: x(ns).toFixed(1), y1: 0, y2: height, class: "p99" });
  const text = `median ${duration(found.p50_ns)}, 99 % ${duration(found.p99_ns)}, largest ${duration(found.maximum_ns)} of ${count(found.entries)}`;
  return h("figure", {}, h("figcaption", {}, h("strong", {}, title)),
    svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${title}: ${text}`, preserveAspectRatio: "none" }, bars, mark(found.p99_ns)),
    h("div", { class: "axis num" }, h("span", {}, duration(2 ** low)), h("span", {}, duration(2 ** high))),
    h("p", { class: "hint num" }, `p50 ${duration(found.p50_ns)} · p99 ${duration(found.p99_ns)} · max ${duration(found.maximum_ns)}`));
}

function chart(cycles, span) {
  if (!cycles.length) return h("p", { class: "muted" }, "No cycle yet.");
  const end = Math.max(...cycles.map((c) => c.end_ns));
  const start = end - span;
  const rows = link.facts.classes.flatMap((c) => c.tasks.map((name) => [c, name]));
  const [left, width, tall] = [140, 1000, 26];
  const height = rows.length * tall + 22;
  const x = (ns) => left + ((ns - start) / (end - start)) * (width - left - 10);
  const shapes = [];
  rows.forEach(([each, name], at) => {
    const y = at * tall;
    shapes.push(svg("text", { x: 4, y: y + 17, class: "label" }, `#${each.number} ${name}`), svg("line", { x1: left, x2: width, y1: y + tall, y2: y + tall, class: "rule" }));
    for (const c of cycles) {
      if (c.class !== each.number || c.end_ns < start) continue;
      if (c.release_ns >= start) shapes.push(svg("line", { x1: x(c.release_ns), x2: x(c.release_ns), y1: y + 2, y2: y + tall - 2, class: "release" }));
      const from = Math.max(start, c.start_ns);
      shapes.push(svg("rect", { x: x(from), y: y + 7, width: Math.max(1, x(c.end_ns) - x(from)), height: tall - 13, class: "cycle" }));
      for (const [task, began, ended, used] of c.runs) {
        if (task !== name || ended < start) continue;
        const at0 = Math.max(start, began);
        shapes.push(svg("rect", { x: x(at0), y: y + 5, width: Math.max(1.5, x(ended) - x(at0)), height: tall - 9, class: `run c${each.number}` },
          svg("title", {}, `${task}, cycle ${c.cycle}: ${duration(ended - began)} (CPU ${duration(used)}), ${duration(began - c.release_ns)} after its release`)));
      }
    }
  });
  for (let tick = 0; tick <= 4; tick += 1) {
    const ns = start + ((end - start) * tick) / 4;
    shapes.push(svg("text", { x: Math.min(width - 12, x(ns)), y: height - 5, class: "tick", "text-anchor": tick === 4 ? "end" : tick ? "middle" : "start" }, tick ? duration(ns - start) : "0"));
  }
  return svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `The last cycles of ${rows.length} programs` }, shapes);
}
