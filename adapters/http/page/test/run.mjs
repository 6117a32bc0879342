// SPDX-License-Identifier: Apache-2.0
// Converts a run's folder and its world's SDF to the answer of GET /api/run: real reads for the
// mock server.

import {existsSync, readFileSync} from "node:fs";
import path from "node:path";

function csv(file) {
  const [head, ...lines] = readFileSync(file, "utf8").trim().split("\n");
  const names = head.split(",");
  return lines.map((line) => {
    const cells = line.split(",");
    return Object.fromEntries(names.map((name, i) => [name, cells[i]]));
  });
}

const numbers = (row, names) => names.map((name) => Number(row[name]));
const POSE = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"];

// [x, y, z, roll, pitch, yaw] → [x, y, z, qx, qy, qz, qw]
export function poseOf([x, y, z, roll = 0, pitch = 0, yaw = 0]) {
  const [cr, sr, cp, sp, cy, sy] =
    [roll, pitch, yaw].flatMap((a) => [Math.cos(a / 2), Math.sin(a / 2)]);
  return [
    x, y, z, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
    cr * cp * cy + sr * sp * sy
  ];
}

// Collisions of an SDF whose models and links are rotated about z only, as in this project's own
// worlds.
export function solidsOf(sdf, materials) {
  const text =
    readFileSync(sdf, "utf8").replace(/<!--[^]*?-->/g, "").replace(/<visual[^]*?<\/visual>/g, "");
  const solids = [];
  const scopes = [];
  const list = (words) => words.trim().split(/\s+/).map(Number);
  let solid = null;
  for (const [, close, tag, attributes, content] of text.matchAll(/<(\/?)(\w+)([^>]*)>([^<]*)/g)) {
    if (close && ["model", "link", "collision"].includes(tag)) {
      if (tag === "collision") solids.push(finished(scopes, solid, materials));
      scopes.pop();
      if (tag === "collision") solid = null;
    } else if (!close && ["model", "link", "collision"].includes(tag)) {
      scopes.push({name: /name="([^"]*)"/.exec(attributes)[1], pose: [0, 0, 0, 0, 0, 0]});
      if (tag === "collision") solid = {};
    } else if (!close && tag === "pose" && scopes.length) {
      scopes.at(-1).pose = list(content);
    } else if (!close && solid) {
      measure(solid, tag, content, list);
    }
  }
  return solids;
}

function measure(solid, tag, content, list) {
  if (tag === "box") solid.box = [1, 1, 1];
  if (tag === "cylinder") solid.cylinder = [1, 1];
  if (tag === "plane") solid.plane = [1, 1];
  if (tag === "size") solid[solid.box ? "box" : "plane"] = list(content);
  if (tag === "normal") solid.normal = list(content);
  if (tag === "radius")
    solid.cylinder ? (solid.cylinder[0] = Number(content)) : (solid.sphere = Number(content));
  if (tag === "length") solid.cylinder[1] = Number(content);
}

function finished(scopes, solid, materials) {
  const pose = scopes.reduce(
    ([x, y, z, , , yaw], {pose: p}) =>
      [x + Math.cos(yaw) * p[0] - Math.sin(yaw) * p[1],
       y + Math.sin(yaw) * p[0] + Math.cos(yaw) * p[1], z + p[2], 0, 0, yaw + p[5]],
    [0, 0, 0, 0, 0, 0]);
  const named = scopes.map((scope) => scope.name);
  const material =
    Object.entries(materials).find(([name]) => named.some((one) => one.includes(name)))?.[1] ?? "";
  return {name: named.join("::"), material, pose: poseOf(pose), ...solid};
}

function tracks(rows, key, fields, column, every) {
  const all = {};
  const seen = {};
  for (const row of rows) {
    seen[row[key]] = (seen[row[key]] ?? -1) + 1;
    if (seen[row[key]] % every) continue;
    const track = (all[row[key]] ??= {t: [], [column]: []});
    track.t.push(Number(row.stamp_s));
    track[column].push(numbers(row, fields));
  }
  return all;
}

// A 6 dBi panel: its gain falls as cos² of the angle from boresight, and is −20 dB behind.
export function panelBeam() {
  const theta = Array.from({length: 37}, (_, i) => (i * Math.PI) / 36);
  const phi = Array.from({length: 24}, (_, i) => (i * Math.PI) / 12);
  return {
    theta,
    phi,
    gain_db: theta.map(
      (angle) => phi.map(
        () => (angle < Math.PI / 2 ? Math.max(20 * Math.log10(Math.cos(angle)), -20) : -20)))
  };
}

export function readRun(folder, sdf) {
  const file = (name) => path.join(folder, name);
  const antennaPoses = tracks(csv(file("truth/antenna_poses.csv")), "antenna", POSE, "pose", 3);
  const robotFile = file("truth/robot_poses.csv");
  const robotPoses = existsSync(robotFile) ? tracks(csv(robotFile), "robot", POSE, "pose", 3) : {};
  const tags = csv(file("truth/tags.csv")).map((row) => ({
                                                 id: row.tag,
                                                 position: numbers(row, ["x_m", "y_m", "z_m"]),
                                                 rotation: [0, 0, 0, 1],
                                                 moves: false
                                               }));
  const antennas = Object.entries(antennaPoses).map(([name, {pose}], i) => ({
                                                      name,
                                                      reader: "reader_1",
                                                      port: i + 1,
                                                      on: true,
                                                      faulty: false,
                                                      robot: Object.keys(robotPoses)[0] ?? "",
                                                      pose: pose[0],
                                                      model: "physical",
                                                      range: 7,
                                                      frequency: 866.3e6,
                                                      power_dbm: 29.7,
                                                      beam: panelBeam()
                                                    }));
  const tagIndex = new Map(tags.map(({id}, i) => [id, i]));
  const antennaIndex = new Map(antennas.map(({name}, i) => [name, i]));
  const rows = csv(file("reads.csv"));
  const robot = Object.values(robotPoses)[0]?.pose ?? [];
  return {
    scene: {
      name: path.basename(folder),
      description: "A real run, for the page's tests",
      meshes: [],
      obstacles: [],
      map: null,
      solids: solidsOf(sdf, {
        racks: "metal",
        boxes: "cardboard",
        walls: "concrete",
        ground_plane: "concrete",
        obstacles: "wood"
      }),
      paths: robot.length ?
        [{name: "robot", points: robot.filter((_, i) => i % 5 === 0).map((p) => p.slice(0, 3))}] :
        []
    },
    antennas,
    tags,
    antenna_poses: antennaPoses,
    robot_poses: robotPoses,
    tag_positions: {},
    duration: [0, Number(rows.at(-1).stamp_s)],
    reads: {
      t: rows.map((row) => Number(row.stamp_s)),
      tag: rows.map((row) => tagIndex.get(row.tag)),
      antenna: rows.map((row) => antennaIndex.get(row.antenna)),
      rssi: rows.map((row) => Number(row.rssi_dbm)),
      phase: rows.map((row) => Number(row.phase_rad))
    },
    estimates: csv(file("estimates.csv"))
                 .filter((row) => row.verdict === "located")
                 .map(
                   (row) =>
                     [row.tag, ...numbers(row, ["x_m", "y_m", "z_m"]),
                      numbers(row, ["cov_xx", "cov_xy", "cov_yy"])])
  };
}
