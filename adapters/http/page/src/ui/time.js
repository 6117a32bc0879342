// SPDX-License-Identifier: Apache-2.0
// The time bar: pause, step and speed of a live world; play, slider and speed of a recorded run.

import {fixed, h, setText} from "../dom.js";

const STEP_S = 0.1;
const clock = (t) => `${fixed(t, t < 1000 ? 2 : 1)} s`;

export class TimeBar {
  // command(method, path, body): sends it to the live server. recording: null for a live world.
  constructor(at, world, recording, command) {
    Object.assign(this, {world, recording, command});
    this.pause = h("button", {type: "button", class: "pause", onclick: () => this.toggle()});
    this.clock = h("output", {class: "clock", "aria-label": "Simulated time"});
    this.numbers = h("span", {class: "numbers"});
    this.silent = h("span", {class: "numbers", role: "status"});
    this.dropped = h("span", {class: "dropped", role: "status"});
    at.time.replaceChildren(
      this.pause, ...(recording ? this.#recorded() : this.#live()), this.numbers, this.silent, this.dropped);
  }

  #speeds(choices, change) {
    this.speed =
      h("select", {"aria-label": "Speed", onchange: change},
        ...choices.map(([value, text]) => h("option", {value, text})));
    return this.speed;
  }

  #live() {
    this.step = h("button", {
      type: "button",
      text: "Step",
      title: `Step by ${STEP_S} s (.)`,
      onclick: () => this.stepOn()
    });
    return [
      this.step,
      this.#speeds(
        [["1", "speed 1"], ["10", "speed 10"], ["0", "speed max"]],
        () => this.command("POST", "speed", {speed: Number(this.speed.value)})),
      this.clock
    ];
  }

  #recorded() {
    const {first, last} = this.recording;
    this.slider = h("input", {
      type: "range",
      min: String(first),
      max: String(last),
      step: String(Math.max((last - first) / 5000, 0.001)),
      "aria-label": "Moment of the run",
      oninput: () => this.#slide()
    });
    const speeds = ["0.25", "1", "2", "5", "10", "50"].map((value) => [value, `speed ${value}`]);
    this.#speeds(speeds, () => (this.world.speed = Number(this.speed.value)));
    this.speed.value = "1";
    return [this.speed, this.slider, this.clock];
  }

  #slide() {
    this.recording.play(false);
    this.recording.seek(Number(this.slider.value));
  }

  toggle() {
    if (this.recording)
      this.recording.play(this.world.paused);
    else
      this.command("POST", this.world.paused ? "resume" : "pause");
  }

  // Steps by some seconds: a recorded run forwards or backwards, a live world only forwards.
  stepOn(seconds = STEP_S) {
    if (this.recording) {
      this.recording.play(false);
      this.recording.seek(this.world.time + seconds);
    } else if (seconds > 0) {
      this.command("POST", "step", {seconds});
    }
  }

  // Another client may have chosen a speed that is not in the list.
  #showSpeed(value) {
    if (![...this.speed.options].some((one) => one.value === value)) {
      this.speed.append(h("option", {value, text: `speed ${value}`}));
    }
    this.speed.value = value;
  }

  update(changed) {
    if (!changed.has("time")) return;
    const {world} = this;
    setText(
      this.pause,
      this.recording ? (world.paused ? "Play" : "Pause") :
        world.paused ? "Resume" :
                       "Pause");
    setText(
      this.clock,
      this.recording ? `${clock(world.time)} of ${clock(this.recording.last)}` : clock(world.time));
    if (this.slider) {
      this.slider.value = String(world.time);
      this.slider.setAttribute("aria-valuetext", clock(world.time));
    }
    if (this.step) this.step.disabled = !world.paused;
    const rate = world.antennas.reduce((sum, one) => sum + one.rate, 0);
    const pace = this.recording || world.paused ? "" : ` · ${fixed(world.pace)} × real time`;
    setText(this.numbers, `${fixed(rate, 0)} reads/s${pace}`);
    const isOff = (antenna) => antenna.on === false || antenna.faulty;
    const noneIsOn = !this.recording && world.antennas.length > 0 && world.antennas.every(isOff);
    setText(this.silent, noneIsOn ? "No antenna is on: readers over LLRP wait for a client" : "");
    setText(
      this.dropped, world.dropped ? `${world.dropped} reads not shown: this page is too slow` : "");
    if (!this.recording && this.speed !== this.speed.getRootNode().activeElement)
      this.#showSpeed(String(world.speed));
  }
}
