// SPDX-License-Identifier: Apache-2.0
// The state of the world at one moment, from either source: a live server or a recorded run. Tags
// and antennas keep their index until reset(); a removed one is marked as absent, so that the
// indices in its reads stay valid.

import {ReadLog} from "./reads.js";

const LIVE_READS = 1 << 18;
const TRAIL = 2000;         // Positions of a moving antenna that are kept [1].
const RECENT_S = 2;         // A tag counts as recently read for this long [simulated s] …
const RECENT_REAL_S = 0.5;  // … or for this long in wall-clock time, whichever is longer.

function grown(array, length) {
  if (array.length >= length) return array;
  const larger = new array.constructor(Math.max(length, 2 * array.length));
  larger.set(array);
  return larger;
}

export class World {
  constructor() {
    this.scene =
      {name: "", description: "", solids: [], meshes: [], obstacles: [], map: null, paths: []};
    this.live = true;
    this.time = 0;
    this.speed = 1;
    this.pace = 1;
    this.paused = false;
    this.dropped = 0;
    this.selection = null;  // {kind: "tag" | "antenna", index}
    this.onlyAntenna = -1;  // Only reads of this antenna colour the tags; -1: those of all.
    this.newReads = [];     // Indices of tag and antenna, alternating, of reads not flashed yet.
    this.changed = new Set();
    this.taken = new Set();
    this.listeners = [];
    this.#clear();
  }

  #clear() {
    this.tags = [];  // {id, moves, present}
    this.tagIndex = new Map();
    this.position = new Float32Array(0);  // 3 per tag [m, frame W]
    this.strength =
      new Float32Array(0);  // Strongest recent RSSI [dBm], NaN if not read recently
    this.lastRssi = new Float32Array(0);  // Latest RSSI [dBm], NaN if never read
    this.tagRate = new Float32Array(0);   // Recent reads per second
    this.antennas = [];  // As sent by the server, plus present, trail, rate and inSight
    this.antennaIndex = new Map();
    this.robots = new Map();     // name → [x, y, z, qx, qy, qz, qw]
    this.estimates = new Map();  // tag's index → {position, covariance}
    this.scans = [];  // One per robot.
    this.log = new ReadLog(this.live ? LIVE_READS : 0);
    this.counted = 0;  // Number of reads of the log that lastRssi covers.
    this.newReads.length = 0;
    this.seen = new Int32Array(0);
    this.survey_ = 0;
  }

  // Marks what changed; layers and panels are updated at most once per frame.
  touch(...what) {
    for (const one of what) this.changed.add(one);
    for (const listener of this.listeners) listener();
  }

  // Returns what changed since the last call.
  takeChanges() {
    [this.changed, this.taken] = [this.taken, this.changed];
    this.changed.clear();
    return this.taken;
  }

  reset() {
    const selected = this.selectedName();
    this.#clear();
    this.selection = null;
    this.wanted = selected;
    this.touch(
      "scene", "antennas", "tags", "robots", "tags-list", "reads", "estimates", "scans",
      "selection");
  }

  selectedName() {
    if (!this.selection) return null;
    const {kind, index} = this.selection;
    return {kind, name: kind === "tag" ? this.tags[index].id : this.antennas[index].name};
  }

  select(kind, index) {
    this.selection = kind ? {kind, index} : null;
    this.onlyAntenna = kind === "antenna" ? index : -1;
    this.touch("selection", "reads");
  }

  // Restores the selection from before reset(), if that tag or antenna still exists.
  reselect() {
    if (!this.wanted) return;
    const {kind, name} = this.wanted;
    this.wanted = null;
    const index = (kind === "tag" ? this.tagIndex : this.antennaIndex).get(name);
    if (index !== undefined) this.select(kind, index);
  }

  setScene(scene) {
    this.scene = {obstacles: [], meshes: [], paths: [], map: null, ...scene};
    this.touch("scene");
  }

  setAntennas(list) {
    for (const antenna of this.antennas) antenna.present = false;
    for (const given of list) {
      let index = this.antennaIndex.get(given.name);
      if (index === undefined) {
        index = this.antennas.length;
        this.antennaIndex.set(given.name, index);
        this.antennas.push({trail: [], rate: 0, inSight: 0});
      }
      Object.assign(this.antennas[index], given, {present: true});
    }
    this.touch("antennas");
  }

  setTags(list) {
    for (const tag of this.tags) tag.present = false;
    for (const given of list) {
      let index = this.tagIndex.get(given.id);
      if (index === undefined) {
        index = this.tags.length;
        this.tagIndex.set(given.id, index);
        this.tags.push({id: given.id});
      }
      Object.assign(
        this.tags[index], {moves: given.moves, rotation: given.rotation, present: true});
    }
    this.#grow();
    for (const given of list) this.position.set(given.position, 3 * this.tagIndex.get(given.id));
    this.touch("tags", "tags-list");
  }

  #grow() {
    const before = this.lastRssi.length;
    const n = this.tags.length;
    this.position = grown(this.position, 3 * n);
    this.strength = grown(this.strength, n);
    this.lastRssi = grown(this.lastRssi, n);
    this.tagRate = grown(this.tagRate, n);
    this.strength.fill(NaN, before);
    this.lastRssi.fill(NaN, before);
  }

  moveTag(id, x, y, z) {
    const index = this.tagIndex.get(id);
    if (index === undefined) return;
    this.position.set([x, y, z], 3 * index);
    this.changed.add("tags");
  }

  moveAntenna(name, pose) {
    const antenna = this.antennas[this.antennaIndex.get(name)];
    if (!antenna) return;
    antenna.pose = pose;
    this.changed.add("poses");
    if (!this.live) return;
    const {trail} = antenna;
    const last = trail.length - 3;
    const way = last < 0 ?
      Infinity :
      Math.hypot(pose[0] - trail[last], pose[1] - trail[last + 1], pose[2] - trail[last + 2]);
    if (way < 0.02) return;
    trail.push(pose[0], pose[1], pose[2]);
    if (trail.length > 3 * TRAIL) trail.splice(0, 3 * (TRAIL >> 1));
  }

  setEstimate(tag, x, y, z, covariance) {
    const index = this.tagIndex.get(tag);
    if (index !== undefined && x !== null) {
      this.estimates.set(index, {position: [x, y, z], covariance});
    } else if (index !== undefined) {
      this.estimates.delete(index);  // It can no longer be located.
    }
    this.changed.add("estimates");
  }

  addRead(tag, antenna, rssi, phase, t, count) {
    const i = this.tagIndex.get(tag);
    const k = this.antennaIndex.get(antenna);
    if (i === undefined || k === undefined) return;
    this.log.add(t, i, k, rssi, phase, count);
    this.counted = this.log.end;
    this.lastRssi[i] = rssi;
    this.flash(i, k);
    this.changed.add("reads");
  }

  // Queues a read to be shown as a flash; at most a thousand per frame, as nobody would see more.
  flash(tag, antenna) {
    if (this.newReads.length < 2000) this.newReads.push(tag, antenna);
  }

  // How long a read counts as recent [simulated s].
  recent() {
    return Math.max(RECENT_S, this.paused ? 0 : RECENT_REAL_S * Math.max(this.pace || 0, 0));
  }

  // Recent RSSI and read rates, from the log.
  survey() {
    this.#remember();
    const {log, strength, tagRate, seen} = this;
    const n = this.tags.length;
    const m = this.antennas.length;
    strength.fill(NaN, 0, n);
    tagRate.fill(0, 0, n);
    for (const antenna of this.antennas) antenna.rate = antenna.inSight = 0;
    if (seen.length < n * m) this.seen = new Int32Array(2 * n * m);
    ++this.survey_;
    const window = this.recent();
    for (let i = log.end - 1; i >= 0 && log.t[i] > this.time - window; --i) {
      const tag = log.tag[i];
      const antenna = log.antenna[i];
      this.antennas[antenna].rate += log.count[i] / window;
      if (this.seen[tag * m + antenna] !== this.survey_) {
        this.seen[tag * m + antenna] = this.survey_;
        ++this.antennas[antenna].inSight;
      }
      if (this.onlyAntenna >= 0 && antenna !== this.onlyAntenna) continue;
      tagRate[tag] += log.count[i] / window;
      if (!(strength[tag] >= log.rssi[i])) strength[tag] = log.rssi[i];
    }
  }

  // The antenna of the strongest recent read of a tag, or null.
  strongestAntenna(tag) {
    const {log} = this;
    let best = -1;
    for (let i = log.end - 1; i >= 0 && log.t[i] > this.time - this.recent(); --i) {
      if (log.tag[i] === tag && (best < 0 || log.rssi[i] > log.rssi[best])) best = i;
    }
    const antenna = best < 0 ? null : this.antennas[log.antenna[best]];
    return antenna?.present ? antenna : null;
  }

  #remember() {
    if (this.counted > this.log.end) {
      this.lastRssi.fill(NaN);
      this.counted = 0;
    }
    for (; this.counted < this.log.end; ++this.counted) {
      this.lastRssi[this.log.tag[this.counted]] = this.log.rssi[this.counted];
    }
  }
}
