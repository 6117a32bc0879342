// SPDX-License-Identifier: Apache-2.0
// Colours of materials and antennas, and for RSSI and margins one perceptually uniform colour map,
// whose order is also visible with red-green colour blindness.

const MATERIALS = {
  metal: "#7d8b99",
  wood: "#b08352",
  plywood: "#c09a68",
  chipboard: "#c9a878",
  cardboard: "#c8a06a",
  concrete: "#a9a8a2",
  brick: "#a8604c",
  marble: "#c9c6c0",
  glass: "#8fc7d8",
  plasterboard: "#d8d2c4",
  ceiling_board: "#d5d5cf",
  floorboard: "#a97d50",
  water: "#5b93c9",
  plastic: "#6f9fb5"
};
const ANTENNAS =
  ["#2f7ed8", "#d9662b", "#1c9c6b", "#a855c9", "#c2a413", "#d64583", "#16a3b8", "#8a6d4b"];
// viridis (S. van der Walt and N. Smith, 2015) from 0.2 to 1 in steps of 0.1.
const VIRIDIS = [
  [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140], [34, 168, 132], [68, 191, 112],
  [122, 209, 81], [189, 223, 38], [253, 231, 37]
];
const LEAST_OPACITY = 0.7;

function hue(name) {
  let hash = 2166136261;
  for (let i = 0; i < name.length; ++i) hash = Math.imul(hash ^ name.charCodeAt(i), 16777619);
  return (hash >>> 0) % 360;
}

// Colour of a solid: that of a known material, else a hue from the name of its material or model.
export function solidColor({name, material}) {
  return MATERIALS[material] ?? `hsl(${hue(material || name.split("::")[0])}, 22%, 62%)`;
}

export const isTransparent = (solid) => solid.material === "glass";

export const antennaColor = (index) => ANTENNAS[index % ANTENNAS.length];

// RSSI's colour map: low dark blue, medium green, high yellow; the weaker, the more transparent.
// u from 0 (weak) to 1 (strong); writes [r, g, b, opacity], each 0 … 1.
export function rssiColor(u, out, at) {
  const v = Math.min(Math.max(u, 0), 1);
  const stop = Math.min(Math.floor(v * (VIRIDIS.length - 1)), VIRIDIS.length - 2);
  const share = v * (VIRIDIS.length - 1) - stop;
  const from = VIRIDIS[stop];
  const to = VIRIDIS[stop + 1];
  for (let k = 0; k < 3; ++k) out[at + k] = (from[k] + (to[k] - from[k]) * share) / 255;
  out[at + 3] = LEAST_OPACITY + (1 - LEAST_OPACITY) * v;
}

export function rssiCss(u) {
  const c = [0, 0, 0, 0];
  rssiColor(u, c, 0);
  return `rgb(${c.slice(0, 3).map((part) => Math.round(255 * part)).join(" ")} / ${
    c[3].toFixed(2)})`;
}

// Steps of the coverage legend: lower bound of the margin [dB], [r, g, b, a] in bytes, text.
export const MARGINS = [
  [-Infinity, [72, 36, 117, 150], "not read"],
  [-3, [59, 81, 139, 190], "−3 to 0 dB: just not read"],
  [0, [34, 168, 132, 205], "0 to 3 dB: at the edge"], [3, [122, 209, 81, 205], "3 to 10 dB"],
  [10, [253, 231, 37, 205], "over 10 dB"]
];

export function marginColor(margin) {
  for (let i = MARGINS.length - 1; i >= 0; --i)
    if (margin >= MARGINS[i][0]) return MARGINS[i][1];
  return MARGINS[0][1];
}

// Index of the band between ascending edges that contains a value.
export function bandOf(edges, value) {
  let band = 0;
  while (band < edges.length && value >= edges[band]) ++band;
  return band;
}

// Colour of a band; grey for one without its own colour, such as that of tags hardly ever read.
export const bandColor = (color) => color || "#8a949e";
