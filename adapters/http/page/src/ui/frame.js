// SPDX-License-Identifier: Apache-2.0
// The layout of the page with its parts still empty. It is in a shadow root, so that its styles and
// those of the surrounding page do not affect each other.

import {h} from "../dom.js";
import css from "../page.css";

const button = (text, label, properties = {}) =>
  h("button", {type: "button", text, "aria-label": label, title: label, ...properties});

export function buildFrame(host) {
  const root = host.attachShadow({mode: "open"});
  const at = {};
  const keep = (name, element) => (at[name] = element);
  const views = keep(
    "views",
    h("div", {class: "views", role: "group", "aria-label": "View"},
      button("Whole", "View of the whole world (1)", {"data-view": "world"}),
      button("Top", "Top: view from above (2)", {"data-view": "top"}),
      button("Side", "View from the side (3)", {"data-view": "side"}),
      button("Follow", "Follow the robot (4)", {"data-view": "follow", "aria-pressed": "false"})));
  const header =
    h("header", {}, keep("name", h("h1", {text: "Tagfield"})),
      keep("status", h("p", {class: "status", role: "status", "aria-live": "polite"})), views,
      keep("beams", button("Beams", "Show the antennas' beams", {"aria-pressed": "true"})),
      keep("theme", button("Dark", "Switch between light and dark", {class: "theme"})));
  const stage = h(
    "div", {class: "stage"},
    keep(
      "canvas", h("canvas", {
        tabindex: "0",
        role: "application",
        "aria-label":
          "The world in three dimensions. Arrows turn it, plus and minus zoom; " +
            "the lists hold the same tags and antennas."
      })),
    keep("noWebgl", h("p", {class: "no-webgl", hidden: true})),
    keep("label", h("p", {class: "label", "aria-hidden": "true", hidden: true})),
    keep("pick", h("p", {class: "pick", role: "status", hidden: true})),
    keep("legend", h("div", {class: "legend"})));
  const panels = keep(
    "panels",
    h("div", {class: "panels"},
      keep(
        "handle", button("", "Show or hide the lists", {class: "handle", "aria-expanded": "true"})),
      keep("lists", h("section", {class: "lists", "aria-label": "Tags and antennas"})),
      keep(
        "detail",
        h("section", {class: "detail", "aria-label": "What is selected", hidden: true}))));
  const time = keep("time", h("footer", {"aria-label": "Time"}));
  const view = keep("view", h("div", {class: "view"}, header, stage, panels, time));
  root.append(h("style", {text: css}), view);
  return {root, host, ...at};
}
