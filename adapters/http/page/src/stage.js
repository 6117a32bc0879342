// Camera, light and the loop: a frame is drawn only when something asked for one.

import {AmbientLight, Box3, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Vector3,
        WebGLRenderer} from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW_DEG = 45;
const VIEWS = {world: [-0.55, -0.9, 0.85], top: [0, -1e-4, 1], side: [0, -1, 0.12]};

function light(scene) {
  const sun = new DirectionalLight("#ffffff", 1.7);
  sun.position.set(-4, -7, 12);
  scene.add(new HemisphereLight("#ffffff", "#8f8a80", 1.5), new AmbientLight("#ffffff", 0.35), sun);
}

export class Stage {
  // Throws where there is no WebGL.
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, powerPreference: "high-performance"});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
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
    this.bounds = new Box3(new Vector3(-1, -1, 0), new Vector3(1, 1, 1));
    this.layers = [];  // {update(changed), frame?(now) → true while it goes on}
    this.before = [];  // Called before each frame with the time since the last one [s].
    this.insets = {left: 0, right: 0, top: 0, bottom: 0};
    this.follow = null;
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
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.#offset(width, height);
    this.invalidate();
  }

  // Panels lie over the canvas: what is looked at stands in the middle of what they leave free.
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
    const center = this.bounds.getCenter(new Vector3());
    const direction = new Vector3(...(VIEWS[name] ?? VIEWS.world)).normalize();
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(direction, this.#distance(direction));
    this.camera.near = Math.max(0.02, this.bounds.getSize(new Vector3()).length() / 2000);
    this.camera.far = 60 * this.bounds.getSize(new Vector3()).length() + 100;
    this.resize();
    this.controls.update();
    this.invalidate();
  }

  // From where all corners of the bounds are in what the panels leave free.
  #distance(direction) {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    const {left, right, top, bottom} = this.insets;
    const up = Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360);
    const tanY = up * Math.max(1 - (top + bottom) / height, 0.3);
    const tanX = up * this.camera.aspect * Math.max(1 - (left + right) / width, 0.3);
    const right_W = new Vector3().crossVectors(direction, new Vector3(0, 0, 1)).normalize();
    const up_W = new Vector3().crossVectors(right_W, direction).normalize();
    const center = this.bounds.getCenter(new Vector3());
    let distance = 1;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new Vector3(corner & 1 ? this.bounds.max.x : this.bounds.min.x,
                            corner & 2 ? this.bounds.max.y : this.bounds.min.y,
                            corner & 4 ? this.bounds.max.z : this.bounds.min.z).sub(center);
      const ahead = p.dot(direction);
      distance = Math.max(distance, ahead + Math.abs(p.dot(right_W)) / tanX,
                          ahead + Math.abs(p.dot(up_W)) / tanY);
    }
    return 1.04 * distance;
  }

  follows(place) {
    this.follow = place;
    const at = place();
    if (!at) return;
    this.controls.target.copy(at);
    const back = this.camera.position.clone().sub(at);
    this.camera.position.copy(at).addScaledVector(back.normalize(), 6);
    this.controls.update();
    this.invalidate();
  }

  // By keyboard: radians about the vertical and towards the top, factor of the distance.
  orbit(azimuth, polar, zoom) {
    const {camera, controls} = this;
    const back = camera.position.clone().sub(controls.target);
    const length = back.length() * zoom;
    const theta = Math.atan2(back.y, back.x) + azimuth;
    const phi = Math.min(Math.max(Math.acos(back.z / back.length()) + polar, 0.01), 0.52 * Math.PI);
    camera.position.copy(controls.target).add(new Vector3(
      length * Math.sin(phi) * Math.cos(theta), length * Math.sin(phi) * Math.sin(theta),
      length * Math.cos(phi)));
    controls.update();
    this.invalidate();
  }

  // Pixel of the canvas [CSS px] of a point of frame W, or null behind the camera.
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
