// The frame around all pages: what they are, the state of the controller, who is logged in.

import { dialog, h, put, setText, toast } from "./dom.js";
import { uptime } from "./format.js";
import { controls } from "./control.js";
import { Ears, link } from "./link.js";
import { showForces } from "./forces.js";
import * as classes from "./pages/classes.js";
import * as logbook from "./pages/logbook.js";
import * as network from "./pages/network.js";
import * as source from "./pages/source.js";
import * as system from "./pages/system.js";
import * as trace from "./pages/trace.js";
import * as variables from "./pages/variables.js";

const PAGES = [
  ["system", "System", system],
  ["classes", "Task classes", classes],
  ["variables", "Variables", variables],
  ["trace", "Trace", trace],
  ["source", "Source", source],
  ["logbook", "Logbook", logbook],
  ["network", "Network", network],
];

const page = document.getElementById("page");
let ears = null;

function showNav(name) {
  put(document.getElementById("nav"), PAGES.map(([key, title]) =>
    h("a", { href: `#${key}`, "aria-current": key === name ? "page" : null }, title)));
}

function open() {
  const [name] = location.hash.slice(1).split("/");
  const [key, title, module] = PAGES.find(([each]) => each === name) ?? PAGES[0];
  ears?.end();
  ears = new Ears();
  showNav(key);
  document.title = `${title} – ${link.facts?.project ?? "plcsim"}`;
  if (link.user === null) { put(page, h("p", { class: "muted" }, "Connecting to the controller …")); return; }
  put(page);
  module.show(page, ears);
}

function showState() {
  const state = document.getElementById("state");
  const status = link.status;
  let [text, kind] = ["offline", "bad"];
  if (link.isOpen && status) {
    text = status.state;
    kind = { RUN: "ok", SERVICE: "bad", STOPPED: "warn", BOOT: "warn" }[text] ?? "";
    if (status.is_paused) [text, kind] = ["PAUSED", "warn"];
    else if (!status.is_alive && text === "RUN") [text, kind] = ["NO ANSWER", "bad"];
  }
  setText(state, text);
  state.className = `pill ${kind}`;
  setText(document.getElementById("elapsed"), status ? uptime(status.elapsed_ns) : "");
}

function showForced() {
  const button = document.getElementById("forced");
  button.hidden = !link.forces.length;
  setText(button, `${link.forces.length} forced`);
}

function showWho() {
  const user = link.user;
  const place = document.getElementById("who");
  if (!user?.has_users) { put(place, h("span", { class: "muted", title: "No users are set up: this machine alone is let in" }, "local")); return; }
  put(place, h("span", { class: "muted" }, `${user.name} · ${user.role}`),
    h("button", { class: "quiet", onclick: logOut }, "Log out"));
}

async function logOut() {
  await fetch("logout", { method: "POST" });
  location.reload();
}

function askWho() {
  if (document.querySelector("dialog.login")) return;
  link.user = null;
  const box = dialog("Log in", (self) => {
    const name = h("input", { id: "login-name", autocomplete: "username", required: true, autofocus: true });
    const password = h("input", { id: "login-password", type: "password", autocomplete: "current-password", required: true });
    const fault = h("p", { class: "fault", role: "alert" });
    const send = async (event) => {
      event.preventDefault();
      const answer = await fetch("login", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ name: name.value, password: password.value }),
      });
      const told = await answer.json();
      if (!answer.ok) { setText(fault, told.error); password.select(); return; }
      self.done = true;
      self.close();
      link.connect();
    };
    return h("form", { class: "fields", onsubmit: send },
      h("label", { for: "login-name" }, "Name"), name,
      h("label", { for: "login-password" }, "Password"), password,
      fault, h("div", { class: "buttons" }, h("button", { class: "primary" }, "Log in")));
  }, { class: "login" });
  box.addEventListener("cancel", (event) => event.preventDefault());
}

link.addEventListener("hello", () => {
  setText(document.getElementById("project"), link.facts.project);
  showWho();
  controls(document.getElementById("control"));
  open();
});
link.addEventListener("status", showState);
link.addEventListener("forces", showForced);
link.addEventListener("fault", (event) => toast(event.detail));
link.addEventListener("closed", (event) => {
  showState();
  if (event.detail === 4401) askWho();
});
document.getElementById("forced").addEventListener("click", showForces);
window.addEventListener("hashchange", () => { open(); page.focus({ preventScroll: true }); scrollTo(0, 0); });
showNav("");
open();
link.connect();
