// SPDX-License-Identifier: Apache-2.0
// Lists of tags and antennas with a search: the world for keyboard and screen reader users.

import {antennaColor, rssiCss} from "../colors.js";
import {fixed, h, naturally, setText} from "../dom.js";

const MOST = 200;
const PERIOD_MS = 500;

export class Lists {
  // select(kind, index) is called when a row is clicked.
  constructor(at, world, scale, select) {
    Object.assign(this, {world, scale, select, rows: [], shown: "tags", last: 0});
    this.search = h("input", {
      type: "search",
      placeholder: "Search",
      "aria-label": "Search tags and antennas",
      oninput: () => this.rebuild()
    });
    this.sort =
      h("select", {"aria-label": "Order", onchange: () => this.rebuild()},
        h("option", {value: "name", text: "by name"}),
        h("option", {value: "strength", text: "by RSSI"}),
        h("option", {value: "rate", text: "by reads/s"}));
    this.count = h("p", {class: "count", role: "status"});
    this.list = h("ul", {class: "list"});
    this.tabs = h("div", {class: "tabs", role: "tablist", "aria-label": "Lists"});
    this.listing = [h("div", {class: "search"}, this.search, this.sort), this.count, this.list];
    this.onshown = new Map();
    this.panels = new Map([["tags", this.listing], ["antennas", this.listing]]);
    at.lists.append(this.tabs, ...this.listing);
    this.host = at.lists;
    this.#tab("tags", "Tags");
    this.#tab("antennas", "Antennas");
    this.tabs.addEventListener("keydown", (event) => this.#arrows(event));
  }

  #tab(name, text) {
    this.tabs.append(
      h("button",
        {type: "button", role: "tab", text, "data-tab": name, onclick: () => this.show(name)}));
    this.#mark();
  }

  // onshown(whether): called with true when the tab is opened, with false when it is left.
  addTab(name, text, element, onshown = () => {}) {
    this.panels.set(name, [element]);
    this.onshown.set(name, onshown);
    element.hidden = true;
    this.host.append(element);
    this.#tab(name, text);
  }

  #arrows(event) {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!step) return;
    const all = [...this.tabs.children];
    const next =
      all[(all.findIndex((one) => one.dataset.tab === this.shown) + step + all.length) % all.length];
    this.show(next.dataset.tab);
    next.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  #mark() {
    for (const tab of this.tabs.children) {
      tab.setAttribute("aria-selected", String(tab.dataset.tab === this.shown));
      tab.tabIndex = tab.dataset.tab === this.shown ? 0 : -1;
    }
  }

  show(name) {
    if (name !== this.shown) {
      this.onshown.get(this.shown)?.(false);
      this.onshown.get(name)?.(true);
    }
    this.shown = name;
    for (const elements of this.panels.values())
      for (const element of elements) element.hidden = true;
    for (const element of this.panels.get(name)) element.hidden = false;
    this.sort.hidden = name !== "tags";
    this.#mark();
    this.rebuild();
  }

  #matching() {
    const {world} = this;
    const words = this.search.value.toLowerCase();
    const all = this.shown === "tags" ? world.tags : world.antennas;
    const found = [];
    all.forEach((one, i) => {
      if (one.present && (one.id ?? one.name).toLowerCase().includes(words)) found.push(i);
    });
    if (this.shown === "antennas") return found.sort((a, b) => naturally(all[a].name, all[b].name));
    const rank = this.#ranks();
    if (this.sort.value === "name") return found.sort((a, b) => rank[a] - rank[b]);
    const key = this.sort.value === "rate" ? world.tagRate : world.strength;
    const value = (i) => (Number.isNaN(key[i]) ? -999 : key[i]);
    return found.sort((a, b) => value(b) - value(a) || rank[a] - rank[b]);
  }

  // Ranks of the tags in the order of their names, cached: comparing thousands of names is slow.
  #ranks() {
    const {tags} = this.world;
    if (this.ranks?.length === tags.length) return this.ranks;
    const order = tags.map((_, i) => i).sort((a, b) => naturally(tags[a].id, tags[b].id));
    this.ranks = new Int32Array(tags.length);
    order.forEach((tag, place) => (this.ranks[tag] = place));
    return this.ranks;
  }

  rebuild() {
    if (this.shown !== "tags" && this.shown !== "antennas") return;
    const found = this.#matching();
    const what = this.shown === "tags" ? "tag" : "antenna";
    setText(
      this.count,
      `${found.length} ${what}${found.length === 1 ? "" : "s"}` +
        (found.length > MOST ? `, the first ${MOST} are listed; search for the others` : ""));
    while (this.rows.length > Math.min(found.length, MOST)) this.rows.pop().item.remove();
    found.slice(0, MOST).forEach((index, i) => {
      if (!this.rows[i]) this.#addRow(i);
      this.rows[i].index = index;
      this.rows[i].kind = what;
    });
    this.refresh();
  }

  #addRow(i) {
    const row = {
      swatch: h("span", {class: "swatch"}),
      id: h("span", {class: "id"}),
      now: h("span", {class: "now"})
    };
    row.button =
      h("button", {type: "button", onclick: () => this.select(row.kind, row.index)}, row.swatch,
        row.id, row.now);
    row.item = h("li", {}, row.button);
    this.rows[i] = row;
    this.list.append(row.item);
  }

  refresh() {
    const {selection} = this.world;
    for (const row of this.rows) {
      if (row.kind === "tag")
        this.#tag(row);
      else
        this.#antenna(row);
      row.button.setAttribute(
        "aria-pressed", String(selection?.kind === row.kind && selection.index === row.index));
    }
  }

  #tag(row) {
    const {world, scale} = this;
    const strength = world.strength[row.index];
    const lately = !Number.isNaN(strength);
    const before = !Number.isNaN(world.lastRssi[row.index]);
    setText(row.id, world.tags[row.index].id);
    setText(
      row.now,
      lately ? `${fixed(strength, 0)} dBm · ${fixed(world.tagRate[row.index], 0)}/s` :
        before ? "not recently" :
                 "not read");
    row.swatch.className = "swatch";
    row.swatch.style.background = lately ? rssiCss(scale.share(strength)) : "transparent";
    row.swatch.style.border = lately ?
      "0" :
      `2px solid ${before ? rssiCss(scale.share(world.lastRssi[row.index])) : "gray"}`;
  }

  #antenna(row) {
    const antenna = this.world.antennas[row.index];
    setText(row.id, antenna.name);
    setText(
      row.now,
      antenna.faulty         ? "disconnected" :
        antenna.on === false ? "off" :
                               `${fixed(antenna.rate, 0)}/s · ${antenna.inSight} tags`);
    row.swatch.className = "swatch square";
    row.swatch.style.border = "0";
    row.swatch.style.background = antennaColor(row.index);
  }

  // At most twice a second, which is enough for eyes and screen readers; names and order only when
  // they change. Returns true if an update is still due.
  update(changed, now) {
    const anew = changed.has("tags-list") || changed.has("antennas");
    if (!anew && !changed.has("selection") && now - this.last < PERIOD_MS) return true;
    this.last = now;
    if (changed.has("tags-list")) this.ranks = null;
    if (anew || this.sort.value !== "name")
      this.rebuild();
    else
      this.refresh();
    return false;
  }
}
