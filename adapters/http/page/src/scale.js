// SPDX-License-Identifier: Apache-2.0
// The range of RSSI that the colours span: −80 to −40 dBm, widened in steps of 10 dB by what is
// read.

const STEP_DB = 10;
const LEAST_DBM = -90;  // No reader hears less; one such read must not squeeze all others together.
const MOST_DBM = 0;

export class Scale {
  constructor() {
    this.low = -80;
    this.high = -40;
  }

  // A run's own range, without its rarest hundredth at either end.
  fit(rssi) {
    if (!rssi.length) return;
    const sorted = Float32Array.from(rssi).sort();
    const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
    this.low = STEP_DB * Math.floor(at(0.01) / STEP_DB);
    this.high = Math.max(STEP_DB * Math.ceil(at(0.99) / STEP_DB), this.low + 2 * STEP_DB);
  }

  // True where the range grew.
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
