// SPDX-License-Identifier: Apache-2.0
// Coverage of an antenna: where it would read a tag, as a coloured layer at one height.

import {
  DataTexture, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace
} from "three";

import {marginColor} from "../colors.js";

export class Coverage {
  constructor(stage) {
    this.stage = stage;
    this.mesh = null;
  }

  show(coverage, height) {
    if (this.mesh) {
      this.stage.scene.remove(this.mesh);
      this.mesh.material.map.dispose();
      this.mesh.material.dispose();
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (coverage) this.#draw(coverage, height);
    this.stage.invalidate();
  }

  #draw({x0, y0, cell, columns, rows, margin_db: margins}, height) {
    const bytes = new Uint8Array(4 * columns * rows);
    margins.forEach((margin, i) => {
      if (margin !== null) bytes.set(marginColor(margin), 4 * i);
    });
    const texture = new DataTexture(bytes, columns, rows);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.needsUpdate = true;
    this.mesh = new Mesh(
      new PlaneGeometry(columns * cell, rows * cell),
      new MeshBasicMaterial({map: texture, transparent: true, depthWrite: false}));
    this.mesh.position.set(x0 + (columns * cell) / 2, y0 + (rows * cell) / 2, height + 0.01);
    this.mesh.renderOrder = 5;
    this.stage.scene.add(this.mesh);
  }
}
