// SPDX-License-Identifier: Apache-2.0
// What is known of the world at one moment, wherever it came from: a server that goes on, or a
// recorded run. Tags and antennas keep their index for as long as the page is open; one that is
// gone is marked as absent, so that reads of it still point to something.

import {ReadLog} from "./reads.js";

const LIVE_READS = 1 << 18;
const TRAIL = 2000;         // Places of a moving antenna that are kept [1].
const RECENT_S = 2;         // A tag counts as read for this long [simulated s] …
const RECENT_REAL_S = 0.5;  // … or for this long on the wall's clock, whichever is longer.

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
    this.onlyAntenna = -1;  // Reads of this antenna alone colour the tags; -1: of all.
    this.newReads = [];     // Tag and antenna in turn, of reads not flashed yet.
    this.changed = new Set();
    this.taken = new Set();
    this.listeners = [];
    this.#clear();
  }

  #clear() {
    this.tags = [];  // {id, moves, present}
    this.tagIndex = new Map();
    this.position = new Float32Array(0);  // 3 a tag [m, frame W]
    this.strength =
      new Float32Array(0);  // Strongest RSSI of late [dBm], NaN where not read of late
    this.lastRssi = new Float32Array(0);  // Last RSSI ever [dBm], NaN where never read
    this.tagRate = new Float32Array(0);   // Reads a second
    this.antennas = [];  // As the server gives them, and pose, present, trail, rate, inSight
    this.antennaIndex = new Map();
    this.robots = new Map();     // name → [x, y, z, qx, qy, qz, qw]
    this.estimates = new Map();  // tag's index → {position, covariance}
    this.scans = [];  // One a robot.
    this.log = new ReadLog(this.live ? LIVE_READS : 0);
    this.counted = 0;  // Reads of the log that are in lastRssi.
    this.newReads.length = 0;
    this.seen = new Int32Array(0);
    this.survey_ = 0;
  }

  // Layers and panels are told what changed, at most once a frame.
  touch(...what) {
    for (const one of what) this.changed.add(one);
    for (const listener of this.listeners) listener();
  }

  // What changed since the last call.
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

  // What was selected before everything was fetched anew, if it is still there.
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
      this.estimates.delete(index);  // Where it is can't be told any more.
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

  // A read that is to be seen as a flash; beyond a thousand a frame nobody sees one more.
  flash(tag, antenna) {
    if (this.newReads.length < 2000) this.newReads.push(tag, antenna);
  }

  // How far back reads count as of late [simulated s].
  recent() {
    return Math.max(RECENT_S, this.paused ? 0 : RECENT_REAL_S * Math.max(this.pace || 0, 0));
  }

  // Strength and rates of the last moments, from the log.
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

  // The antenna that reads a tag strongest of late, or null.
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
