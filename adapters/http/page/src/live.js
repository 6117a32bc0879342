// SPDX-License-Identifier: Apache-2.0
// Client of a live server: fetches the world, follows its frames, sends commands and reconnects
// automatically.

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 5000;
const SETTLED_MS = 400;

async function json(response) {
  const text = await response.text();
  let value = null;
  try {
    value = JSON.parse(text);
  } catch {
    // Not an answer of our API: reported below.
  }
  if (!response.ok)
    throw new Error(value?.error ?? `the server answers ${response.status} ${response.statusText}`);
  if (value === null) throw new Error("the server's answer is not JSON");
  return value;
}

export const get = async (path) => json(await fetch(`api/${path}`, {cache: "no-store"}));

export class Live {
  // say(state, word): sets the status line; state is "connecting", "connected" or "away".
  constructor(world, say) {
    this.world = world;
    this.say = say;
    this.wait = FIRST_WAIT_MS;
    this.token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";
  }

  // Opens the socket first and then fetches the world: frames that arrive meanwhile are kept and
  // applied afterwards, as the world may have changed since one of its parts was answered.
  start() {
    this.say("connecting", "connecting …");
    const address = new URL("api/live", location.href);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    this.loaded = false;
    this.early = [];
    this.frameTime = -Infinity;
    const socket = new WebSocket(address);
    socket.onopen = () => this.#opened(socket);
    socket.onmessage = (event) => this.#received(JSON.parse(event.data));
    socket.onclose = () => this.#again();
  }

  async #opened(socket) {
    try {
      await this.#fetchAll();
    } catch {
      socket.close();
      return;
    }
    this.loaded = true;
    // Without their reads, which the world's counts already contain.
    for (const frame of this.early.splice(0)) this.#apply({...frame, reads: []});
    this.wait = FIRST_WAIT_MS;
    this.say("connected", "");
  }

  #received(frame) {
    if (this.loaded)
      this.#frame(frame);
    else
      this.early.push(frame);
  }

  async #fetchAll() {
    const [scene, antennas, tags, status] =
      await Promise.all(["scene", "antennas", "tags", "status"].map(get));
    this.world.reset();
    this.world.setScene(scene);
    this.world.setAntennas(antennas.antennas);
    this.world.setTags(tags.tags);
    this.world.reselect();
    this.#status(status);
  }

  #status(status) {
    Object.assign(this.world, {
      time: status.time,
      speed: status.speed,
      pace: status.pace,
      paused: status.paused,
      version: status.version
    });
    this.world.touch("time");
  }

  #again() {
    this.loaded = false;
    this.say("away", "The server is away; trying again");
    setTimeout(() => this.start(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
  }

  // A world that does not change is not redrawn.
  #isNews(frame) {
    const {world} = this;
    return (
      frame.time !== world.time || frame.reads?.length || frame.tags?.length ||
      frame.estimates?.length || frame.changed ||
      (frame.robots?.length ?? 0) !== world.robots.size);
  }

  #frame(frame) {
    const {world} = this;
    const isNews = this.#isNews(frame);
    const says = frame.paused !== world.paused || frame.speed !== world.speed;
    // Compared with frames only: a command's answer may overtake frames sent before it.
    if (frame.time < this.frameTime - 1e-9) this.#fetchAll().catch(() => {});
    this.frameTime = frame.time;
    Object.assign(world, {
      time: frame.time,
      pace: frame.pace,
      paused: frame.paused,
      speed: frame.speed,
      dropped: frame.dropped ?? 0
    });
    if (isNews)
      this.#apply(frame);
    else if (says)
      world.touch("time");
  }

  #apply(frame) {
    const {world} = this;
    for (const [name, ...pose] of frame.robots ?? []) {
      world.robots.set(name, pose);
      world.changed.add("robots");
    }
    for (const [name, ...pose] of frame.antennas ?? []) world.moveAntenna(name, pose);
    for (const [id, x, y, z] of frame.tags ?? []) world.moveTag(id, x, y, z);
    for (const [tag, antenna, rssi, phase, , t, count] of frame.reads ?? []) {
      world.addRead(tag, antenna, rssi, phase, t, count ?? 1);
    }
    for (const [tag, x, y, z, covariance] of frame.estimates ?? []) {
      world.setEstimate(tag, x, y, z, covariance);
    }
    if (frame.scans) {
      world.scans = frame.scans;
      world.changed.add("scans");
    }
    if (frame.changed) this.#refetch();
    world.touch("time", "reads");
  }

  async #refetch() {
    try {
      const [scene, antennas, tags] = await Promise.all(["scene", "antennas", "tags"].map(get));
      this.world.setScene(scene);
      this.world.setAntennas(antennas.antennas);
      this.world.setTags(tags.tags);
      this.world.touch("reads", "selection");
    } catch {
      // The close event of the socket will report that the server is away.
    }
  }

  async send(method, path, body) {
    const headers = body === undefined ? {} : {"Content-Type": "application/json"};
    if (this.token) headers.Authorization = `Bearer ${this.token}`;
    const status = await json(await fetch(
      `api/${path}`,
      {method, headers, body: body === undefined ? undefined : JSON.stringify(body)}));
    if (status?.time !== undefined) this.#status(status);
    this.world.touch("commanded");
    // A step takes a while, and nothing else reports its end.
    if (path === "step")
      setTimeout(() => get("status").then((one) => this.#status(one), () => {}), SETTLED_MS);
  }
}
