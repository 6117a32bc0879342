// SPDX-License-Identifier: Apache-2.0
// Playback of a recorded run: seeks to any time, forwards or backwards.

import {ReadLog} from "./reads.js";

function indexAt(times, t) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

// Interpolates between samples: positions linearly, quaternions linearly and normalized (nlerp), as
// samples are close.
function poseAt(samples, poses, t) {
  const i = indexAt(samples, t);
  const j = Math.min(i + 1, samples.length - 1);
  const step = samples[j] - samples[i];
  const u = step > 0 ? Math.min(Math.max((t - samples[i]) / step, 0), 1) : 0;
  const [a, b] = [poses[i], poses[j]];
  const dot = a.length < 7 ? 1 : a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6];
  const pose = a.map((value, k) => value * (1 - u) + (k > 2 && dot < 0 ? -b[k] : b[k]) * u);
  const norm = Math.hypot(...pose.slice(3)) || 1;
  return pose.map((value, k) => (k > 2 ? value / norm : value));
}

export class Recording {
  constructor(world, run) {
    this.world = world;
    this.run = run;
    world.live = false;
    world.reset();
    world.setScene(run.scene);
    world.setAntennas(run.antennas);
    world.setTags(run.tags);
    world.log = ReadLog.of(run.reads);
    for (const [name, {pose}] of Object.entries(run.antenna_poses ?? {})) {
      const antenna = world.antennas[world.antennaIndex.get(name)];
      if (antenna) antenna.trail = pose.flatMap((one) => one.slice(0, 3));
    }
    for (const [tag, x, y, z, covariance] of run.estimates ?? []) {
      world.setEstimate(tag, x, y, z, covariance);
    }
    [this.first, this.last] = run.duration;
    world.paused = true;
    this.seek(this.first);
  }

  seek(t) {
    const {world, run} = this;
    const before = world.log.end;
    const forward = t >= world.time;
    world.time = Math.min(Math.max(t, this.first), this.last);
    for (const [name, track] of Object.entries(run.antenna_poses ?? {})) {
      world.moveAntenna(name, poseAt(track.t, track.pose, world.time));
    }
    for (const [name, track] of Object.entries(run.robot_poses ?? {})) {
      world.robots.set(name, poseAt(track.t, track.pose, world.time));
      world.changed.add("robots");
    }
    for (const [id, track] of Object.entries(run.tag_positions ?? {})) {
      world.moveTag(id, ...poseAt(track.t, track.p, world.time));
    }
    world.log.end = world.log.after(world.time, world.log.capacity);
    world.newReads.length = 0;
    if (forward && !world.paused) {
      for (let i = Math.max(before, world.log.end - 500); i < world.log.end; ++i) {
        world.flash(world.log.tag[i], world.log.antenna[i]);
      }
    }
    world.touch("time", "reads");
  }

  play(on) {
    if (on && this.world.time >= this.last) this.seek(this.first);
    this.world.paused = !on;
    this.world.touch("time");
  }

  // Called before each frame while playing, with the time since the last one [s].
  advance(elapsed) {
    this.world.pace = this.world.speed;
    this.seek(this.world.time + elapsed * this.world.speed);
    if (this.world.time >= this.last) this.play(false);
  }
}
