// What the colours of the world mean.

import {h} from "../dom.js";
import {rssiCss} from "../colors.js";

const STEPS = 12;

export class Legend {
  constructor(at, scale) {
    this.at = at;
    this.scale = scale;
  }

  draw() {
    const {low, high} = this.scale;
    const ramp = h("div", {class: "ramp", role: "img", "aria-label": `RSSI from ${low} dBm, blue, to ${high} dBm, red`});
    ramp.style.background = `linear-gradient(to right, ${Array.from({length: STEPS + 1}, (_, i) => rssiCss(i / STEPS)).join(", ")})`;
    const ticks = h("div", {class: "ticks"}, ...[0, 0.5, 1].map((share) =>
      h("span", {text: `${low + share * (high - low)}`.replace("-", "−")})));
    const key = (style, text) => {
      const swatch = h("span", {class: "swatch"});
      swatch.style.border = style;
      return h("div", {class: "key"}, swatch, h("span", {text}));
    };
    this.at.legend.replaceChildren(h("div", {text: "RSSI [dBm]"}), h("div", {class: "ramp-back"}, ramp), ticks,
      key(`2px solid ${rssiCss(0.5)}`, "read before, not of late"), key("3px solid gray", "never read"));
  }
}
