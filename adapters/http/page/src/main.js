// SPDX-License-Identifier: Apache-2.0
// One page for a live world, a recorded run served by a server, and a recorded run embedded in the
// page itself.

import {setText} from "./dom.js";
import {Drawing} from "./drawing.js";
import {listenToKeys} from "./keys.js";
import {get, Live} from "./live.js";
import {Recording} from "./recording.js";
import {Scale} from "./scale.js";
import {Theme} from "./theme.js";
import {Changes} from "./ui/changes.js";
import {Detail} from "./ui/detail.js";
import {buildFrame} from "./ui/frame.js";
import {Legend} from "./ui/legend.js";
import {Lists} from "./ui/lists.js";
import {PlanPanel} from "./ui/plan.js";
import {TimeBar} from "./ui/time.js";
import {World} from "./world.js";

const CLICK_PX = 5;  // A press that moves further rotates the view.
const PANEL_MS = 200;
const AGAIN_MS = 2000;
const NO_WEBGL =
  "This browser can't draw in three dimensions here: it has no WebGL, or it is switched off. " +
  "The lists of tags and antennas still work.";

class View {
  constructor(host) {
    this.at = buildFrame(host);
    this.world = new World();
    this.scale = new Scale();
    this.legend = new Legend(this.at, this.scale, this.world);
    this.legend.draw();
    this.drawing = this.#drawing();
    this.stage = this.drawing?.stage ?? null;
    this.lists =
      new Lists(this.at, this.world, this.scale, (kind, index) => this.select(kind, index));
    this.detail = new Detail(this.at, this.world, this.scale, {
      explained: (link) => this.drawing?.link.show(link),
      coverage: (coverage, height) => this.drawing?.coverage.show(coverage, height),
      clip: (coverage) => this.drawing?.clip(coverage),
      close: () => this.deselect(),
      actions: (kind, name) => this.changes?.actions(kind, name) ?? null
    });
    this.theme = new Theme(this.at, (colors) => this.drawing?.setTheme(colors));
    this.world.listeners.push(() => this.#ask());
    this.stage?.before.push((elapsed) => this.#frame(elapsed));
    this.#buttons();
    listenToKeys(host.hasAttribute("data-whole-page") ? document : host, {
      at: this.at,
      lists: this.lists,
      stage: this.stage,
      timeBar: () => this.time,
      look: (name) => this.look(name),
      deselect: () => this.deselect()
    });
  }

  #drawing() {
    const probe = document.createElement("canvas").getContext("webgl2");
    try {
      if (!probe) throw new Error("no WebGL 2");
      probe.getExtension("WEBGL_lose_context")?.loseContext();
      return new Drawing(this.at.canvas, this.world, this.scale);
    } catch {
      this.at.noWebgl.hidden = false;
      this.at.view.dataset.plain = "";
      setText(this.at.noWebgl, NO_WEBGL);
      this.at.canvas.hidden = this.at.views.hidden = this.at.beams.hidden = this.at.legend.hidden =
        true;
      return null;
    }
  }

  say(state, word) {
    this.at.status.dataset.state = state;
    setText(this.at.status, word);
  }

  #ask() {
    if (this.stage) {
      this.stage.invalidate();
    } else if (!this.asked) {
      this.asked = requestAnimationFrame((now) => {
        this.asked = 0;
        this.#frame(Math.min((now - (this.before ?? now)) / 1000, 0.25));
        this.before = now;
      });
    }
  }

  // Updates everything that changed since the last frame.
  #frame(elapsed) {
    const {world} = this;
    if (this.recording && !world.paused) this.recording.advance(elapsed);
    if (!world.changed.size) return;
    const changed = world.takeChanges();
    if (changed.has("reads") || changed.has("tags-list")) world.survey();
    if (changed.has("scene")) this.#names();
    if (changed.has("estimates")) this.legend.draw();
    this.#widen();
    this.drawing?.update(changed);
    this.time?.update(changed);
    this.changes?.update(changed);
    const now = performance.now();
    const late = [this.lists.update(changed, now), this.detail.update(changed, now)].some(Boolean);
    if (late && !this.panelTimer) {
      this.panelTimer = setTimeout(() => {
        this.panelTimer = 0;
        world.touch("panels");
      }, PANEL_MS);
    }
    if (changed.has("selection")) this.#insets();
    if (this.stage) this.at.views.lastChild.hidden = !this.drawing.robots.place();
    if (this.recording && !world.paused) this.#ask();
  }

  #names() {
    const {name, description} = this.world.scene;
    setText(this.at.name, name || "Tagfield");
    this.at.name.title = description ?? "";
    if (this.at.host.hasAttribute("data-whole-page"))
      document.title = name ? `${name} – Tagfield` : "Tagfield";
  }

  // The colour range of a recorded run is fixed; that of a live world grows with the RSSI read.
  #widen() {
    if (this.recording) return;
    let grew = false;
    for (const rssi of this.world.strength)
      if (rssi === rssi) grew = this.scale.widen(rssi) || grew;
    if (grew) this.legend.draw();
  }

  select(kind, index) {
    this.at.panels.removeAttribute("data-closed");
    this.world.select(kind, index);
    // On a phone the panel replaces the list, and the focus must not be lost with the list.
    const inList = this.at.lists.contains(this.at.root.activeElement);
    requestAnimationFrame(() => {
      if (inList && !this.at.lists.offsetParent) this.at.detail.querySelector("h2")?.focus();
    });
  }

  deselect() {
    if (!this.world.selection) return false;
    const {kind, index} = this.world.selection;
    this.world.select(null);
    this.lists.rows.find((row) => row.kind === kind && row.index === index)?.button.focus();
    return true;
  }

  look(name) {
    if (!this.stage) return;
    const follows = name === "follow" && Boolean(this.drawing.robots.place());
    if (follows)
      this.stage.follows(() => this.drawing.robots.place());
    else if (name !== "follow")
      this.stage.look(name);
    for (const button of this.at.views.children) {
      if (button.dataset.view === "follow") button.setAttribute("aria-pressed", String(follows));
    }
  }

  #insets() {
    const wide = this.at.host.clientWidth > 700;
    this.stage?.setInsets({
      left: wide ? this.at.lists.offsetWidth : 0,
      top: 0,
      bottom: wide ? 0 : 14,
      right: wide && !this.at.detail.hidden ? this.at.detail.offsetWidth : 0
    });
  }

  #buttons() {
    const {at} = this;
    for (const button of at.views.children)
      button.addEventListener("click", () => this.look(button.dataset.view));
    at.beams.addEventListener("click", () => {
      const on = at.beams.getAttribute("aria-pressed") !== "true";
      at.beams.setAttribute("aria-pressed", String(on));
      this.drawing.antennas.showBeams(on);
      this.stage.invalidate();
    });
    at.handle.addEventListener("click", () => {
      const closed = at.panels.toggleAttribute("data-closed");
      at.handle.setAttribute("aria-expanded", String(!closed));
    });
    if (!this.stage) return;
    new ResizeObserver(() => this.#insets()).observe(at.view);
    at.canvas.addEventListener(
      "pointerdown", (event) => (this.pressed = [event.clientX, event.clientY]));
    at.canvas.addEventListener("click", (event) => this.#click(event));
    at.canvas.addEventListener("pointermove", (event) => this.#hover(event));
    at.canvas.addEventListener("pointerleave", () => (at.label.hidden = true));
  }

  // Shows the name of what is under the mouse, but not under a finger, which would cover it.
  #hover(event) {
    const {label} = this.at;
    const at = [event.offsetX, event.offsetY];
    const found = event.pointerType === "mouse" && !event.buttons ?
      this.drawing.picking.nearest(...at, false) :
      null;
    label.hidden = !found;
    if (!found) return;
    setText(
      label,
      found.kind === "tag" ? this.world.tags[found.index].id :
                             this.world.antennas[found.index].name);
    label.style.transform = `translate(${at[0] + 14}px, ${at[1] - 10}px)`;
  }

  #click(event) {
    const [x, y] = this.pressed ?? [event.clientX, event.clientY];
    if (Math.hypot(event.clientX - x, event.clientY - y) > CLICK_PX) return;
    const box = this.at.canvas.getBoundingClientRect();
    const at = [event.clientX - box.left, event.clientY - box.top];
    if (this.picked) {
      this.picked(this.drawing.picking.place(...at));
      return;
    }
    const found = this.drawing.picking.nearest(...at, event.pointerType === "touch");
    if (found)
      this.select(found.kind, found.index);
    else
      this.deselect();
  }

  // Resolves to the position of the next click in the world, or to null if the click hits nothing
  // or Escape is pressed.
  pickPlace(word) {
    if (!this.stage) {
      this.say("refused", "A position can be picked only where the world is drawn");
      return Promise.resolve(null);
    }
    this.picked?.(null);
    setText(this.at.pick, `${word} (Escape: cancel)`);
    this.at.pick.hidden = false;
    return new Promise((resolve) => {
      const end = (place) => {
        this.picked = null;
        this.at.pick.hidden = true;
        document.removeEventListener("keydown", escape);
        resolve(place);
      };
      const escape = (event) => event.key === "Escape" && end(null);
      document.addEventListener("keydown", escape);
      this.picked = end;
    });
  }

  showRecording(run) {
    this.recording = new Recording(this.world, run);
    this.scale.fit(run.reads.rssi);
    this.legend.draw();
    this.time = new TimeBar(this.at, this.world, this.recording, null);
    this.say("recorded", "recorded run");
    this.world.touch("time");
  }

  // Shows an antenna plan as a tab and a layer of its own.
  showPlan(plan) {
    const panel = new PlanPanel(
      plan, (layout, withTags) => this.drawing?.showPlan(plan, layout, withTags));
    this.lists.addTab("plan", "Plan", panel.element, (isOpen) => panel.setOpen(isOpen));
  }

  showLive(status) {
    if (status.plan) get("plan").then((plan) => this.showPlan(plan), () => {});
    const live = new Live(this.world, (state, word) => this.say(state, word));
    const command = (method, path, body) => live.send(method, path, body);
    this.changes = new Changes(this.world, command, (word) => this.pickPlace(word));
    this.lists.addTab("changes", "Change", this.changes.element);
    this.time = new TimeBar(
      this.at, this.world, null,
      (...words) => command(...words).then(
        () => this.say("connected", ""), (error) => this.say("refused", error.message)));
    live.start();
  }

  // Shows the embedded run, if there is one. Otherwise asks the server whether it is live or
  // recorded, and retries until it answers.
  async start() {
    const embedded = document.getElementById("tagfield-run");
    if (embedded) {
      this.showRecording(JSON.parse(embedded.textContent));
      return;
    }
    this.say("connecting", "connecting …");
    try {
      const status = await get("status");
      if (status.mode === "recorded")
        this.showRecording(await get("run"));
      else
        this.showLive(status);
    } catch {
      this.say("away", "The server does not answer; trying again");
      setTimeout(() => this.start(), AGAIN_MS);
    }
  }
}

const host = document.getElementById("tagfield-view");
host.tagfield = new View(host);  // For tests and the browser's console.
host.tagfield.start();
