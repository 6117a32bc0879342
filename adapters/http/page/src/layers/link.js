// SPDX-License-Identifier: Apache-2.0
// The propagation paths of one link, from `explain`: direct, reflected and diffracted.

import {
  BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, LineDashedMaterial
} from "three";

const MOST = 12;
const FAINTEST_DB = -40;  // A path this far below the direct path is drawn faintest.

function lengthOf(points) {
  let length = 0;
  for (let i = 1; i < points.length; ++i) {
    length += Math.hypot(...points[i].map((value, k) => value - points[i - 1][k]));
  }
  return length;
}

// Points of a path [m, frame W]. The diffracting edge is inserted where it makes the path
// shortest.
export function pathPoints(explanation, path) {
  const points = [
    explanation.antenna_pose.position_m, ...path.by_way_of.map((at) => at.position_m),
    explanation.tag_pose.position_m
  ];
  if (!path.around) return points;
  const ways = points.slice(1).map((_, i) => points.toSpliced(i + 1, 0, path.around.position_m));
  return ways.reduce((best, way) => (lengthOf(way) < lengthOf(best) ? way : best));
}

export class Link {
  constructor(stage) {
    this.stage = stage;
    this.group = new Group();
    stage.scene.add(this.group);
    this.theme = {ink: "#000000", blocked: "#d6336c"};
  }

  setTheme(theme) {
    this.theme = theme;
    if (this.shown) this.show(this.shown);
  }

  show(explanation) {
    this.shown = explanation;
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.dispose();
    });
    this.group.clear();
    const paths =
      explanation?.paths ?? (explanation ? [{bounces: 0, by_way_of: [], relative_db: 0}] : []);
    const shown = paths.filter((path) => !path.blocked || path.bounces === 0);
    const sorted = shown.sort((a, b) => (b.relative_db ?? -999) - (a.relative_db ?? -999));
    for (const path of sorted.slice(0, MOST)) this.#add(pathPoints(explanation, path), path);
    this.stage.invalidate();
  }

  #add(points, path) {
    const geometry = new BufferGeometry().setAttribute(
      "position", new BufferAttribute(new Float32Array(points.flat()), 3));
    const strength = 1 - Math.min(Math.max((path.relative_db ?? FAINTEST_DB) / FAINTEST_DB, 0), 1);
    const look = {transparent: true, depthTest: false};
    const material = path.blocked ?
      new LineDashedMaterial(
        {...look, color: this.theme.blocked, dashSize: 0.25, gapSize: 0.2, opacity: 0.5}) :
      new LineBasicMaterial(
        {...look, color: new Color(this.theme.ink), opacity: 0.08 + 0.92 * strength * strength});
    const line = new Line(geometry, material);
    line.computeLineDistances();
    line.renderOrder = 17;
    this.group.add(line);
  }
}
