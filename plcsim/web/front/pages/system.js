// System: state, memory, rights, processes, versions.

import { card, h, put, setText, table } from "../dom.js";
import { bytes, count, duration, uptime } from "../format.js";
import { link } from "../link.js";

export function show(page, ears) {
  const facts = link.facts;
  const rows = {};
  const fact = (key, title, text = "") => {
    rows[key] = h("dd", { class: "num" }, text);
    return [h("dt", {}, title), rows[key]];
  };
  const classes = h("div");
  const processes = h("div");
  put(page, h("h1", {}, "System"),
    h("div", { class: "cards" },
      card("Controller", h("dl", {},
        fact("project", "Project", facts.project),
        fact("state", "State"),
        fact("started", "Started", facts.is_virtual ? "" : new Date(facts.started_s * 1000).toLocaleString("sv")),
        fact("elapsed", "Running for"),
        fact("clock", "Clock", facts.is_virtual ? "virtual" : "real"),
        fact("cpu", "Processor of the scan"),
        fact("rights", "Rights of the scan"))),
      card("Memory", h("dl", {},
        fact("memory", "PLC memory", bytes(facts.memory_size)),
        fact("variables", "Variables", bytes(facts.variables_size)),
        fact("snapshot", "In each snapshot", bytes(facts.snapshot_size)),
        fact("rss", "Scan process, resident"),
        fact("locked", "Scan process, locked"))),
      card("Versions", h("dl", {}, Object.entries(facts.versions).map(([name, text]) => [h("dt", {}, name), h("dd", { class: "num" }, text)])))),
    card("Task classes", classes),
    card("Processes", processes));

  const drawStatus = () => {
    const status = link.status;
    if (!status) return;
    setText(rows.state, status.state);
    setText(rows.elapsed, uptime(status.elapsed_ns));
    put(classes, table(
      ["Class", ["Cycle time", "end"], ["Cycles", "end"], ["Execution", "end"], ["Longest", "end"], ["Lateness", "end"], ["Longest", "end"], ["Missed", "end"], ["Violations", "end"]],
      facts.classes.map((each) => {
        const s = status.cycles[each.number];
        return [`#${each.number}  ${each.tasks.join(", ")}`, duration(each.cycle_ns), count(s.cycles), duration(s.execution_ns), duration(s.longest_execution_ns),
          duration(s.lateness_ns), duration(s.longest_lateness_ns), count(s.missed), h("span", { class: s.violations ? "bad-text" : "" }, count(s.violations))];
      }), { label: "Task classes" }));
  };
  const drawSystem = (told) => {
    const scan = told.processes.find((process) => process.name === "scan");
    setText(rows.cpu, told.cpu === null ? "any" : String(told.cpu));
    const rights = scan ? [scan.policy === "other" ? null : scan.policy, scan.locked ? "locked memory" : null].filter(Boolean) : [];
    setText(rows.rights, rights.join(", ") || "none");
    setText(rows.rss, scan ? bytes(scan.rss) : "–");
    setText(rows.locked, scan ? bytes(scan.locked) : "–");
    put(processes, table(
      ["Process", ["ID", "end"], "Scheduling", "Processors", ["CPU time", "end"], ["Memory", "end"], ["Threads", "end"]],
      told.processes.map((p) => [p.name, String(p.pid), p.policy, p.cpus, `${p.cpu_s.toFixed(1)} s`, bytes(p.rss), String(p.threads)]), { label: "Processes" }));
  };
  ears.keep(link.follow("system"));
  ears.on("status", drawStatus);
  ears.on("system", drawSystem);
  drawStatus();
}
