// The list of all forced tags, from every page.

import { attempt, dialog, h, put, table } from "./dom.js";
import { link } from "./link.js";

export function showForces() {
  dialog("Forced variables", (box) => {
    const place = h("div");
    const draw = () => {
      if (!link.forces.length) { box.close(); return; }
      const rows = link.forces.map((force) => [
        h("code", {}, force.path), h("code", {}, force.value), force.by,
        h("button", { disabled: !link.may("engineer"), onclick: () => attempt(() => link.ask("release", { tag: force.path }), `${force.path} is released`) }, "Release"),
      ]);
      put(place, table(["Variable", ["Value", "end"], "By", ""], rows, { label: "Forced variables" }),
        h("div", { class: "buttons" }, h("button", { class: "danger", disabled: !link.may("engineer"), onclick: () => attempt(() => link.ask("release", { tag: "" }), "All are released") }, "Release all")));
    };
    link.addEventListener("forces", draw);
    box.addEventListener("close", () => link.removeEventListener("forces", draw));
    draw();
    return place;
  }, { class: "wide" });
}
