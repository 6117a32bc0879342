// SPDX-License-Identifier: Apache-2.0
// Reads as fading lines between antenna and tag; the shader does the fading.

import {
  BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, LineSegments, ShaderMaterial
} from "three";

import {antennaColor} from "../colors.js";

const LINES = 2000;
const A_FRAME = 120;  // Maximum of new lines per frame; of more reads, an even selection.
const FADE_S = 0.45;

const VERTEX = `
uniform float uNow;
attribute vec3 aColor;
attribute float aBorn;
varying vec4 vColor;
void main() {
  float age = (uNow - aBorn) / ${FADE_S.toFixed(2)};
  vColor = vec4(aColor, 0.75 * clamp(1.0 - age, 0.0, 1.0));
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  if (age > 1.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;
const FRAGMENT = `
varying vec4 vColor;
void main() { gl_FragColor = vColor; }`;

export class Flashes {
  constructor(stage, world) {
    this.stage = stage;
    this.world = world;
    this.next = 0;
    this.until = 0;
    this.shown = true;
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    const make = (size) =>
      new BufferAttribute(new Float32Array(2 * LINES * size), size).setUsage(DynamicDrawUsage);
    this.place = make(3);
    this.color = make(3);
    this.born = make(1);
    this.born.array.fill(-1e9);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.place).setAttribute("aColor", this.color);
    geometry.setAttribute("aBorn", this.born);
    this.uniforms = {uNow: {value: 0}};
    this.lines = new LineSegments(geometry, new ShaderMaterial({
                                    vertexShader: VERTEX,
                                    fragmentShader: FRAGMENT,
                                    uniforms: this.uniforms,
                                    transparent: true,
                                    depthWrite: false
                                  }));
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 15;
    this.rgb = [];
    stage.scene.add(this.lines);
  }

  setVisible(visible) {
    this.shown = visible;
  }

  #color(k) {
    this.rgb[k] ??= new Color().setStyle(antennaColor(k), "").toArray();
    return this.rgb[k];
  }

  frame(now) {
    const {newReads} = this.world;
    if (newReads.length && !this.still.matches) {
      const n = newReads.length / 2;
      const step = Math.max(1, n / A_FRAME);
      for (let i = 0; i < n; i += step)
        this.#add(newReads[2 * Math.floor(i)], newReads[2 * Math.floor(i) + 1], now);
      for (const attribute of [this.place, this.color, this.born]) attribute.needsUpdate = true;
      this.until = now + FADE_S;
    }
    newReads.length = 0;
    this.uniforms.uNow.value = now;
    this.lines.visible = this.shown && now < this.until;
    return this.lines.visible;
  }

  #add(tag, antenna, now) {
    const {pose} = this.world.antennas[antenna];
    const {selection} = this.world;
    if (selection && selection.index !== (selection.kind === "tag" ? tag : antenna)) return;
    const at = 2 * this.next;
    const p = this.world.position;
    const rgb = this.#color(antenna);
    for (let k = 0; k < 3; ++k) {
      this.place.array[3 * at + k] = pose[k];
      this.place.array[3 * at + 3 + k] = p[3 * tag + k];
      this.color.array[3 * at + k] = this.color.array[3 * at + 3 + k] = rgb[k];
    }
    this.born.array[at] = this.born.array[at + 1] = now;
    this.next = (this.next + 1) % LINES;
  }
}
