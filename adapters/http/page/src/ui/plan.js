// SPDX-License-Identifier: Apache-2.0
// Panel of an antenna plan: a slider over the number of antennas, the figures of that layout, and a
// table of its antennas.

import {bandColor} from "../colors.js";
import {fixed, h, setText} from "../dom.js";

const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
const percent = (share) => `${Math.round(100 * share)} %`;

function bandText(edges, i) {
  if (i === 0) return `under ${percent(edges[0])}`;
  if (i === edges.length) return edges[i - 1] >= 0.995 ? "100 %" : `${percent(edges[i - 1])} and more`;
  return `${percent(edges[i - 1])} to ${percent(edges[i])}`;
}

export class PlanPanel {
  // show(layout|null, withTags): draws the layout with this index, instead of the tags or together
  // with them; null draws the tags alone.
  constructor(plan, show) {
    Object.assign(this, {plan, show, isOpen: false});
    this.count = h("input", {
      id: "plan-layout",
      type: "range",
      min: "0",
      max: String(plan.layouts.length - 1),
      step: "1",
      value: String(plan.chosen),
      oninput: () => this.refresh()
    });
    this.withTags = h("input", {id: "plan-tags", type: "checkbox", onchange: () => this.refresh()});
    this.said = h("p", {role: "status", class: "verdict", "data-read": "yes"});
    this.facts = h("dl", {class: "facts"});
    this.antennas = h("tbody");
    this.element =
      h("div", {class: "changes"}, h("h3", {text: `Plan of ${plan.scenario}`}),
        h("div", {class: "fields"}, h("label", {for: "plan-layout", text: "Antennas"}), this.count),
        this.said, this.facts,
        h("div", {class: "row"}, this.withTags,
          h("label", {for: "plan-tags", text: "Tags and their reads, too"})),
        this.#legend(),
        h("table", {}, h("caption", {text: "Its antennas"}), this.antennas));
    this.refresh();
  }

  #legend() {
    const {edges, colors} = this.plan;
    const key = (color, i) => {
      const swatch = h("span", {class: "swatch square"});
      swatch.style.background = bandColor(color);
      return h("span", {class: "key"}, swatch, h("span", {text: bandText(edges, i)}));
    };
    return h(
      "div", {},
      h("p", {
        class: "note",
        text: `Cubes are positions of tags, coloured by how many are ${
          this.plan.counts}, over orientations and fading; frames are antennas.`
      }),
      h("div", {class: "keys"}, ...colors.map(key)));
  }

  setOpen(isOpen) {
    this.isOpen = isOpen;
    this.refresh();
  }

  refresh() {
    const {plan} = this;
    const at = Number(this.count.value);
    const layout = plan.layouts[at];
    const [mean, low, high] = layout.read;
    const count = counted(layout.antennas.length, "antenna");
    this.count.setAttribute("aria-valuetext", count);
    setText(
      this.said,
      `${count}: ${fixed(mean, 0)} of ${plan.tags} tags ${plan.counts} in ${plan.dwell_s} s` +
        (at === plan.chosen ? " (chosen)" : ""));
    const facts = [
      ["95 % of runs", `${Math.ceil(low)} to ${Math.floor(high)} tags`],
      ["readers", String(layout.readers)], ["cost", String(layout.cost)]
    ];
    this.facts.replaceChildren(
      ...facts.flatMap(([name, value]) => [h("dt", {text: name}), h("dd", {text: value})]));
    this.antennas.replaceChildren(...layout.antennas.map(
      ({name, reader, power_dbm: power}) =>
        h("tr", {}, h("th", {scope: "row", text: name}), h("td", {text: reader}),
          h("td", {class: "number", text: `${power} dBm`}))));
    this.show(this.isOpen ? at : null, this.withTags.checked);
  }
}
