// Network: the TCP sockets of the processes of the run.

import { card, h, put, table } from "../dom.js";
import { bytes } from "../format.js";
import { link } from "../link.js";

export function show(page, ears) {
  const place = h("div", {}, h("p", { class: "muted" }, "Looking …"));
  put(page, h("h1", {}, "Network"), place,
    h("p", { class: "hint" }, "As the kernel tells them: peers of AsTCP blocks and of the ROS node belong to the scan, clients of Modbus and browsers to their services."));
  ears.keep(link.follow("network"));
  ears.on("network", (told) => {
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
