// SPDX-License-Identifier: Apache-2.0
// Robots: a simple body half a metre long that shows the heading, and the points of its laser scan.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, DynamicDrawUsage,
  EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial,
  Points, PointsMaterial, Quaternion, Vector3
} from "three";

const WIDTH_M = 0.5;
const HEIGHT_M = 0.25;

function robot() {
  const group = new Group();
  const box = new BoxGeometry(WIDTH_M, 0.8 * WIDTH_M, HEIGHT_M);
  const paint = new MeshLambertMaterial({color: "#c9332c"});
  const trunk = new Mesh(box, paint);
  const edges = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial({color: "#3a0d0b"}));
  trunk.position.z = edges.position.z = 0.06 + HEIGHT_M / 2;
  const nose = new Mesh(
    new ConeGeometry(0.11, 0.24, 3).rotateZ(-Math.PI / 2),
    new MeshLambertMaterial({color: "#ffffff"}));
  nose.scale.z = 0.25;
  nose.position.set(0.08, 0, 0.06 + HEIGHT_M + 0.02);
  group.add(trunk, edges, nose);
  const wheel = new CylinderGeometry(0.1, 0.1, 0.06, 20);
  const rubber = new MeshLambertMaterial({color: "#26282b"});
  for (const [x, y] of [[0.14, 0.23], [0.14, -0.23], [-0.14, 0.23], [-0.14, -0.23], ]) {
    const one = new Mesh(wheel, rubber);
    one.position.set(x, y, 0.1);
    group.add(one);
  }
  return group;
}

// A thin mast from the robot up to an antenna mounted on it.
function mast() {
  const one = new Mesh(
    new CylinderGeometry(0.015, 0.015, 1, 8).rotateX(Math.PI / 2).translate(0, 0, 0.5),
    new MeshLambertMaterial({color: "#4a4f55"}));
  return one;
}

export class Robots {
  constructor(stage, world) {
    this.stage = stage;
    this.world = world;
    this.bodies = new Map();
    this.masts = new Map();
    const points = new BufferGeometry();
    this.scan =
      new Points(points, new PointsMaterial({color: "#e0452f", size: 3, sizeAttenuation: false}));
    this.scan.frustumCulled = false;
    this.scan.visible = false;
    stage.scene.add(this.scan);
    this.laser = new Matrix4();
  }

  update(changed) {
    if (changed.has("robots")) this.#bodies();
    if (changed.has("robots") || changed.has("poses") || changed.has("antennas")) this.#masts();
    if (changed.has("scans")) this.#scans();
  }

  #bodies() {
    for (const [name, body] of this.bodies) {
      if (this.world.robots.has(name)) continue;
      this.stage.scene.remove(body);
      this.bodies.delete(name);
    }
    for (const [name, pose] of this.world.robots) {
      if (!this.bodies.has(name)) {
        this.bodies.set(name, robot());
        this.stage.scene.add(this.bodies.get(name));
      }
      const body = this.bodies.get(name);
      body.position.set(pose[0], pose[1], pose[2]);
      body.quaternion.set(pose[3], pose[4], pose[5], pose[6]).normalize();
    }
  }

  #masts() {
    this.world.antennas.forEach((antenna, i) => {
      const pose = this.world.robots.get(antenna.robot);
      const shown =
        Boolean(pose && antenna.present && antenna.pose && antenna.pose[2] > pose[2] + 0.4);
      if (shown && !this.masts.has(i)) {
        this.masts.set(i, mast());
        this.stage.scene.add(this.masts.get(i));
      }
      const one = this.masts.get(i);
      if (!one) return;
      one.visible = shown;
      if (!shown) return;
      one.position.set(antenna.pose[0], antenna.pose[1], pose[2] + 0.06 + HEIGHT_M);
      one.scale.z = antenna.pose[2] - one.position.z;
    });
  }

  #scans() {
    const {scans} = this.world;
    const most = scans.reduce((sum, scan) => sum + scan.ranges.length, 0);
    this.scan.visible = most > 0;
    if (most === 0) return;
    let attribute = this.scan.geometry.getAttribute("position");
    if (!attribute || attribute.count < most) {
      this.scan.geometry.dispose();
      attribute = new BufferAttribute(new Float32Array(3 * most), 3).setUsage(DynamicDrawUsage);
      this.scan.geometry.setAttribute("position", attribute);
    }
    let drawn = 0;
    for (const scan of scans) drawn = this.#ends(scan, attribute.array, drawn);
    attribute.needsUpdate = true;
    this.scan.geometry.setDrawRange(0, drawn);
  }

  // Writes the end points of the scan from index `drawn` on; returns the index after the last one.
  #ends(scan, points, drawn) {
    const [x, y, z, ...q] = scan.origin;
    this.laser.compose(
      new Vector3(x, y, z), new Quaternion(...q).normalize(), new Vector3(1, 1, 1));
    const p = new Vector3();
    scan.ranges.forEach((range, i) => {
      if (!(range > 0)) return;
      const angle = scan.angle_min + i * scan.angle_step;
      p.set(range * Math.cos(angle), range * Math.sin(angle), 0).applyMatrix4(this.laser);
      p.toArray(points, 3 * drawn++);
    });
    return drawn;
  }

  // Position of the first robot, else of the first moving antenna; null if there is neither.
  place() {
    const [pose] = this.world.robots.values();
    const moving =
      pose ?? this.world.antennas.find((one) => one.present && one.trail.length > 3)?.pose;
    return moving ? new Vector3(moving[0], moving[1], moving[2] + 0.5) : null;
  }
}
