// What lies under a pixel: a tag or antenna near it, or the place of the world that is seen there.

import {Plane, Raycaster, Vector2, Vector3} from "three";

const REACH_PX = 12;
const REACH_TOUCH_PX = 24;

export class Picking {
  constructor(stage, world, solids) {
    Object.assign(this, {stage, world, solids, ray: new Raycaster(), pixel: new Vector2()});
  }

  // {kind, index} of the nearest within reach of the pixel [CSS px of the canvas], or null.
  nearest(x, y, touch) {
    const reach = touch ? REACH_TOUCH_PX : REACH_PX;
    let best = null;
    const look = (kind, index, p, bonus) => {
      const at = this.stage.project(p[0], p[1], p[2]);
      const distance = at ? Math.hypot(at[0] - x, at[1] - y) - bonus : Infinity;
      if (distance <= reach && (!best || distance < best.distance)) best = {kind, index, distance};
    };
    const {position} = this.world;
    this.world.tags.forEach((tag, i) => {
      if (tag.present) look("tag", i, position.subarray(3 * i, 3 * i + 3), 0);
    });
    this.world.antennas.forEach((antenna, i) => {
      if (antenna.present && antenna.pose) look("antenna", i, antenna.pose, 2);
    });
    return best;
  }

  // Place of frame W seen at the pixel: on a solid, else on the floor; null above the horizon.
  place(x, y) {
    const {clientWidth: width, clientHeight: height} = this.stage.canvas.parentElement;
    this.pixel.set((2 * x) / width - 1, 1 - (2 * y) / height);
    this.ray.setFromCamera(this.pixel, this.stage.camera);
    const hits = this.ray.intersectObject(this.solids.group, true)
      .filter((hit) => hit.object.isMesh && hit.object.material.depthWrite);
    const floor = this.ray.ray.intersectPlane(new Plane(new Vector3(0, 0, 1), 0), new Vector3());
    const hit = hits[0]?.point ?? floor;
    return hit ? hit.toArray() : null;
  }
}
