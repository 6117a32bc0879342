// SPDX-License-Identifier: Apache-2.0
// The 3D view of the world: all layers on one stage.

import {Box3, Vector3} from "three";

import {Antennas} from "./layers/antennas.js";
import {Coverage} from "./layers/coverage.js";
import {Estimates} from "./layers/estimates.js";
import {Flashes} from "./layers/flashes.js";
import {Ground} from "./layers/ground.js";
import {Link} from "./layers/link.js";
import {PlanLayer} from "./layers/plan.js";
import {Robots} from "./layers/robots.js";
import {Solids} from "./layers/solids.js";
import {Tags} from "./layers/tags.js";
import {Picking} from "./picking.js";
import {Stage} from "./stage.js";

export class Drawing {
  // Throws if WebGL is not available.
  constructor(canvas, world, scale) {
    this.world = world;
    this.stage = new Stage(canvas);
    this.solids = new Solids(this.stage, world);
    this.ground = new Ground(this.stage);
    this.tags = new Tags(this.stage, world, scale);
    this.antennas = new Antennas(this.stage, world);
    this.flashes = new Flashes(this.stage, world);
    this.robots = new Robots(this.stage, world);
    this.estimates = new Estimates(this.stage, world);
    this.link = new Link(this.stage);
    this.coverage = new Coverage(this.stage);
    this.plan = new PlanLayer(this.stage);
    this.picking = new Picking(this.stage, world, this.solids);
    this.stage.layers.push(this.solids, this.tags, this.flashes);
    this.filled = new Box3();  // Bounds of what is in the world, without the floor around it.
    this.fitted = "";
  }

  setTheme(colors) {
    this.stage.setBackground(colors.background);
    for (const layer of [this.solids, this.ground, this.tags, this.estimates, this.link, this.plan])
      layer.setTheme(colors);
    this.world.touch("theme");
  }

  update(changed) {
    if (changed.has("scene")) this.#scene();
    if (changed.has("time")) this.solids.place();
    for (const layer of [this.tags, this.antennas, this.robots, this.estimates])
      layer.update(changed);
  }

  // Shows a layout of a plan instead of the tags or together with them; null shows the tags alone.
  showPlan(plan, layout, withTags) {
    this.plan.show(plan, layout);
    for (const layer of [this.tags, this.flashes]) layer.setVisible(layout === null || withTags);
    this.stage.invalidate();
  }

  // Clears the cells of a coverage that are outside the bounds of the world.
  clip({x0, y0, cell, columns, margin_db: margins}) {
    const {min, max} = this.filled;
    for (let i = 0; i < margins.length; ++i) {
      const x = x0 + ((i % columns) + 0.5) * cell;
      const y = y0 + (Math.floor(i / columns) + 0.5) * cell;
      if (x < min.x || x > max.x || y < min.y || y > max.y) margins[i] = null;
    }
  }

  // Fits the view to a world when it is first shown, not when an obstacle is added later.
  #scene() {
    const {world, stage} = this;
    if (!world.scene.name && !world.tags.length) return;
    const bounds = this.solids.set(world.scene) ?? new Box3();
    const p = new Vector3();
    for (let i = 0; i < world.tags.length; ++i)
      bounds.expandByPoint(p.fromArray(world.position, 3 * i));
    for (const {pose} of world.antennas)
      if (pose) bounds.expandByPoint(p.fromArray(pose));
    for (const {points} of world.scene.paths) {
      for (const [x, y, z] of points) bounds.expandByPoint(p.set(x, y, z ?? 0));
    }
    if (bounds.isEmpty()) bounds.set(new Vector3(-2, -2, 0), new Vector3(2, 2, 2));
    bounds.expandByPoint(p.set(bounds.min.x, bounds.min.y, 0));
    this.filled.copy(bounds);
    stage.bounds.copy(this.ground.set(world.scene, bounds));
    if (this.fitted !== world.scene.name) {
      this.fitted = world.scene.name;
      stage.look("world");
    }
    stage.invalidate();
  }
}
