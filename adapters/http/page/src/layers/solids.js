// SPDX-License-Identifier: Apache-2.0
// The world's solids: boxes, cylinders and spheres instanced by shape, meshes as they are. Walls
// and roofs between camera and hall become transparent, so that the inside can be seen.

import {
  Box3, BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide,
  EdgesGeometry, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshLambertMaterial, Quaternion, SphereGeometry, Vector3
} from "three";

import {isTransparent, solidColor} from "../colors.js";

const FAR = 60;              // A larger solid does not count towards the bounds of the world [m].
const HULL_SHARE = 0.8;      // A mesh larger than this share of the world in x and y is its hull.
const MOST_EDGES = 5000;     // Edges are drawn of meshes with fewer triangles than this [1].
const WALL_SHARE = 0.3;      // A wall is longer than this share of the world …
const WALL_THICKNESS = 0.6;  // … and thinner than this [m].

// Unit shapes with z as the axis, as in SDF.
const SHAPES = {
  box: () => new BoxGeometry(1, 1, 1),
  cylinder: () => new CylinderGeometry(1, 1, 1, 32).rotateX(Math.PI / 2),
  sphere: () => new SphereGeometry(1, 24, 16)
};

function scaleOf(solid) {
  if (solid.box) return new Vector3(...solid.box);
  if (solid.cylinder) return new Vector3(solid.cylinder[0], solid.cylinder[0], solid.cylinder[1]);
  return new Vector3().setScalar(solid.sphere);
}

const shapeOf = (solid) => Object.keys(SHAPES).find((shape) => solid[shape] !== undefined);

function poseMatrix(pose, scale = new Vector3(1, 1, 1)) {
  return new Matrix4().compose(
    new Vector3(...pose.slice(0, 3)), new Quaternion(...pose.slice(3, 7)).normalize(), scale);
}

function meshGeometry({vertices, triangles}) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(vertices), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
  return geometry;
}

// Position [x, y] of an obstacle at a time; null if it is absent then.
export function obstaclePlace({position, motion, appears, disappears}, time) {
  if (time < (appears ?? -Infinity) || time >= (disappears ?? Infinity)) return null;
  if (!motion) return position;
  const after = motion.findIndex(([t]) => t > time);
  if (after < 0) return motion.at(-1).slice(1);
  if (after === 0) return motion[0].slice(1);
  const [[t0, x0, y0], [t1, x1, y1]] = [motion[after - 1], motion[after]];
  const share = (time - t0) / (t1 - t0);
  return [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
}

const isThereForGood = ({motion, appears, disappears}) =>
  !motion && appears === undefined && disappears === undefined;

// Obstacles stand on the floor; the server sends them separately from the solids, as they appear
// and disappear.
function obstacleSolid(obstacle) {
  const [x, y] = obstacle.position;
  const height = obstacle.height;
  const pose = [x, y, height / 2, 0, 0, Math.sin(obstacle.yaw / 2), Math.cos(obstacle.yaw / 2)];
  const solid = {name: obstacle.name, material: obstacle.material || "wood", pose};
  if (obstacle.size && obstacle.size[0] > 0)
    solid.box = [...obstacle.size, height];
  else
    solid.cylinder = [obstacle.radius, height];
  return solid;
}

function boxOf(solid, meshes) {
  if (solid.plane) return null;
  const box = new Box3();
  if (solid.mesh !== undefined) {
    const {vertices} = meshes[solid.mesh];
    box.setFromArray(vertices);
    return box.applyMatrix4(poseMatrix(solid.pose));
  }
  const half = solid.box ? 0.5 : 1;
  const z = solid.cylinder ? 0.5 : half;
  box.set(new Vector3(-half, -half, -z), new Vector3(half, half, z));
  return box.applyMatrix4(poseMatrix(solid.pose, scaleOf(solid)));
}

const isGround = (box) => {
  const size = box.getSize(new Vector3());
  return size.z < 0.6 && box.max.z < 0.05 && Math.min(size.x, size.y) > 4;
};

// Whether a solid is a wall or roof, which hides what is behind it.
function hides(box, bounds) {
  const size = box.getSize(new Vector3());
  const whole = bounds.getSize(new Vector3());
  if (size.z < WALL_THICKNESS && box.min.z > 1.8 && size.x * size.y > 0.25 * whole.x * whole.y)
    return true;
  return (
    Math.min(size.x, size.y) < WALL_THICKNESS && size.z > 1.2 &&
    Math.max(size.x, size.y) > WALL_SHARE * Math.max(whole.x, whole.y));
}

// Whether a solid is a mesh of the complete hall, with all walls in one.
function isHull(solid, box, bounds) {
  if (solid.mesh === undefined) return false;
  const size = box.getSize(new Vector3());
  const whole = bounds.getSize(new Vector3());
  return size.x > HULL_SHARE * whole.x && size.y > HULL_SHARE * whole.y && size.z > 1.2;
}

// Draws only one pixel in 17 of faces seen from their outer side, including roofs but not floors.
function openTowardsCamera(material, center) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uCenter = {value: center};
    shader.vertexShader = shader.vertexShader.replace("void main() {", `
varying vec3 vPlace;
void main() {
  vPlace = (modelMatrix * vec4(position, 1.0)).xyz;`);
    shader.fragmentShader = shader.fragmentShader.replace("void main() {", `
uniform vec3 uCenter;
varying vec3 vPlace;
void main() {
  vec3 face = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  vec3 outwards = face * sign(dot(face, vPlace - uCenter));
  bool floorLike = abs(face.z) > 0.7 && vPlace.z < uCenter.z;
  if (!floorLike && dot(cameraPosition - vPlace, outwards) > 0.0 &&
      mod(floor(gl_FragCoord.x) + 4.0 * floor(gl_FragCoord.y), 17.0) >= 1.0) discard;`);
  };
}

export class Solids {
  constructor(stage, world) {
    this.stage = stage;
    this.world = world;
    this.group = new Group();
    stage.scene.add(this.group);
    this.screens = [];
    this.passing = [];  // Obstacles that move, appear or disappear, each with its mesh.
    this.inside = new Vector3();
    this.edgeColor = new Color("#000000");
  }

  setTheme({edge}) {
    this.edgeColor.set(edge);
    this.group.traverse((object) => {
      if (object.isLineSegments) object.material.color.copy(this.edgeColor);
    });
  }

  #clear() {
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.dispose();
      if (object.isInstancedMesh) object.dispose();
    });
    this.group.clear();
    this.screens = [];
  }

  // Draws all solids; returns their bounds (without floors and very large ones), or null.
  set(scene) {
    this.#clear();
    const solids =
      [...scene.solids, ...scene.obstacles.filter(isThereForGood).map(obstacleSolid)].filter(
        (one) => one.pose);
    const boxes = solids.map((solid) => boxOf(solid, scene.meshes));
    const bounds = new Box3();
    boxes.forEach((box) => {
      const size = box?.getSize(new Vector3());
      if (box && !isGround(box) && Math.max(size.x, size.y) < FAR) bounds.union(box);
    });
    const kept = [];
    solids.forEach((solid, i) => {
      if (!boxes[i] || isGround(boxes[i])) return;
      if (hides(boxes[i], bounds))
        this.#screen(solid, boxes[i], scene);
      else
        kept.push(solid);
    });
    for (const shape of Object.keys(SHAPES)) {
      for (const glass of [false, true]) {
        this.#instances(
          shape, glass,
          kept.filter((one) => shapeOf(one) === shape && isTransparent(one) === glass));
      }
    }
    this.#edges(kept.filter((one) => one.box));
    solids.forEach((solid, i) => {
      if (kept.includes(solid) && solid.mesh !== undefined)
        this.#mesh(solid, boxes[i], bounds, scene);
    });
    this.passing = scene.obstacles.filter((one) => !isThereForGood(one)).map((obstacle) => {
      const mesh = this.#single(obstacleSolid(obstacle), scene);
      this.group.add(mesh);
      return {obstacle, mesh};
    });
    this.place();
    return bounds.isEmpty() ? null : bounds;
  }

  // Moves obstacles to their current positions.
  place() {
    for (const {obstacle, mesh} of this.passing) {
      const at = obstaclePlace(obstacle, this.world.time);
      mesh.visible = Boolean(at);
      if (at) mesh.position.set(at[0], at[1], mesh.position.z);
    }
  }

  #instances(shape, glass, solids) {
    if (!solids.length) return;
    const material = new MeshLambertMaterial({
      transparent: glass,
      opacity: glass ? 0.35 : 1,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1
    });
    const mesh = new InstancedMesh(SHAPES[shape](), material, solids.length);
    solids.forEach((solid, i) => {
      mesh.setMatrixAt(i, poseMatrix(solid.pose, scaleOf(solid)));
      mesh.setColorAt(i, new Color(solidColor(solid)));
    });
    mesh.computeBoundingSphere();
    this.group.add(mesh);
  }

  // The edges of all boxes as one set of lines.
  #edges(solids) {
    const unit = new EdgesGeometry(SHAPES.box()).getAttribute("position");
    const points = new Float32Array(solids.length * unit.count * 3);
    const p = new Vector3();
    solids.forEach((solid, i) => {
      const X_WB = poseMatrix(solid.pose, scaleOf(solid));
      for (let k = 0; k < unit.count; ++k) {
        p.fromBufferAttribute(unit, k).applyMatrix4(X_WB).toArray(points, 3 * (i * unit.count + k));
      }
    });
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
    this.group.add(new LineSegments(
      geometry, new LineBasicMaterial({color: this.edgeColor, transparent: true, opacity: 0.28})));
  }

  #single(solid, scene) {
    const shape = shapeOf(solid);
    const geometry = shape ? SHAPES[shape]() : meshGeometry(scene.meshes[solid.mesh]);
    const glass = isTransparent(solid);
    const material = new MeshLambertMaterial({
      color: solidColor(solid),
      flatShading: !shape,
      transparent: glass,
      opacity: glass ? 0.35 : 1
    });
    const mesh = new Mesh(geometry, material);
    mesh.applyMatrix4(poseMatrix(solid.pose, shape ? scaleOf(solid) : undefined));
    return mesh;
  }

  #mesh(solid, box, bounds, scene) {
    const mesh = this.#single(solid, scene);
    this.group.add(mesh);
    if (isHull(solid, box, bounds)) {
      mesh.material.side = DoubleSide;
      mesh.userData.isHull = true;
      openTowardsCamera(mesh.material, bounds.getCenter(new Vector3()));
    } else if (scene.meshes[solid.mesh].triangles.length < 3 * MOST_EDGES) {
      mesh.add(new LineSegments(
        new EdgesGeometry(mesh.geometry, 30),
        new LineBasicMaterial({color: this.edgeColor, transparent: true, opacity: 0.28})));
    }
  }

  #screen(solid, box, scene) {
    const mesh = this.#single(solid, scene);
    this.group.add(mesh);
    this.screens.push(
      {mesh, center: box.getCenter(new Vector3()), size: box.getSize(new Vector3())});
  }

  frame() {
    const eye = this.stage.camera.position;
    const inside = this.stage.bounds.getCenter(this.inside);
    for (const {mesh, center, size} of this.screens) {
      const axis = size.z < WALL_THICKNESS ? "z" : size.x < size.y ? "x" : "y";
      const between = (eye[axis] - center[axis]) * (center[axis] - inside[axis]) > 0;
      if (mesh.material.transparent === between) continue;
      mesh.material.transparent = between;
      mesh.material.opacity = between ? 0.1 : 1;
      mesh.material.depthWrite = !between;
      mesh.material.needsUpdate = true;
    }
    return false;
  }
}
