// SPDX-License-Identifier: Apache-2.0
// Camera, lights and the render loop: a frame is drawn only when one was requested.

import {
  AmbientLight, Box3, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer
} from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW_DEG = 45;
const FOLLOWED_FROM_M = 8;
const VIEWS = {
  world: [-0.55, -0.9, 0.85],
  top: [0, -1e-4, 1],
  side: [0, -1, 0.12]
};

function light(scene) {
  const sun = new DirectionalLight("#ffffff", 2);
  sun.position.set(-4, -7, 12);
  scene.add(new HemisphereLight("#ffffff", "#b8b4ac", 1.5), new AmbientLight("#ffffff", 0.6), sun);
}

export class Stage {
  // Throws if WebGL is not available.
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer =
      new WebGLRenderer({canvas, antialias: true, powerPreference: "high-performance"});
    this.scene = new Scene();
    this.scene.background = new Color();
    light(this.scene);
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.05, 2000);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-10, -16, 15);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.52 * Math.PI;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => (this.view = ""));
    this.bounds = new Box3(new Vector3(-1, -1, 0), new Vector3(1, 1, 1));
    this.layers = [];  // {frame?(now [s]) → true while it needs further frames}
    this.before = [];  // Called before each frame with the time since the last one [s].
    this.insets = {left: 0, right: 0, top: 0, bottom: 0};
    this.follow = null;
    this.view =
      "";  // The named view until the user moves the camera; it is refitted to a new size.
    this.asked = 0;
    this.frames = 0;
    this.last = 0;
    this.costs = {frame: 0};
    canvas.addEventListener("webglcontextrestored", () => this.invalidate());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.#offset(width, height);
    if (this.view) this.#fit();
    this.invalidate();
  }

  // Panels cover parts of the canvas: the view is centred in the area that they leave free.
  setInsets(insets) {
    this.insets = insets;
    this.resize();
  }

  #offset(width, height) {
    const {left, right, top, bottom} = this.insets;
    const x = (right - left) / 2;
    const y = (bottom - top) / 2;
    this.camera.setViewOffset(width, height, x, y, width, height);
    this.camera.updateProjectionMatrix();
  }

  invalidate() {
    if (!this.asked) this.asked = requestAnimationFrame((now) => this.#draw(now));
  }

  #draw(now) {
    this.asked = 0;
    const elapsed = Math.min((now - this.last) / 1000, 0.25);
    this.last = now;
    const start = performance.now();
    for (const step of this.before) step(elapsed);
    let goesOn = false;
    for (const layer of this.layers) goesOn = layer.frame?.(now / 1000) || goesOn;
    if (this.follow) this.#followOn();
    this.renderer.render(this.scene, this.camera);
    ++this.frames;
    this.costs.frame = performance.now() - start;
    if (goesOn) this.invalidate();
  }

  #followOn() {
    const place = this.follow();
    if (!place) return;
    const step = place.clone().sub(this.controls.target);
    if (step.lengthSq() < 1e-10) return;
    this.controls.target.add(step);
    this.camera.position.add(step);
    this.camera.lookAt(this.controls.target);
  }

  look(name) {
    this.follow = null;
    this.view = name;
    this.resize();
  }

  // Moves the camera so that the bounds fill the area that the panels leave free, centred in it.
  #fit() {
    const size = this.bounds.getSize(new Vector3()).length();
    const target = this.bounds.getCenter(new Vector3());
    const back = new Vector3(...VIEWS[this.view]).normalize();
    const right = new Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    const half = Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360);
    const tanY = half * Math.max(1 - (this.insets.top + this.insets.bottom) / height, 0.3);
    const tanX =
      half * this.camera.aspect * Math.max(1 - (this.insets.left + this.insets.right) / width, 0.3);
    let distance = size;
    for (let i = 0; i < 6; ++i) {
      const [x0, x1, y0, y1] = this.#seen(target, back, right, up, distance);
      target.addScaledVector(right, ((x0 + x1) / 2) * distance)
        .addScaledVector(up, ((y0 + y1) / 2) * distance);
      distance *= 1.03 * Math.max((x1 - x0) / (2 * tanX), (y1 - y0) / (2 * tanY));
    }
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(back, distance);
    this.camera.near = Math.max(0.02, size / 600);
    this.camera.far = 60 * size + 100;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  // Tangents of the angles at which the bounds are seen from the camera: left, right, bottom,
  // top.
  #seen(target, back, right, up, distance) {
    const all = [Infinity, -Infinity, Infinity, -Infinity];
    const p = new Vector3();
    for (let corner = 0; corner < 8; ++corner) {
      const {min, max} = this.bounds;
      p.set(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z)
        .sub(target);
      const depth = Math.max(distance - p.dot(back), 0.1 * distance);
      const [x, y] = [p.dot(right) / depth, p.dot(up) / depth];
      all[0] = Math.min(all[0], x);
      all[1] = Math.max(all[1], x);
      all[2] = Math.min(all[2], y);
      all[3] = Math.max(all[3], y);
    }
    return all;
  }

  follows(place) {
    this.follow = place;
    this.view = "";
    const at = place();
    if (!at) return;
    this.controls.target.copy(at);
    const back = this.camera.position.clone().sub(at).setZ(0).normalize().setZ(1.1).normalize();
    this.camera.position.copy(at).addScaledVector(back, FOLLOWED_FROM_M);
    this.controls.update();
    this.invalidate();
  }

  // From the keyboard: change of azimuth and of the polar angle from the vertical [rad], and a
  // factor on the distance.
  orbit(azimuth, polar, zoom) {
    this.view = "";
    const {camera, controls} = this;
    const back = camera.position.clone().sub(controls.target);
    const length = back.length() * zoom;
    const theta = Math.atan2(back.y, back.x) + azimuth;
    const phi = Math.min(Math.max(Math.acos(back.z / back.length()) + polar, 0.01), 0.52 * Math.PI);
    camera.position.copy(controls.target)
      .add(new Vector3(
        length * Math.sin(phi) * Math.cos(theta), length * Math.sin(phi) * Math.sin(theta),
        length * Math.cos(phi)));
    controls.update();
    this.invalidate();
  }

  // Canvas pixel [CSS px] of a point in frame W, or null if it is behind the camera.
  project(x, y, z) {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    this.camera.updateMatrixWorld();
    const p = new Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse);
    if (p.z > -this.camera.near) return null;
    p.applyMatrix4(this.camera.projectionMatrix);
    return [(0.5 + 0.5 * p.x) * width, (0.5 - 0.5 * p.y) * height];
  }

  setBackground(color) {
    this.scene.background.set(color);
    this.invalidate();
  }
}
