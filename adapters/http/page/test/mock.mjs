// SPDX-License-Identifier: Apache-2.0
// A mock server with the API that the page uses, without the simulator: it replays the reads of a
// real run in a loop and adds N synthetic tags. For the page's own tests and for its development.
//
//   node mock.mjs PAGE.html RUN_FOLDER WORLD.sdf [--tags N] [--port P] [--recorded]
//                 [--explain TAGFIELD SCENARIO] [--modules DIR] [--change-while-loading]
//                 [--late-frames]
//
// The first line printed is "http: http://127.0.0.1:PORT". Link and coverage are computed by the
// real program given with --explain; without it these requests are answered with 409.
// With --change-while-loading the first tag moves to (1, 2, 3) after the first answer to
// GET /api/tags was put together, and a frame says so before that answer is sent.
// With --late-frames each frame is sent 0.3 s late, so that answers overtake frames.
// POST /api/set-back sets the time to 0 and moves the first tag to (1, 2, 3) without a frame that says
// so, as when another server takes the place of this one.

import {execFile} from "node:child_process";
import {mkdtempSync, readdirSync, readFileSync, rmSync} from "node:fs";
import http from "node:http";
import {createRequire} from "node:module";
import os from "node:os";
import path from "node:path";
import {setTimeout} from "node:timers/promises";
import {fileURLToPath} from "node:url";
import {promisify} from "node:util";

import {poseOf, readRun} from "./run.mjs";

const FRAME_S = 0.05;
const LATE_MS = 300;
const SYNTHETIC_READS_S = 1000;  // Of all synthetic tags together, per second of wall-clock time.
const call = promisify(execFile);

function parse(words) {
  const given = {
    files: [],
    tags: 0,
    port: 0,
    recorded: false,
    explain: null,
    changesWhileLoading: false,
    lateFrames: false,
    modules: path.join(path.dirname(fileURLToPath(import.meta.url)), "..")
  };
  while (words.length) {
    const word = words.shift();
    if (word === "--tags")
      given.tags = Number(words.shift());
    else if (word === "--port")
      given.port = Number(words.shift());
    else if (word === "--recorded")
      given.recorded = true;
    else if (word === "--explain")
      given.explain = [words.shift(), words.shift()];
    else if (word === "--modules")
      given.modules = words.shift();
    else if (word === "--change-while-loading")
      given.changesWhileLoading = true;
    else if (word === "--late-frames")
      given.lateFrames = true;
    else
      given.files.push(word);
  }
  return given;
}

const given = parse(process.argv.slice(2));
const {WebSocketServer} = createRequire(path.join(given.modules, "package.json"))("ws");
const [pageFile, runFolder, sdf] = given.files;
const run = readRun(runFolder, sdf);
const synthetic = Array.from(
  {length: given.tags}, (_, i) => ({
                          id: `case_${i + 1}`,
                          rotation: [0, 0, 0, 1],
                          moves: false,
                          position: [
                            -7.6 + 15.2 * ((i * 0.754877666) % 1),
                            -9.6 + 19.2 * ((i * 0.569840291) % 1), 0.2 + 2.6 * ((i * 0.362) % 1)
                          ]
                        }));
run.tags.push(...synthetic);

const world = {
  time: 0,
  paused: false,
  speed: 1,
  tags: run.tags.map((tag) => ({...tag})),
  antennas: run.antennas.map((one) => ({...one})),
  obstacles: [],
  reads: 0,
  changed: false,
  moved: []
};
const sockets = new Set();
const lap = run.duration[1];

function poseAt(track) {
  const t = world.time % lap;
  const i = track.t.findLastIndex((one) => one <= t);
  return track.pose[Math.max(i, 0)];
}

const latestPoses = (tracks) =>
  Object.entries(tracks).map(([name, track]) => [name, ...poseAt(track)]);

// Aggregates reads like a real server: the last read of each tag by each antenna since the last
// frame, and their number.
function readsBetween(from, to) {
  const last = new Map();
  const add = (tag, antenna, rssi, phase, t) => {
    const key = `${tag} ${antenna}`;
    last.set(key, [tag, antenna, rssi, phase, 866.3e6, t, (last.get(key)?.[6] ?? 0) + 1]);
  };
  const on = new Set(world.antennas.filter((one) => !one.faulty).map((one) => one.name));
  const there = new Set(world.tags.map((one) => one.id));
  const start = Math.floor(from / lap) * lap;
  for (let i = 0; i < run.reads.t.length; ++i) {
    const t = start + run.reads.t[i];
    const [tag, antenna] = [run.tags[run.reads.tag[i]].id, run.antennas[run.reads.antenna[i]].name];
    if (t > from && t <= to && on.has(antenna) && there.has(tag))
      add(tag, antenna, run.reads.rssi[i], run.reads.phase[i], t);
  }
  const n = synthetic.length ? Math.round(SYNTHETIC_READS_S * FRAME_S) : 0;
  for (let k = 0; k < n; ++k) {
    const tag = synthetic[Math.floor(Math.random() * synthetic.length)];
    const antenna = run.antennas[k % run.antennas.length];
    const p = poseAt(run.antenna_poses[antenna.name]);
    const d = Math.hypot(...tag.position.map((value, j) => value - p[j]));
    if (d < 9)
      add(tag.id, antenna.name, -32 - 40 * Math.log10(d + 0.5), (21.7 * 2 * d) % (2 * Math.PI), to);
  }
  return [...last.values()];
}

function scanAt(pose) {
  const n = 180;
  const [x, y] = pose;
  const yaw = 2 * Math.atan2(pose[5], pose[6]);
  const ranges = Array.from({length: n}, (_, i) => {
    const angle = yaw - Math.PI / 2 + (i * Math.PI) / n;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return Math.min(c > 0 ? (8 - x) / c : (-8 - x) / c, s > 0 ? (10 - y) / s : (-10 - y) / s);
  });
  return {
    origin: [x, y, 0.35, ...pose.slice(3)],
    angle_min: -Math.PI / 2,
    angle_step: Math.PI / n,
    ranges
  };
}

function advance(seconds) {
  const before = world.time;
  world.time += seconds;
  const reads = seconds ? readsBetween(before, world.time) : [];
  world.reads += reads.reduce((sum, read) => sum + read[6], 0);
  const robots = latestPoses(run.robot_poses);
  const frame = {
    time: world.time,
    pace: world.paused ? 0 : world.speed,
    paused: world.paused,
    speed: world.speed,
    robots,
    antennas: latestPoses(run.antenna_poses),
    tags: world.moved,
    reads,
    scans: robots.map((robot) => scanAt(robot.slice(1))),
    estimates: Math.floor(world.time) > Math.floor(before) ? run.estimates : [],
    dropped: 0
  };
  if (world.changed) frame.changed = true;
  world.changed = false;
  world.moved = [];
  send(JSON.stringify(frame));
}

async function send(text) {
  if (given.lateFrames) await setTimeout(LATE_MS);
  for (const socket of sockets)
    if (socket.bufferedAmount < 1 << 20) socket.send(text);
}

const status = () => ({
  name: run.scene.name,
  time: world.time,
  speed: world.speed,
  pace: world.speed,
  paused: world.paused,
  reads: world.reads,
  tags: world.tags.length,
  antennas: world.antennas.length,
  version: "mock",
  mode: given.recorded ? "recorded" : "live",
  duration: given.recorded ? lap : null
});

class Refused extends Error {
  constructor(code, text) {
    super(text);
    this.code = code;
  }
}

function find(list, key, name) {
  const index = list.findIndex((one) => one[key] === name);
  if (index < 0) throw new Refused(404, `there is no "${name}"`);
  return index;
}

async function explain(query) {
  const antenna = world.antennas[find(world.antennas, "name", query.get("antenna"))];
  find(world.tags, "id", query.get("tag"));
  if (antenna.faulty) throw new Refused(409, `antenna "${antenna.name}" is off`);
  if (!given.explain) throw new Refused(409, "this mock has no simulator");
  const [tagfield, scenario] = given.explain;
  const {stdout} = await call(
    tagfield,
    [
      "explain", scenario, "--json", "--antenna", query.get("antenna"), "--tag", query.get("tag"),
      "--time", String(world.time % lap)
    ],
    {maxBuffer: 1 << 24});
  return JSON.parse(stdout);
}

async function coverage(query) {
  if (!given.explain) throw new Refused(409, "this mock has no simulator");
  const [tagfield, scenario] = given.explain;
  const folder = mkdtempSync(path.join(os.tmpdir(), "tagfield-mock-"));
  const cell = Number(query.get("cell"));
  try {
    await call(tagfield, [
      "coverage", scenario, "--antenna", query.get("antenna"), "--height", query.get("height"),
      "--step", String(cell), "--time", String(world.time % lap), "--out",
      path.join(folder, "coverage")
    ]);
    const file = readdirSync(path.join(folder, "coverage"))
                   .find((name) => /^coverage_[\d.]+m\.csv$/.test(name));
    const rows = readFileSync(path.join(folder, "coverage", file), "utf8")
                   .trim()
                   .split("\n")
                   .slice(1)
                   .map((line) => line.split(","));
    const columns = rows.filter((row) => row[1] === rows[0][1]).length;
    return {
      x0: Number(rows[0][0]) - cell / 2,
      y0: Number(rows[0][1]) - cell / 2,
      cell,
      columns,
      rows: rows.length / columns,
      margin_db: rows.map((row) => (row[4] === "" ? null : Number(row[4])))
    };
  } finally {
    rmSync(folder, {recursive: true});
  }
}

function place(position, n) {
  if (!Array.isArray(position) || position.length !== n || !position.every(Number.isFinite)) {
    throw new Refused(400, `position must be ${n} numbers [m]`);
  }
  return position;
}

function change(method, [kind, name, verb], body) {
  const [list, key] = {
    tags: [world.tags, "id"],
    antennas: [world.antennas, "name"],
    obstacles: [world.obstacles, "name"]
  }[kind];
  world.changed = true;
  if (method === "DELETE") {
    list.splice(find(list, key, name), 1);
  } else if (!name) {
    if (list.some((one) => one[key] === body[key]))
      throw new Refused(409, `${kind}: there is a "${body[key]}" already`);
    if (kind === "tags")
      list.push(
        {id: body.id, position: place(body.position, 3), rotation: [0, 0, 0, 1], moves: false});
    if (kind === "antennas")
      list.push({...list[find(list, "name", body.like)], name: body.name, pose: poseOf(body.pose)});
    if (kind === "obstacles") {
      list.push({
        name: body.name,
        position: place(body.position, 2),
        size: body.size ?? [0, 0],
        radius: body.radius ?? 0,
        yaw: ((body.yaw_deg ?? 0) * Math.PI) / 180,
        height: body.height,
        material: body.material
      });
    }
  } else {
    const one = list[find(list, key, name)];
    if (verb === "move" && kind === "tags")
      one.position = place(body.position, 3);
    else if (verb === "disconnect" || verb === "connect")
      one.faulty = verb === "disconnect";
    else if (verb !== "detune")
      throw new Refused(404, `no such command: ${verb}`);
  }
}

async function tags() {
  const answered = structuredClone(world.tags);
  if (given.changesWhileLoading) {
    given.changesWhileLoading = false;
    change("POST", ["tags", world.tags[0].id, "move"], {position: [1, 2, 3]});
    await setTimeout(10 * 1000 * FRAME_S);
  }
  return {tags: answered};
}

async function answer(method, words, query, body) {
  const what = words.join("/");
  if (method === "GET") {
    if (what === "status") return status();
    if (what === "run" && given.recorded) return run;
    if (what === "scene") return {...run.scene, obstacles: world.obstacles};
    if (what === "antennas") return {antennas: world.antennas};
    if (what === "tags") return tags();
    if (what === "explain") return explain(query);
    if (what === "coverage") return coverage(query);
    throw new Refused(404, `no such address: /api/${what}`);
  }
  if (["pause", "resume"].includes(what))
    world.paused = what === "pause";
  else if (what === "speed")
    world.speed = body.speed || 100;
  else if (what === "step")
    advance(body.seconds);
  else if (what === "set-back")
    [world.time, world.tags[0].position] = [0, [1, 2, 3]];
  else if (["tags", "antennas", "obstacles"].includes(words[0]))
    change(method, words, body);
  else
    throw new Refused(404, `no such command: ${what}`);
  return status();
}

const server = http.createServer(async (request, response) => {
  const url = new URL(request.url, "http://mock");
  const words = url.pathname.split("/").slice(1).map(decodeURIComponent);
  if (words[0] !== "api") {
    response.writeHead(
      url.pathname === "/" ? 200 : 404, {"Content-Type": "text/html; charset=utf-8"});
    response.end(url.pathname === "/" ? readFileSync(pageFile) : "");
    return;
  }
  let text = "";
  for await (const chunk of request) text += chunk;
  try {
    const body =
      await answer(request.method, words.slice(1), url.searchParams, text ? JSON.parse(text) : {});
    response.writeHead(200, {"Content-Type": "application/json"}).end(JSON.stringify(body));
  } catch (error) {
    response.writeHead(error.code > 0 ? error.code : 500, {"Content-Type": "application/json"});
    response.end(JSON.stringify({error: error.message.split("\n")[0]}));
  }
});

new WebSocketServer({server, path: "/api/live"}).on("connection", (socket) => {
  sockets.add(socket);
  socket.on("close", () => sockets.delete(socket));
});
setInterval(() => advance(world.paused ? 0 : FRAME_S * world.speed), 1000 * FRAME_S);
server.listen(
  given.port, "127.0.0.1", () => console.log(`http: http://127.0.0.1:${server.address().port}`));
