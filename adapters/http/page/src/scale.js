// SPDX-License-Identifier: Apache-2.0
// RSSI range of the colour map: −80 to −40 dBm, widened in steps of 10 dB to the RSSI of live
// reads, or fitted to a recorded run.

const STEP_DB = 10;
const LEAST_DBM = -90;  // Below any reader's sensitivity: one such read must not stretch the range.
const MOST_DBM = 0;

export class Scale {
  constructor() {
    this.low = -80;
    this.high = -40;
  }

  // Fits the range to a run: from its 1st to its 99th percentile.
  fit(rssi) {
    if (!rssi.length) return;
    const sorted = Float32Array.from(rssi).sort();
    const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
    this.low = STEP_DB * Math.floor(at(0.01) / STEP_DB);
    this.high = Math.max(STEP_DB * Math.ceil(at(0.99) / STEP_DB), this.low + 2 * STEP_DB);
  }

  // Widens the range to include a value; returns true if it grew.
  widen(rssi) {
    const [low, high] = [this.low, this.high];
    if (rssi < low) this.low = Math.max(STEP_DB * Math.floor(rssi / STEP_DB), LEAST_DBM);
    if (rssi > high) this.high = Math.min(STEP_DB * Math.ceil(rssi / STEP_DB), MOST_DBM);
    return low !== this.low || high !== this.high;
  }

  share(rssi) {
    return (rssi - this.low) / (this.high - this.low);
  }
}
