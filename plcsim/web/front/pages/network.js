// Network: the TCP sockets of the processes of the run, topics of nodes, idents of blocks.

import { card, h, put, table } from "../dom.js";
import { bytes, count } from "../format.js";
import { link } from "../link.js";

export function show(page, ears) {
  const place = h("div", {}, h("p", { class: "muted" }, "Looking …"));
  put(page, h("h1", {}, "Network"), place,
    h("p", { class: "hint" }, "As the kernel tells them: peers of AsTCP blocks and of the ROS node belong to the scan, clients of Modbus and browsers to their services. A segment is what TCP sends at once: of a Modbus client, a request."));
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
    const rows = told.topics.map((row) => [h("code", {}, row[1]), row[2], row[0], row[3] ? "sent to" : "received from", row[7].length ? row[7].map((peer) => h("div", {}, h("code", {}, peer))) : "nobody",
      count(row[4]), `${rate(row, 4).toFixed(1)} /s`, `${bytes(rate(row, 5))}/s`, h("span", { class: row[6] ? "warn-text" : "" }, count(row[6]))]);
    put(topics, rows.length ? card("ROS topics", table(["Topic", "Type", "Node", "", "Other ends", ["Messages", "end"], ["Rate", "end"], ["Bytes", "end"], ["Lost", "end"]], rows, { label: "ROS topics" })) : null,
      told.tcp.length ? card("AsTCP idents", table([["Ident", "end"], "Peer", "Last block", "Status"], told.tcp.map(([ident, peer, block, status]) => [String(ident), h("code", {}, peer || "–"), block, h("code", {}, status)]), { label: "AsTCP idents" })) : null,
      Object.keys(told.idents).length ? card("Idents in use", h("dl", {}, Object.entries(told.idents).map(([name, number]) => [h("dt", {}, name), h("dd", { class: "num" }, String(number))]))) : null);
    if (!before || told.time_ns > before.time_ns) before = told;
  };
  let counted = { now_ns: 0, by: new Map() };
  ears.on("network", (told) => {
    drawTopics(told);
    const since = (told.now_ns - counted.now_ns) / 1e9;
    const by = new Map(told.sockets.filter((each) => each.counts).map((each) => [`${each.process} ${each.local} ${each.peer}`, each.counts]));
    const last = counted.by;
    counted = { now_ns: told.now_ns, by };
    // of counts: what was sent again, bytes sent, bytes received, segments received, segments sent
    const rate = (each, at) => {
      const old = last.get(`${each.process} ${each.local} ${each.peer}`);
      return each.counts && old && each.state !== "listening" ? (each.counts[at] - old[at]) / since : null;
    };
    const perSecond = (each, at, text) => { const found = rate(each, at); return found === null ? "–" : `${text(found)}/s`; };
    const names = [...new Set(told.sockets.map((each) => each.process))];
    put(place, names.length ? names.map((name) => {
      const own = told.sockets.filter((each) => each.process === name);
      const connected = own.filter((each) => each.state === "connected").length;
      return card(`${name} · ${connected} connected`, table(["State", "Local", "Peer", ["Segments in", "end"], ["Bytes in", "end"], ["Bytes out", "end"], ["Sent again", "end"], ["To be sent", "end"], ["To be read", "end"]],
        own.map((each) => [h("span", { class: `pill ${{ connected: "ok", listening: "" }[each.state] ?? "warn"}` }, each.state), h("code", {}, each.local), h("code", {}, each.peer || "–"),
          perSecond(each, 3, (number) => number.toFixed(1)), perSecond(each, 2, bytes), perSecond(each, 1, bytes), each.counts && each.state !== "listening" ? count(each.counts[0]) : "–",
          bytes(each.to_send), each.state === "listening" ? "–" : bytes(each.to_read)]), { label: `Sockets of ${name}` }));
    }) : h("p", { class: "muted" }, "No socket is open."));
  });
}
