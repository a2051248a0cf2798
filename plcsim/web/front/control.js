// Stop, start, pause: what may be done to the controller itself.

import { attempt, dialog, h, put, setText } from "./dom.js";
import { link } from "./link.js";

const SPEEDS = [["0.1×", 100_000], ["1×", 1_000_000], ["10×", 10_000_000], ["as fast as possible", 0]];

export function controls(place) {
  const operate = link.may("operate");
  const pause = h("button", { disabled: !operate, onclick: () => attempt(() => link.ask("pause")) }, "Pause");
  const go = h("button", { disabled: !operate, onclick: () => attempt(() => link.ask("continue")) }, "Continue");
  const step = h("button", { disabled: !link.may("engineer"), title: "One cycle of the fastest class", onclick: () => attempt(() => link.ask("cycles", { argument: 1 })) }, "Single cycle");
  const menu = h("button", { disabled: !operate, onclick: showMenu }, "Control …");
  put(place, pause, go, step, menu);
  const draw = () => {
    const paused = link.status?.is_paused ?? false;
    const runs = link.status?.state === "RUN";
    pause.hidden = !runs || paused;
    go.hidden = step.hidden = !runs || !paused;
  };
  link.addEventListener("status", draw);
  draw();
}

function ask(title, text, act, kind = "danger") {
  dialog(title, (box) => h("div", {}, h("p", {}, text), h("div", { class: "buttons" },
    h("button", { class: kind, onclick: async () => { box.close(); await attempt(act); } }, title),
    h("button", { onclick: () => box.close() }, "Cancel"))));
}

function showMenu() {
  dialog("Control", (box) => {
    const engineer = link.may("engineer");
    const row = (title, text, act, may = true) => h("div", { class: "choice" },
      h("button", { disabled: !may, onclick: () => { box.close(); ask(title, text, act); } }, title), h("p", { class: "muted" }, text));
    const parts = [
      row("Stop", link.facts.stays ? "EXIT of all programs runs; the controller waits in STOPPED." : "EXIT of all programs runs and the run ends, this page with it.", () => link.ask("stop")),
      row("Warm start", "INIT of all programs runs again; retained variables are kept.", () => link.ask("warm_restart")),
      row("Cold start", "INIT of all programs runs again; retained variables are cleared.", () => link.ask("cold_restart"), engineer),
    ];
    if (link.facts.is_virtual) {
      parts.push(h("h3", {}, "Speed of virtual time"), h("div", { class: "buttons" }, SPEEDS.map(([title, argument]) =>
        h("button", { disabled: !engineer, onclick: () => attempt(() => link.ask("speed", { argument })) }, title))));
    }
    return h("div", {}, parts);
  });
}
