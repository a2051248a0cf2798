// Network: the TCP sockets of the processes of the run, topics of nodes, idents of blocks.

import { card, h, put, table } from "../dom.js";
import { bytes, count } from "../format.js";
import { link } from "../link.js";

export function show(page, ears) {
  const place = h("div", {}, h("p", { class: "muted" }, "Looking …"));
  put(page, h("h1", {}, "Network"), place,
    h("p", { class: "hint" }, "As the kernel tells them: peers of AsTCP blocks and of the ROS node belong to the scan, clients of Modbus and browsers to their services."));
  ears.keep(link.follow("network"));
  const topics = h("div");
  page.insertBefore(topics, page.lastChild);
  let before = null;
  const drawTopics = (told) => {
    if (!told.topics.length && !Object.keys(told.idents).length) { put(topics); return; }
    const since = before ? (told.time_ns - before.time_ns) / 1e9 : 0;
    const rate = (row, at) => {
      const old = before?.topics.find((each) => each[0] === row[0] && each[1] === row[1] && each[3] === row[3]);
      return old && since > 0 ? (row[at] - old[at]) / since : 0;
    };
    const rows = told.topics.map((row) => [h("code", {}, row[1]), row[2], row[0], row[3] ? "sent" : "received", count(row[4]), `${rate(row, 4).toFixed(1)} /s`, `${bytes(rate(row, 5))}/s`]);
    put(topics, rows.length ? card("Topics", table(["Topic", "Type", "Node", "", ["Messages", "end"], ["Rate", "end"], ["Bytes", "end"]], rows, { label: "Topics" })) : null,
      Object.keys(told.idents).length ? card("Idents in use", h("dl", {}, Object.entries(told.idents).map(([name, number]) => [h("dt", {}, name), h("dd", { class: "num" }, String(number))]))) : null);
    if (!before || told.time_ns > before.time_ns) before = told;
  };
  ears.on("network", (told) => {
    drawTopics(told);
    const names = [...new Set(told.sockets.map((each) => each.process))];
    put(place, names.length ? names.map((name) => {
      const own = told.sockets.filter((each) => each.process === name);
      const connected = own.filter((each) => each.state === "connected").length;
      return card(`${name} · ${connected} connected`, table(["State", "Local", "Peer", ["To be sent", "end"], ["To be read", "end"]],
        own.map((each) => [h("span", { class: `pill ${{ connected: "ok", listening: "" }[each.state] ?? "warn"}` }, each.state), h("code", {}, each.local), h("code", {}, each.peer || "–"),
          bytes(each.to_send), each.state === "listening" ? "–" : bytes(each.to_read)]), { label: `Sockets of ${name}` }));
    }) : h("p", { class: "muted" }, "No socket is open."));
  });
}
