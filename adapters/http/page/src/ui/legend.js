// SPDX-License-Identifier: Apache-2.0
// Legend of the colours in the world.

import {rssiCss} from "../colors.js";
import {h} from "../dom.js";

const STEPS = 12;

export class Legend {
  constructor(at, scale, world) {
    Object.assign(this, {at, scale, world, drawn: ""});
  }

  draw() {
    const {low, high} = this.scale;
    const located = this.world.estimates.size > 0;
    if (this.drawn === `${low} ${high} ${located}`) return;
    this.drawn = `${low} ${high} ${located}`;
    const ramp = h("div", {
      class: "ramp",
      role: "img",
      "aria-label": `RSSI from ${low} dBm, dark blue, to ${high} dBm, yellow`
    });
    ramp.style.background = `linear-gradient(to right, ${
      Array.from({length: STEPS + 1}, (_, i) => rssiCss(i / STEPS)).join(", ")})`;
    const ticks =
      h("div", {class: "ticks"},
        ...[0, 0.5, 1].map(
          (share) => h("span", {text: `${low + share * (high - low)}`.replace("-", "−")})));
    const key = (style, text) => {
      const swatch = h("span", {class: "swatch"});
      swatch.style.border = style;
      return h("div", {class: "key"}, swatch, h("span", {text}));
    };
    this.at.legend.replaceChildren(
      h("div", {text: "RSSI [dBm]"}), h("div", {class: "ramp-back"}, ramp), ticks,
      key(`2px solid ${rssiCss(0.5)}`, "read before, not recently"),
      key("3px solid gray", "never read"),
      ...(
        located ? [h(
                    "div", {class: "key"}, h("span", {class: "swatch cross", text: "+"}),
                    h("span", {text: "located there; 95 % ellipse"}))] :
                  []));
  }
}
