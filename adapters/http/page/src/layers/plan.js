// SPDX-License-Identifier: Apache-2.0
// An antenna plan: cubes at the possible tag positions, coloured by the share of tags there that
// are read (or meet the plan's other goal), and frames at the planned antennas with a line along
// boresight.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, InstancedMesh, LineBasicMaterial,
  LineSegments, Matrix4, MeshBasicMaterial, Vector3
} from "three";

import {bandColor, bandOf} from "../colors.js";

const CUBE_M = 0.14;
const PLATE_M = 0.16;  // Half the side of a frame.
const LOOK_M = 0.9;

// A square perpendicular to boresight, and a line along it.
function pushAntenna(points, {position, boresight}) {
  const at = new Vector3(...position);
  const along = new Vector3(...boresight).normalize();
  const up = Math.abs(along.z) > 0.95 ? new Vector3(1, 0, 0) : new Vector3(0, 0, 1);
  const right = new Vector3().crossVectors(along, up).normalize().multiplyScalar(PLATE_M);
  const top = new Vector3().crossVectors(right, along).normalize().multiplyScalar(PLATE_M);
  const corner = (i, j) => at.clone().addScaledVector(right, i).addScaledVector(top, j);
  const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  const line = (from, to) => points.push(...from.toArray(), ...to.toArray());
  corners.forEach((one, i) => line(one, corners[(i + 1) % 4]));
  line(at, at.clone().addScaledVector(along, LOOK_M));
}

export class PlanLayer {
  constructor(stage) {
    this.stage = stage;
    this.lines = new LineSegments(
      new BufferGeometry(), new LineBasicMaterial({depthTest: false, transparent: true}));
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 24;
    this.lines.visible = false;
    stage.scene.add(this.lines);
  }

  setTheme({ink}) {
    this.lines.material.color.set(ink);
  }

  // Shows the layout with this index; null hides the plan.
  show(plan, layout) {
    this.cubes ??= this.#cubesOf(plan);
    const visible = layout !== null;
    this.cubes.visible = this.lines.visible = visible;
    if (visible) {
      const colors = plan.colors.map((one) => new Color(bandColor(one)));
      plan.percent[layout].forEach(
        (percent, i) => this.cubes.setColorAt(i, colors[bandOf(plan.edges, percent / 100)]));
      if (this.cubes.instanceColor) this.cubes.instanceColor.needsUpdate = true;
      const points = [];
      for (const antenna of plan.layouts[layout].antennas) pushAntenna(points, antenna);
      this.lines.geometry.dispose();
      this.lines.geometry = new BufferGeometry().setAttribute(
        "position", new BufferAttribute(new Float32Array(points), 3));
    }
    this.stage.invalidate();
  }

  #cubesOf({positions}) {
    const cubes = new InstancedMesh(
      new BoxGeometry(CUBE_M, CUBE_M, CUBE_M),
      new MeshBasicMaterial({transparent: true, opacity: 0.95}), positions.length);
    cubes.frustumCulled = false;
    positions.forEach((p, i) => cubes.setMatrixAt(i, new Matrix4().makeTranslation(...p)));
    this.stage.scene.add(cubes);
    return cubes;
  }
}
