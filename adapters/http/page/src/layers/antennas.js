// SPDX-License-Identifier: Apache-2.0
// Antennas: a plate that faces along its boresight, the half-power part of its beam or the sphere
// of the read range in the paper's model, and the trail of a moving one.

import {
  AdditiveBlending, BoxGeometry, BufferAttribute, BufferGeometry, Color, ConeGeometry, DoubleSide,
  EdgesGeometry, Group, Line, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, NormalBlending, ShaderMaterial, SphereGeometry
} from "three";

import {antennaColor} from "../colors.js";

const HALF_POWER_DB = -3;
const BEAM_LENGTH_M = 3;  // At the peak. Only the shape has a meaning: ranges depend on the tag.
const AZIMUTHS = 48;
const POLARS = 20;

const SHELL_VERTEX = `
varying vec3 vNormal_, vEye;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  vNormal_ = normalMatrix * normal;
  vEye = -at.xyz;
  gl_Position = projectionMatrix * at;
}`;
const SHELL_FRAGMENT = `
uniform vec3 uColor;
uniform float uOpacity;
varying vec3 vNormal_, vEye;
void main() {
  float edge = 1.0 - abs(dot(normalize(vNormal_), normalize(vEye)));
  gl_FragColor = vec4(uColor, uOpacity * (0.12 + 0.88 * edge * edge * edge));
}`;

function bracket(values, x) {
  let i = 0;
  while (i < values.length - 2 && values[i + 1] <= x) ++i;
  const step = values[i + 1] - values[i];
  return [i, step > 0 ? Math.min(Math.max((x - values[i]) / step, 0), 1) : 0];
}

// Relative gain [dB] at the polar angle theta from boresight and the azimuth phi about it [rad],
// phi from 0 to 2 π; azimuths of the grid are evenly spaced and begin at 0.
function gainAt(beam, theta, phi) {
  const [i, u] = bracket(beam.theta, theta);
  const n = beam.phi.length;
  const turn = (phi / (2 * Math.PI)) * n;
  const j = Math.floor(turn) % n;
  const v = turn - Math.floor(turn);
  const row = (at) => (1 - v) * beam.gain_db[at][j] + v * beam.gain_db[at][(j + 1) % n];
  return (1 - u) * row(i) + u * row(i + 1);
}

// Angle from boresight at which the gain has fallen to half [rad].
function halfPowerAngle(beam, phi) {
  for (let theta = 0; theta < Math.PI; theta += 0.005) {
    if (gainAt(beam, theta, phi) < HALF_POWER_DB) return theta;
  }
  return Math.PI;
}

// r = L·sqrt(gain) in all directions up to the half-power angle, closed by rays to the antenna.
function beamGeometry(beam) {
  const points = [0, 0, 0];
  const indices = [];
  for (let a = 0; a <= AZIMUTHS; ++a) {
    const phi = (2 * Math.PI * (a % AZIMUTHS)) / AZIMUTHS;
    const widest = halfPowerAngle(beam, phi);
    for (let k = 0; k <= POLARS; ++k) {
      const theta = (widest * k) / POLARS;
      const r = BEAM_LENGTH_M * 10 ** (Math.min(gainAt(beam, theta, phi), 0) / 20);
      points.push(
        r * Math.cos(theta), r * Math.sin(theta) * Math.cos(phi),
        r * Math.sin(theta) * Math.sin(phi));
    }
  }
  const at = (a, k) => 1 + a * (POLARS + 1) + k;
  for (let a = 0; a < AZIMUTHS; ++a) {
    for (let k = 0; k < POLARS; ++k) {
      indices.push(
        at(a, k), at(a + 1, k), at(a, k + 1), at(a + 1, k), at(a + 1, k + 1), at(a, k + 1));
    }
    indices.push(0, at(a, POLARS), at(a + 1, POLARS));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return geometry;
}

// Rim of the half-power part and four rays to it.
function beamLines(geometry) {
  const p = geometry.getAttribute("position");
  const points = [];
  const push = (i) => points.push(p.getX(i), p.getY(i), p.getZ(i));
  for (let a = 0; a < AZIMUTHS; ++a) {
    push(1 + a * (POLARS + 1) + POLARS);
    push(1 + (a + 1) * (POLARS + 1) + POLARS);
    if (a % (AZIMUTHS / 4) === 0) {
      push(0);
      push(1 + a * (POLARS + 1) + POLARS);
    }
  }
  return new BufferGeometry().setAttribute(
    "position", new BufferAttribute(new Float32Array(points), 3));
}

function shell(geometry, color, opacity) {
  const mesh = new Mesh(
    geometry, new ShaderMaterial({
      vertexShader: SHELL_VERTEX,
      fragmentShader: SHELL_FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      uniforms: {uColor: {value: new Color().setStyle(color, "")}, uOpacity: {value: opacity}}
    }));
  mesh.renderOrder = 10;
  return mesh;
}

function body(color) {
  const group = new Group();
  const plate = new BoxGeometry(0.04, 0.26, 0.26);
  group.add(
    new Mesh(plate, new MeshLambertMaterial({color})),
    new LineSegments(new EdgesGeometry(plate), new LineBasicMaterial({color: "#000000"})));
  const arrow = new Mesh(
    new ConeGeometry(0.06, 0.16, 12).rotateZ(-Math.PI / 2), new MeshLambertMaterial({color}));
  arrow.position.x = 0.16;
  group.add(arrow);
  return group;
}

export class Antennas {
  constructor(stage, world) {
    this.stage = stage;
    this.world = world;
    this.items = [];
    this.beams = true;
  }

  update(changed) {
    if (changed.has("antennas")) this.#rebuild();
    if (changed.has("antennas") || changed.has("poses")) this.#pose();
    if (changed.has("antennas") || changed.has("selection") || changed.has("theme")) this.#light();
  }

  #rebuild() {
    for (const item of this.items) {
      this.stage.scene.remove(item.group, item.trail);
      item.group.traverse((object) => {
        object.geometry?.dispose();
        object.material?.dispose();
      });
    }
    this.items = this.world.antennas.map((antenna, index) => this.#build(antenna, index));
  }

  #build(antenna, index) {
    const color = antennaColor(index);
    const group = body(antenna.faulty || antenna.on === false ? "#777777" : color);
    let beam = null;
    if (antenna.beam) {
      const geometry = beamGeometry(antenna.beam);
      beam = new Group();
      beam.add(
        shell(geometry, color, 0.3),
        new LineSegments(
          beamLines(geometry), new LineBasicMaterial({color, transparent: true, opacity: 0.55})));
    } else if (antenna.range > 0) {
      beam = shell(new SphereGeometry(antenna.range, 48, 32), color, 0.35);
    }
    if (beam) group.add(beam);
    group.visible = antenna.present;
    const trail = new Line(
      new BufferGeometry(), new LineBasicMaterial({color, transparent: true, opacity: 0.7}));
    trail.frustumCulled = false;
    this.stage.scene.add(group, trail);
    return {group, beam, trail, drawn: -1};
  }

  #pose() {
    this.world.antennas.forEach(({pose, trail}, i) => {
      const item = this.items[i];
      if (!item || !pose) return;
      item.group.position.set(pose[0], pose[1], pose[2]);
      item.group.quaternion.set(pose[3], pose[4], pose[5], pose[6]).normalize();
      this.#trail(item, trail);
    });
  }

  // The buffer is reallocated only when it is too small.
  #trail(item, trail) {
    if (trail.length === item.drawn && this.world.live === false) return;
    const {geometry} = item.trail;
    let attribute = geometry.getAttribute("position");
    if (!attribute || attribute.array.length < trail.length) {
      attribute = new BufferAttribute(new Float32Array(Math.max(3000, 2 * trail.length)), 3);
      geometry.dispose();
      geometry.setAttribute("position", attribute);
    }
    attribute.array.set(trail);
    attribute.needsUpdate = true;
    geometry.setDrawRange(0, trail.length / 3);
    item.drawn = trail.length;
  }

  // With one selected, the beams of the others are hidden.
  #light() {
    const {selection} = this.world;
    const chosen = selection?.kind === "antenna" ? selection.index : -1;
    this.items.forEach((item, i) => {
      if (!item.beam) return;
      const antenna = this.world.antennas[i];
      item.beam.visible = this.beams && antenna.present && !antenna.faulty &&
        antenna.on !== false && (chosen < 0 || chosen === i);
    });
  }

  showBeams(on) {
    this.beams = on;
    this.#light();
  }
}
