// SPDX-License-Identifier: Apache-2.0
// Estimated tag positions: a cross, the 95 % error ellipse, and a line to the true position.

import {BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments} from "three";

const CHI_95 = Math.sqrt(5.991);  // χ² with two degrees of freedom.
const SEGMENTS = 40;
const CROSS_M = 0.06;

// Semi-axes [m] and heading [rad] of the 95 % ellipse of the covariance [cxx, cxy, cyy] [m²].
export function ellipse([cxx, cxy, cyy]) {
  const mean = (cxx + cyy) / 2;
  const root = Math.hypot((cxx - cyy) / 2, cxy);
  return {
    a: CHI_95 * Math.sqrt(Math.max(mean + root, 0)),
    b: CHI_95 * Math.sqrt(Math.max(mean - root, 0)),
    heading: 0.5 * Math.atan2(2 * cxy, cxx - cyy)
  };
}

function pushEllipse(points, [x, y, z], covariance) {
  const {a, b, heading} = ellipse(covariance);
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  const at = (i) => {
    const angle = (2 * Math.PI * i) / SEGMENTS;
    const [u, v] = [a * Math.cos(angle), b * Math.sin(angle)];
    points.push(x + c * u - s * v, y + s * u + c * v, z);
  };
  for (let i = 0; i < SEGMENTS; ++i) {
    at(i);
    at(i + 1);
  }
}

export class Estimates {
  constructor(stage, world) {
    this.world = world;
    this.lines = new LineSegments(
      new BufferGeometry(), new LineBasicMaterial({depthTest: false, transparent: true}));
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 25;
    stage.scene.add(this.lines);
  }

  setTheme({estimate}) {
    this.lines.material.color.set(estimate);
  }

  update(changed) {
    if (!changed.has("estimates") && !(changed.has("tags") && this.world.estimates.size)) return;
    const points = [];
    for (const [tag, {position, covariance}] of this.world.estimates) {
      if (!this.world.tags[tag].present) continue;
      const [x, y, z] = position;
      points.push(
        x - CROSS_M, y, z, x + CROSS_M, y, z, x, y - CROSS_M, z, x, y + CROSS_M, z, x, y,
        z - CROSS_M, x, y, z + CROSS_M);
      if (covariance) pushEllipse(points, position, covariance);
      points.push(x, y, z, ...this.world.position.subarray(3 * tag, 3 * tag + 3));
    }
    this.lines.geometry.dispose();
    this.lines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  }
}
