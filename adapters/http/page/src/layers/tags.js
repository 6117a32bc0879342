// SPDX-License-Identifier: Apache-2.0
// Tags as discs that always face the camera, all in three draw calls (occluded tags, visible ones,
// recently read ones): a disc with the colour and opacity of the RSSI if read recently, a ring if
// read before, grey if never read.

import {
  Color, GreaterDepth, InstancedBufferAttribute, InstancedBufferGeometry, LessEqualDepth, Mesh,
  PlaneGeometry, ShaderMaterial, Vector2
} from "three";

import {rssiColor} from "../colors.js";

const RADIUS_M = 0.07;
const LEAST_RADIUS_PX = 4.5;
const EVER =
  1;  // Kinds in the shader: 0 never read, 1 read before, 2 recently read; +4 if selected.
const LATELY = 2;
const SELECTED = 4;

const VERTEX = `
uniform vec2 uViewport;
uniform float uRadius, uLeastPx, uFrom, uTo;
attribute vec3 aPlace;
attribute vec4 aColor;
attribute float aKind;
varying vec2 vAt;
varying vec4 vColor;
varying float vKind;
varying float vPx;
void main() {
  vec4 at = viewMatrix * vec4(aPlace, 1.0);
  float pxPerM = 0.5 * uViewport.y * projectionMatrix[1][1] / max(-at.z, 1e-3);
  float px = max(uRadius * pxPerM, uLeastPx) * (aKind >= 4.0 ? 2.0 : aKind >= 2.0 ? 1.3 : 1.0);
  vAt = position.xy * 2.0;
  vColor = aColor;
  vKind = aKind;
  vPx = px;
  gl_Position = aKind < uFrom || aKind > uTo ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * at;
  gl_Position.xy += position.xy * 4.0 * px / uViewport * gl_Position.w;
  // A little nearer than the face that it sticks to.
  vec4 nearer = projectionMatrix * (at + vec4(0.0, 0.0, 0.04, 0.0));
  gl_Position.z = nearer.z / nearer.w * gl_Position.w;
}`;

const FRAGMENT = `
uniform float uOpacity;
uniform vec3 uInk;
varying vec2 vAt;
varying vec4 vColor;
varying float vKind;
varying float vPx;
void main() {
  float r = length(vAt);
  float soft = 1.5 / vPx;
  bool selected = vKind >= 4.0;
  float kind = selected ? vKind - 4.0 : vKind;
  float outer = selected ? 0.62 : 1.0;
  float inside = 1.0 - smoothstep(outer - soft, outer, r);
  float rim = smoothstep(outer * 0.72 - soft, outer * 0.72, r);
  vec4 color = vColor;
  if (kind < 0.5) color.a *= mix(0.55, 1.0, rim);
  else if (kind < 1.5) color.a *= mix(0.12, 1.0, rim);
  else { color.a = mix(color.a, 1.0, rim); color.rgb *= mix(1.0, 0.78, rim); }
  color.a *= inside;
  float ring = smoothstep(0.78 - soft, 0.78, r) * (1.0 - smoothstep(1.0 - soft, 1.0, r));
  if (!selected) ring = 0.0;
  color = mix(color, vec4(uInk, 1.0), ring);
  color.a *= uOpacity;
  if (color.a < 0.01) discard;
  gl_FragColor = color;
}`;

export class Tags {
  constructor(stage, world, scale) {
    this.stage = stage;
    this.world = world;
    this.scale = scale;
    this.grey = [0.55, 0.55, 0.55, 1];
    this.capacity = -1;
    const uniforms = {
      uViewport: {value: new Vector2()},
      uRadius: {value: RADIUS_M},
      uLeastPx: {value: LEAST_RADIUS_PX},
      uInk: {value: new Color()}
    };
    this.uniforms = uniforms;
    // Occluded tags first, then visible ones, recently read ones on top.
    this.meshes = [
      [GreaterDepth, 0.45, 0, 9], [LessEqualDepth, 1, 0, 1], [LessEqualDepth, 1, LATELY, 9]
    ].map(([depthFunc, opacity, from, to], i) => {
      const material = new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        transparent: true,
        depthWrite: false,
        depthFunc,
        uniforms: {...uniforms, uOpacity: {value: opacity}, uFrom: {value: from}, uTo: {value: to}}
      });
      const mesh = new Mesh(undefined, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = 18 + i;
      stage.scene.add(mesh);
      return mesh;
    });
  }

  setTheme({unread, ink}) {
    const color = new Color().setStyle(unread, "");
    this.grey = [color.r, color.g, color.b, 1];
    this.uniforms.uInk.value.setStyle(ink, "");
  }

  setVisible(visible) {
    for (const mesh of this.meshes) mesh.visible = visible;
  }

  #allot(n) {
    if (n <= this.capacity) return;
    this.capacity = Math.max(64, 2 * n);
    const plane = new PlaneGeometry(1, 1);
    const geometry = new InstancedBufferGeometry();
    geometry.index = plane.index;
    geometry.setAttribute("position", plane.getAttribute("position"));
    this.place = new InstancedBufferAttribute(new Float32Array(3 * this.capacity), 3);
    this.color = new InstancedBufferAttribute(new Float32Array(4 * this.capacity), 4);
    this.kind = new InstancedBufferAttribute(new Float32Array(this.capacity), 1);
    geometry.setAttribute("aPlace", this.place).setAttribute("aColor", this.color);
    geometry.setAttribute("aKind", this.kind);
    this.meshes[0].geometry.dispose();
    for (const mesh of this.meshes) mesh.geometry = geometry;
  }

  update(changed) {
    if (
      !changed.has("tags") && !changed.has("reads") && !changed.has("selection") &&
      !changed.has("theme"))
      return;
    const n = this.world.tags.length;
    this.#allot(n);
    this.meshes[0].geometry.instanceCount = n;
    if (changed.has("tags")) {
      this.place.array.set(this.world.position.subarray(0, 3 * n));
      this.place.needsUpdate = true;
    }
    this.#colors(n);
  }

  #colors(n) {
    const {world, scale, color, kind} = this;
    const selected = world.selection?.kind === "tag" ? world.selection.index : -1;
    for (let i = 0; i < n; ++i) {
      const strength = world.strength[i];
      const last = world.lastRssi[i];
      const state = strength === strength ? LATELY : last === last ? EVER : 0;
      if (state)
        rssiColor(scale.share(state === LATELY ? strength : last), color.array, 4 * i);
      else
        color.array.set(this.grey, 4 * i);
      if (state === EVER) color.array[4 * i + 3] = 0.8;
      kind.array[i] = world.tags[i].present ? state + (i === selected ? SELECTED : 0) : -1;
    }
    color.needsUpdate = kind.needsUpdate = true;
  }

  frame() {
    const {renderer} = this.stage;
    renderer.getDrawingBufferSize(this.uniforms.uViewport.value);
    const crowded =
      Math.min(Math.max((1000 / Math.max(this.world.tags.length, 1)) ** 0.3, 0.45), 1);
    this.uniforms.uLeastPx.value = LEAST_RADIUS_PX * crowded * renderer.getPixelRatio();
    return false;
  }
}
