// Floor, metre grid, map and the robots' paths.

import {BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, LineSegments, Mesh,
        MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace, TextureLoader} from "three";

const LEAST_MARGIN = 1;  // Floor beyond what stands on it [m].

function gridLines(bounds, step, skip, height) {
  const points = [];
  const x0 = Math.floor(bounds.min.x - LEAST_MARGIN);
  const x1 = Math.ceil(bounds.max.x + LEAST_MARGIN);
  const y0 = Math.floor(bounds.min.y - LEAST_MARGIN);
  const y1 = Math.ceil(bounds.max.y + LEAST_MARGIN);
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) {
    if (!skip || x % skip) points.push(x, y0, height, x, y1, height);
  }
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) {
    if (!skip || y % skip) points.push(x0, y, height, x1, y, height);
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
}

export class Ground {
  constructor(stage) {
    this.stage = stage;
    this.group = new Group();
    stage.scene.add(this.group);
    this.theme = {floor: "#ffffff", grid: "#888888", path: "#2277cc"};
  }

  setTheme(theme) {
    this.theme = theme;
    if (this.scene) this.set(this.scene, this.bounds);
  }

  set(scene, bounds) {
    this.scene = scene;
    this.bounds = bounds;
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.map?.dispose();
      object.material?.dispose();
    });
    this.group.clear();
    const width = Math.max(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    const step = width > 400 ? 50 : width > 80 ? 10 : 1;
    const floor = new Mesh(
      new PlaneGeometry(Math.ceil(bounds.max.x + LEAST_MARGIN) - Math.floor(bounds.min.x - LEAST_MARGIN),
                        Math.ceil(bounds.max.y + LEAST_MARGIN) - Math.floor(bounds.min.y - LEAST_MARGIN)),
      new MeshBasicMaterial({color: this.theme.floor, polygonOffset: true, polygonOffsetFactor: 4,
                             polygonOffsetUnits: 4}));
    floor.position.set(
      (Math.ceil(bounds.max.x + LEAST_MARGIN) + Math.floor(bounds.min.x - LEAST_MARGIN)) / 2,
      (Math.ceil(bounds.max.y + LEAST_MARGIN) + Math.floor(bounds.min.y - LEAST_MARGIN)) / 2, 0);
    this.group.add(floor, this.#grid(gridLines(bounds, step, 5 * step, 0.003), 0.35),
                   this.#grid(gridLines(bounds, 5 * step, 0, 0.004), 0.9));
    if (scene.map) this.#map(scene.map);
    for (const path of scene.paths) this.#path(path.points);
  }

  #grid(geometry, opacity) {
    return new LineSegments(geometry, new LineBasicMaterial({
      color: new Color(this.theme.grid), transparent: true, opacity}));
  }

  #map({resolution, origin, width, height, png}) {
    if (!png?.startsWith("data:image/")) return;
    new TextureLoader().load(png, (texture) => {
      texture.magFilter = NearestFilter;
      texture.colorSpace = SRGBColorSpace;
      const [w, h] = [width * resolution, height * resolution];
      const plane = new Mesh(new PlaneGeometry(w, h), new MeshBasicMaterial({
        map: texture, transparent: true, opacity: 0.55, depthWrite: false}));
      plane.position.set(origin[0] + w / 2, origin[1] + h / 2, 0.006);
      this.group.add(plane);
      this.stage.invalidate();
    });
  }

  #path(points) {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(
      new Float32Array(points.flatMap(([x, y, z]) => [x, y, (z ?? 0) + 0.02])), 3));
    this.group.add(new Line(geometry, new LineBasicMaterial({color: this.theme.path})));
  }
}
