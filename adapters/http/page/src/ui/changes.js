// SPDX-License-Identifier: Apache-2.0
// Changes and faults of a live world: adds and removes tags and obstacles, moves and detunes tags,
// disconnects and removes antennas.

import {h, setText} from "../dom.js";

const number = (id, value, properties = {}) =>
  h("input", {type: "number", step: "any", id, value, ...properties});

export class Changes {
  // command(method, path, body) → promise; pickPlace(word) → promise of [x, y, z] or null.
  constructor(world, command, pickPlace) {
    Object.assign(this, {world, command, pickPlace, next: 1});
    this.error = h("p", {class: "error", role: "alert"});
    this.element =
      h("div", {class: "changes"}, this.#tagForm(), this.#obstacleForm(), this.#obstacles(),
        this.error);
  }

  async do(method, path, body, done) {
    setText(this.error, "");
    try {
      await this.command(method, path, body);
      done?.();
    } catch (error) {
      setText(this.error, error.message);
    }
  }

  #form(title, rows, submit, word) {
    const form =
      h("form", {
        onsubmit: (event) => {
          event.preventDefault();
          submit();
        }
      },
        h("h3", {text: title}),
        h("div", {class: "fields"},
          ...rows.flatMap(
            ([text, input]) =>
              [h("label",
                 {for: input.id, text
                 }),
               input])),
        h("div", {class: "row"}, ...word));
    return form;
  }

  #tagForm() {
    const id = h("input", {id: "new-tag", value: "new_tag_1", required: true});
    const [x, y, z] = ["x", "y", "z"].map(
      (axis) => number(`new-tag-${axis}`, axis === "z" ? "1" : "0", {required: true}));
    const pick = async () => {
      const place = await this.pickPlace("Click where the tag is to be");
      if (place) [x, y, z].forEach((input, k) => (input.value = place[k].toFixed(2)));
    };
    const submit = () => this.do(
      "POST", "tags", {id: id.value, position: [x, y, z].map((one) => Number(one.value))}, () => {
        id.value = `new_tag_${++this.next}`;
      });
    return this.#form("Add a tag", [["ID", id], ["x [m]", x], ["y [m]", y], ["z [m]", z]], submit, [
      h("button", {type: "button", text: "Click a position", onclick: pick}),
      h("button", {type: "submit", text: "Add tag"})
    ]);
  }

  #obstacleForm() {
    const name = h("input", {id: "new-obstacle", value: "pallet_1", required: true});
    const [x, y] = ["x", "y"].map((axis) => number(`new-obstacle-${axis}`, "0", {required: true}));
    const [width, depth, height] = [["width", "1.2"], ["depth", "0.8"], ["height", "1.8"]].map(
      ([what, value]) => number(`new-obstacle-${what}`, value, {min: "0.01", required: true}));
    const material =
      h("select", {id: "new-obstacle-material"},
        ...["metal", "wood", "cardboard", "concrete", "glass"].map(
          (one) => h("option", {text: one})));
    const pick = async () => {
      const place = await this.pickPlace("Click where the pallet is to stand");
      if (place) [x, y].forEach((input, k) => (input.value = place[k].toFixed(2)));
    };
    const submit = () => this.do(
      "POST", "obstacles", {
        name: name.value,
        position: [Number(x.value), Number(y.value)],
        size: [Number(width.value), Number(depth.value)],
        yaw_deg: 0,
        height: Number(height.value),
        material: material.value
      },
      () => {
        name.value = name.value.replace(/\d+$/, (digits) => String(Number(digits) + 1));
      });
    return this.#form(
      "Add a pallet as an obstacle",
      [
        ["name", name], ["x [m]", x], ["y [m]", y], ["width [m]", width], ["depth [m]", depth],
        ["height [m]", height], ["material", material]
      ],
      submit, [
        h("button", {type: "button", text: "Click a position", onclick: pick}),
        h("button", {type: "submit", text: "Put it there"})
      ]);
  }

  #obstacles() {
    this.standing = h("div");
    return this.standing;
  }

  update(changed) {
    if (!changed.has("scene")) return;
    this.standing.replaceChildren(...this.world.scene.obstacles.map(
      ({name}) => h("div", {class: "row"}, h("span", {text: name}), h("button", {
                      type: "button",
                      text: "Remove",
                      "aria-label": `Remove ${name}`,
                      onclick: () => this.do("DELETE", `obstacles/${encodeURIComponent(name)}`)
                    }))));
  }

  // Buttons for the panel of one tag or antenna; errors are shown there.
  actions(kind, name) {
    const error = h("p", {class: "error", role: "alert"});
    const act = async (method, path, body) => {
      setText(error, "");
      try {
        await this.command(
          method, `${kind === "tag" ? "tags" : "antennas"}/${encodeURIComponent(name)}${path}`,
          body);
      } catch (failure) {
        setText(error, failure.message);
      }
    };
    const button = (text, onclick) => h("button", {type: "button", text, onclick});
    if (kind === "antenna") {
      const antenna = this.world.antennas[this.world.antennaIndex.get(name)];
      const plug =
        button("Disconnect", () => act("POST", antenna.faulty ? "/connect" : "/disconnect"));
      const element =
        h("div", {}, h("div", {class: "row"}, plug, button("Remove", () => act("DELETE", ""))),
          error);
      element.refresh = () => setText(plug, antenna.faulty ? "Connect" : "Disconnect");
      return element;
    }
    const loss =
      number("detune", "6", {"aria-label": "Detuning [dB]", min: "0", max: "60", class: "short"});
    const move = async () => {
      const place = await this.pickPlace(`Click where ${name} is to go`);
      if (place)
        await act(
          "POST", "/move",
          {position: place.map((value) => Number(value.toFixed(3)))});
    };
    return h(
      "div", {},
      h("div", {class: "row"}, button("Move", move), button("Remove", () => act("DELETE", "")),
        button("Detune by", () => act("POST", "/detune", {db: Number(loss.value)})), loss,
        h("span", {text: "dB"})),
      error);
  }
}
