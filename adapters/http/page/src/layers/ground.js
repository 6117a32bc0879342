// SPDX-License-Identifier: Apache-2.0
// Floor, metre grid, map and the robots' paths.

import {
  Box3, BufferAttribute, BufferGeometry, Color, DataTexture, Group, Line, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace, Vector3
} from "three";

// RGBA of free, occupied and unknown cells.
const MAP_COLORS = [[255, 255, 255, 0], [30, 41, 59, 220], [100, 116, 139, 70]];

// Lines every `step` metres, except at multiples of `skip`.
function gridLines({min, max}, step, skip, height) {
  const points = [];
  for (let x = Math.ceil(min.x / step) * step; x <= max.x; x += step) {
    if (!skip || x % skip) points.push(x, min.y, height, x, max.y, height);
  }
  for (let y = Math.ceil(min.y / step) * step; y <= max.y; y += step) {
    if (!skip || y % skip) points.push(min.x, y, height, max.x, y, height);
  }
  return new BufferGeometry().setAttribute(
    "position", new BufferAttribute(new Float32Array(points), 3));
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

  // Draws everything; returns the extent of the floor: one to two metres beyond the bounds.
  set(scene, bounds) {
    this.scene = scene;
    this.bounds = bounds;
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.map?.dispose();
      object.material?.dispose();
    });
    this.group.clear();
    const wide = new Box3(
      new Vector3(Math.floor(bounds.min.x) - 1, Math.floor(bounds.min.y) - 1, bounds.min.z),
      new Vector3(Math.ceil(bounds.max.x) + 1, Math.ceil(bounds.max.y) + 1, bounds.max.z));
    const size = wide.getSize(new Vector3());
    const longest = Math.max(size.x, size.y);
    const step = longest > 400 ? 50 : longest > 80 ? 10 : 1;
    const floor = new Mesh(new PlaneGeometry(size.x, size.y), new MeshBasicMaterial({
                             color: this.theme.floor,
                             polygonOffset: true,
                             polygonOffsetFactor: 4,
                             polygonOffsetUnits: 4
                           }));
    floor.position.set((wide.min.x + wide.max.x) / 2, (wide.min.y + wide.max.y) / 2, 0);
    this.group.add(
      floor, this.#grid(gridLines(wide, step, 5 * step, 0.003), 0.35),
      this.#grid(gridLines(wide, 5 * step, 0, 0.004), 0.9));
    if (scene.map) this.#map(scene.map);
    for (const path of scene.paths) this.#path(path.points);
    return wide;
  }

  #grid(geometry, opacity) {
    return new LineSegments(
      geometry,
      new LineBasicMaterial({color: new Color(this.theme.grid), transparent: true, opacity}));
  }

  // Free cells are transparent, occupied ones dark, unknown ones hazy.
  #map({resolution, origin, width, height, runs}) {
    const cells = new Uint8Array(4 * width * height);
    let at = 0;
    for (let i = 0; i + 1 < runs.length; i += 2) {
      const color = MAP_COLORS[runs[i + 1]];
      for (let k = 0; k < runs[i] && at < cells.length; ++k, at += 4) cells.set(color, at);
    }
    const texture = new DataTexture(cells, width, height);
    texture.magFilter = NearestFilter;
    texture.colorSpace = SRGBColorSpace;
    texture.needsUpdate = true;
    const [w, h] = [width * resolution, height * resolution];
    const plane = new Mesh(
      new PlaneGeometry(w, h),
      new MeshBasicMaterial({map: texture, transparent: true, depthWrite: false}));
    plane.position.set(origin[0] + w / 2, origin[1] + h / 2, 0.006);
    this.group.add(plane);
  }

  #path(points) {
    const geometry = new BufferGeometry().setAttribute(
      "position",
      new BufferAttribute(
        new Float32Array(points.flatMap(([x, y, z]) => [x, y, (z ?? 0) + 0.02])), 3));
    this.group.add(new Line(geometry, new LineBasicMaterial({color: this.theme.path})));
  }
}
