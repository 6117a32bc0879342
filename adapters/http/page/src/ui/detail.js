// SPDX-License-Identifier: Apache-2.0
// Details of the selected tag or antenna.

import {antennaColor, MARGINS} from "../colors.js";
import {fixed, h, setText} from "../dom.js";
import {get} from "../live.js";

import {budget} from "./budget.js";
import {drawChart} from "./charts.js";

const CHART_S = 30;
const CHART_MS = 150;
const EXPLAIN_MS = 1000;
const MOST_POINTS = 3000;  // Maximum drawn in a chart [1].
const LEAST_CELL_M = 0.25;
const MOST_CELLS =
  190;  // Maximum per side of the square within the antenna's range that the server computes.
const PHASE = {
  title: "Phase [rad]",
  low: 0,
  high: 2 * Math.PI,
  ticks: [0, Math.PI, 2 * Math.PI],
  label: (value) => ["0", "π", "2π"][Math.round(value / Math.PI)]
};

const place = (p) => `(${fixed(p[0], 2)}, ${fixed(p[1], 2)}, ${fixed(p[2], 2)}) m`;

export class Detail {
  // hooks: {explained(json|null), coverage(json|null, height), close(), actions(kind, name) →
  // element|null}
  constructor(at, world, scale, hooks) {
    Object.assign(
      this, {at, world, scale, hooks, shown: "", request: 0});
    this.#forget();
  }

  #style() {
    const style = getComputedStyle(this.at.view);
    return {
      ink: style.getPropertyValue("--ink"),
      faint: style.getPropertyValue("--faint"),
      line: style.getPropertyValue("--line")
    };
  }

  #head(kind, name) {
    return h(
      "div", {class: "head"}, h("h2", {text: `${kind} ${name}`, tabindex: "-1"}),
      h("button", {type: "button", text: "Close", onclick: () => this.hooks.close()}));
  }

  #facts(names) {
    this.values = {};
    return h(
      "dl", {class: "facts"},
      ...names.flatMap((name) => [h("dt", {text: name}), (this.values[name] = h("dd"))]));
  }

  show() {
    const {selection} = this.world;
    const name = selection ? JSON.stringify(this.world.selectedName()) : "";
    if (name === this.shown) return;
    this.shown = name;
    ++this.request;
    this.#forget();
    this.hooks.explained(null);
    this.hooks.coverage(null);
    this.at.detail.hidden = !selection;
    this.at.panels.toggleAttribute("data-detail", Boolean(selection));
    this.at.detail.replaceChildren(...(selection ? this[selection.kind](selection.index) : []));
    this.at.detail.scrollTop = 0;
  }

  tag(index) {
    const {id} = this.world.tags[index];
    this.charts =
      [h("canvas", {class: "chart", role: "img"}), h("canvas", {class: "chart", role: "img"})];
    this.keys = h("div", {class: "keys"});
    this.keysText = "";
    this.why = h("div", {});
    this.choice = h("select", {
      "aria-label": "Antenna of the link",
      onchange: () => {
        this.chosen = this.choice.value;
        this.#forget();
        this.world.touch("time");
      }
    });
    this.chosen = "";
    const parts = [
      this.#head("Tag", id), this.#facts(["EPC", "position", "reads", "RSSI now", "estimate"]),
      this.hooks.actions("tag", id), h("h3", {text: "Reads of the last half minute"}),
      ...this.charts, this.keys, h("h3", {text: "Why it is read, or not"})
    ];
    parts.push(
      this.world.live ? h("div", {class: "row"}, h("label", {text: "by antenna"}), this.choice) :
                        null,
      this.why);
    setText(this.values.EPC, id);
    if (!this.world.live) this.why.append(this.#offline(id));
    return parts.filter(Boolean);
  }

  #offline(id) {
    return h(
      "p", {class: "note"},
      "A recorded run holds reads, not the link. This explains it, at any moment: ", h("code", {
        text:
          `tagfield explain SCENARIO --tag ${id} --antenna NAME --time ${fixed(this.world.time, 1)}`
      }));
  }

  antenna(index) {
    const antenna = this.world.antennas[index];
    const parts = [
      this.#head("Antenna", antenna.name),
      this.#facts(["reader", "position", "reads", "tags in sight", "model", "carrier", "power"]),
      (this.actions = this.hooks.actions("antenna", antenna.name))
    ];
    setText(
      this.values.reader,
      `${antenna.reader || "–"}${antenna.port ? `, port ${antenna.port}` : ""}`);
    setText(
      this.values.model,
      antenna.model === "paper" ? `paper, range ${fixed(antenna.range)} m` : antenna.model);
    setText(this.values.carrier, `${fixed(antenna.frequency / 1e6, 1)} MHz`);
    setText(
      this.values.power, antenna.power_dbm === null ? "–" : `${fixed(antenna.power_dbm)} dBm`);
    if (this.world.live) parts.push(...this.#coverage(antenna.name));
    return parts.filter(Boolean);
  }

  #coverage(name) {
    const height = h("input", {
      type: "number",
      step: "0.1",
      min: "0",
      max: "50",
      value: "1.0",
      id: "height",
      class: "short"
    });
    const word = h("p", {class: "note", role: "status"});
    const legend = h("div", {hidden: true}, ...MARGINS.map(([, [r, g, b], text]) => {
      const swatch = h("span", {class: "swatch square"});
      swatch.style.background = `rgb(${r} ${g} ${b})`;
      return h("div", {class: "key"}, swatch, h("span", {text}));
    }));
    const draw = async () => {
      const request = ++this.request;
      setText(word, "Computing …");
      try {
        const {range} = this.world.antennas[this.world.antennaIndex.get(name)];
        const cell =
          Math.max(LEAST_CELL_M, Math.ceil((40 * Math.min(range || 0, 100)) / MOST_CELLS) / 20);
        const coverage = await get(`coverage?antenna=${encodeURIComponent(name)}&height=${
          Number(height.value)}&cell=${cell}`);
        if (request !== this.request) return;
        this.hooks.clip(coverage);
        this.hooks.coverage(coverage, Number(height.value));
        const known = coverage.margin_db.filter((one) => one !== null);
        const read = known.filter((one) => one >= 0).length;
        setText(
          word,
          `Read on ${fixed(read * coverage.cell ** 2, 0)} m² of ${
            fixed(known.length * coverage.cell ** 2, 0)} m²; ` +
            "drawn for the antenna's pose just now.");
        legend.hidden = false;
      } catch (error) {
        if (request === this.request) setText(word, error.message);
      }
    };
    const hide = () => {
      ++this.request;
      this.hooks.coverage(null);
      legend.hidden = true;
      setText(word, "");
    };
    return [
      h("h3", {text: "Coverage"}),
      h("div", {class: "row"},
        h("label",
          {for: "height", text: "at a height of"
          }),
        height, h("span", {text: "m"})),
      h("div", {class: "row"}, h("button", {type: "button", text: "Draw coverage", onclick: draw}),
        h("button", {type: "button", text: "Hide", onclick: hide})),
      word, legend
    ];
  }

  // Makes charts and explanation due immediately.
  #forget() {
    this.lastExplain = this.lastChart = -Infinity;
    this.explainedAt = NaN;
  }

  // Returns true if an update is still due.
  update(changed, now) {
    const {selection} = this.world;
    if (changed.has("selection") || changed.has("tags-list") || changed.has("antennas"))
      this.show();
    if (!selection) return false;
    if (changed.has("scene") || changed.has("antennas") || changed.has("tags-list") ||
        changed.has("commanded"))
      this.explainedAt = NaN;
    if (now - this.lastChart < CHART_MS && !changed.has("selection")) return true;
    this.lastChart = now;
    if (selection.kind === "antenna") {
      this.#refreshAntenna(selection.index);
      return false;
    }
    this.#refreshTag(selection.index);
    return this.world.live && this.explainedAt !== this.world.time &&
      !this.#explainIfTime(selection.index, now);
  }

  // Explains the link, at most once per second; returns whether it did.
  #explainIfTime(index, now) {
    if (now - this.lastExplain < EXPLAIN_MS) return false;
    this.lastExplain = now;
    this.explainedAt = this.world.time;
    this.#explain(index);
    return true;
  }

  #refreshAntenna(index) {
    const antenna = this.world.antennas[index];
    setText(this.values.position, antenna.pose ? place(antenna.pose) : "–");
    setText(this.values.reads, antenna.present ? `${fixed(antenna.rate)} a second` : "removed");
    setText(this.values["tags in sight"], String(antenna.inSight));
    this.actions?.refresh();
  }

  #refreshTag(index) {
    const {world} = this;
    const p = world.position.subarray(3 * index, 3 * index + 3);
    const strength = world.strength[index];
    setText(this.values.position, place(p));
    setText(
      this.values.reads,
      world.tags[index].present ? `${fixed(world.tagRate[index])} a second` : "removed");
    setText(
      this.values["RSSI now"],
      Number.isNaN(strength) ? "not read recently" : `${fixed(strength)} dBm`);
    setText(this.values.estimate, this.#estimate(index, p));
    this.#drawCharts(index);
  }

  #estimate(index, p) {
    const estimate = this.world.estimates.get(index);
    if (!estimate) return "none";
    const [x, y, z] = estimate.position;
    return `${place(estimate.position)}, ${
      fixed(100 * Math.hypot(x - p[0], y - p[1], z - p[2]))} cm off`;
  }

  #drawCharts(index) {
    const {world, scale} = this;
    const {log} = world;
    const to = Math.max(world.time, CHART_S / 6);
    const from = Math.max(to - CHART_S, 0);
    const [rssi, phase] = [[], []];
    let lowest = 0;
    const antennas = new Set();
    const counts = new Map();
    for (let i = log.end - 1; i >= 0 && log.t[i] >= from && phase.length < 3 * MOST_POINTS; --i) {
      if (log.tag[i] !== index) continue;
      antennas.add(log.antenna[i]);
      counts.set(log.antenna[i], (counts.get(log.antenna[i]) ?? 0) + log.count[i]);
      phase.push(log.t[i], log.phase[i], log.antenna[i]);
      rssi.push(log.t[i], log.rssi[i], log.antenna[i]);
      lowest = Math.min(lowest, log.rssi[i]);
    }
    const style = this.#style();
    drawChart(this.charts[0], phase, from, to, PHASE, style);
    drawChart(
      this.charts[1], rssi, from, to,
      {title: "RSSI [dBm]", low: Math.min(scale.low, lowest), high: scale.high}, style);
    const reads = [...counts.values()].reduce((a, b) => a + b, 0);
    this.charts[0].setAttribute("aria-label", `Phase of ${reads} reads over time`);
    this.charts[1].setAttribute("aria-label", `RSSI of ${reads} reads over time`);
    const keys = [...antennas].sort((a, b) => a - b);
    const text = keys.map((k) => `${k}:${counts.get(k)}`).join();
    if (text === this.keysText) return;
    this.keysText = text;
    this.keys.replaceChildren(...(
      keys.length ? keys.map((k) => {
        const swatch = h("span", {class: "swatch square"});
        swatch.style.background = antennaColor(k);
        return h(
          "span", {class: "key"}, swatch,
          h("span", {text: `${world.antennas[k].name}: ${counts.get(k)} reads`}));
      }) :
                    [h("span", {class: "note", text: "No reads in this time."})]));
  }

  #choices() {
    const names = this.world.antennas.filter((one) => one.present).map((one) => one.name);
    if (names.join("\n") !== this.choices) {
      this.choices = names.join("\n");
      this.choice.replaceChildren(...names.map((name) => h("option", {value: name, text: name})));
    } else if (!this.choice.children.length) {
      this.choice.append(...names.map((name) => h("option", {value: name, text: name})));
    }
  }

  // The chosen antenna, else that of the strongest recent read of the tag, else the nearest.
  #antennaFor(index) {
    const {world} = this;
    if (this.chosen && world.antennas[world.antennaIndex.get(this.chosen)]?.present)
      return this.chosen;
    const best = world.strongestAntenna(index);
    if (best) return best.name;
    const p = world.position.subarray(3 * index, 3 * index + 3);
    let nearest = null;
    for (const antenna of world.antennas) {
      if (!antenna.present || !antenna.pose) continue;
      const distance =
        Math.hypot(antenna.pose[0] - p[0], antenna.pose[1] - p[1], antenna.pose[2] - p[2]);
      if (!nearest || distance < nearest.distance) nearest = {name: antenna.name, distance};
    }
    return nearest?.name ?? null;
  }

  async #explain(index) {
    const {world} = this;
    this.#choices();
    const name = this.#antennaFor(index);
    if (!name) {
      this.why.replaceChildren(h("p", {class: "note", text: "There is no antenna."}));
      return;
    }
    this.choice.value = name;
    const request = this.request;
    try {
      const link = await get(`explain?antenna=${encodeURIComponent(name)}&tag=${
        encodeURIComponent(world.tags[index].id)}`);
      if (request !== this.request) return;
      this.why.replaceChildren(...budget(link));
      this.hooks.explained(link);
    } catch (error) {
      if (request !== this.request) return;
      this.why.replaceChildren(h("p", {class: "error", text: error.message}));
      this.hooks.explained(null);
    }
  }
}
