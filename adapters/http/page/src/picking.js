// SPDX-License-Identifier: Apache-2.0
// Picks what is under a pixel: the nearest tag or antenna, or the position in the world seen there.

import {Matrix4, Plane, Raycaster, Vector2, Vector3} from "three";

const REACH_PX = 12;
const REACH_TOUCH_PX = 24;

export class Picking {
  constructor(stage, world, solids) {
    Object.assign(
      this,
      {stage, world, solids, ray: new Raycaster(), pixel: new Vector2(), clip: new Matrix4()});
  }

  // {kind, index} of the nearest one within reach of the pixel [CSS px of the canvas], or null.
  nearest(x, y, touch) {
    const {tags, antennas, position} = this.world;
    const {camera, canvas} = this.stage;
    camera.updateMatrixWorld();
    this.clip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const halfWidth = canvas.parentElement.clientWidth / 2;
    const halfHeight = canvas.parentElement.clientHeight / 2;
    const e = this.clip.elements;
    const away = (px, py, pz) => {
      const w = e[3] * px + e[7] * py + e[11] * pz + e[15];
      if (w <= camera.near) return Infinity;
      const u = (e[0] * px + e[4] * py + e[8] * pz + e[12]) / w;
      const v = (e[1] * px + e[5] * py + e[9] * pz + e[13]) / w;
      return Math.hypot((1 + u) * halfWidth - x, (1 - v) * halfHeight - y);
    };
    const best = {kind: "", index: -1, distance: touch ? REACH_TOUCH_PX : REACH_PX};
    const look = (kind, index, distance) => {
      if (distance < best.distance) Object.assign(best, {kind, index, distance});
    };
    for (let i = 0; i < tags.length; ++i) {
      if (tags[i].present)
        look("tag", i, away(position[3 * i], position[3 * i + 1], position[3 * i + 2]));
    }
    antennas.forEach(
      ({present, pose}, i) =>
        present && pose && look("antenna", i, away(pose[0], pose[1], pose[2])));
    return best.kind ? best : null;
  }

  // Position [m, frame W] seen at the pixel: on a solid, else on the floor; null above the horizon.
  place(x, y) {
    const {clientWidth: width, clientHeight: height} = this.stage.canvas.parentElement;
    this.pixel.set((2 * x) / width - 1, 1 - (2 * y) / height);
    this.ray.setFromCamera(this.pixel, this.stage.camera);
    const hits = this.ray.intersectObject(this.solids.group, true)
                   .filter(
                     (hit) => hit.object.isMesh && hit.object.material.depthWrite &&
                       !hit.object.userData.isHull);
    const floor = this.ray.ray.intersectPlane(new Plane(new Vector3(0, 0, 1), 0), new Vector3());
    const hit = hits[0]?.point ?? floor;
    return hit ? hit.toArray() : null;
  }
}
