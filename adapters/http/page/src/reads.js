// SPDX-License-Identifier: Apache-2.0
// Reads in the order of arrival, in columns. A live log drops its older half when it is full; a
// recorded one contains the complete run and shows it up to `end`.

const FIELDS = {
  t: Float64Array,
  tag: Int32Array,
  antenna: Int16Array,
  rssi: Float32Array,
  phase: Float32Array,
  count: Uint16Array
};

export class ReadLog {
  constructor(capacity) {
    this.end = 0;
    this.capacity = capacity;
    for (const [name, Type] of Object.entries(FIELDS)) this[name] = new Type(capacity);
  }

  // From the columns of a recorded run; nothing is shown until `end` is moved.
  static of(columns) {
    const log = new ReadLog(columns.t.length);
    for (const name of ["t", "tag", "antenna", "rssi", "phase"]) log[name].set(columns[name]);
    log.count.fill(1);
    return log;
  }

  add(t, tag, antenna, rssi, phase, count) {
    if (this.end === this.capacity) this.#dropOlderHalf();
    const i = this.end++;
    this.t[i] = t;
    this.tag[i] = tag;
    this.antenna[i] = antenna;
    this.rssi[i] = rssi;
    this.phase[i] = phase;
    this.count[i] = Math.min(count, 65535);
  }

  #dropOlderHalf() {
    const half = this.capacity >> 1;
    for (const name of Object.keys(FIELDS)) this[name].copyWithin(0, half);
    this.end -= half;
  }

  // Index of the first read later than `time` among the first `end`; `end` if there is none.
  after(time, end = this.end) {
    let low = 0;
    let high = end;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] <= time)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
}
