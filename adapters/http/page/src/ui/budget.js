// SPDX-License-Identifier: Apache-2.0
// The answer of `explain` as HTML: the verdict, the link budget as a waterfall chart, the figures
// at the reader, and the strongest paths.

import {h, fixed, signed} from "../dom.js";

const MOST_PATHS = 8;
const db = (value) => (value === null || value === undefined ? "none" : `${signed(value)} dB`);
const dbm = (value) => (value === null || value === undefined ? "none" : `${fixed(value)} dBm`);

// Levels before and after each line; a line of null (no power left) sets the level to −∞.
function levels(lines) {
  const all = [];
  let level = 0;
  for (const line of lines) {
    const before = level;
    level = line.db === null ? -Infinity : level + line.db;
    all.push([before, level]);
  }
  return all;
}

function bar(from, to, low, high, first, needed) {
  const share = (value) => Math.min(Math.max((100 * (value - low)) / (high - low), 0), 100);
  const start = first ? 0 : Math.min(share(from), share(to));
  const end = first ? share(to) : Math.max(share(from), share(to));
  const stripe = h("i", {class: first ? "" : to < from ? "loss" : "gain"});
  stripe.style.left = `${start}%`;
  stripe.style.width = `${end - start}%`;
  const mark = h("b");
  mark.style.left = `calc(${share(needed)}% - 1px)`;
  return h("div", {class: "fall", "aria-hidden": "true"}, stripe, mark);
}

function waterfall(title, lines, sum, needed, needs, margin) {
  const all = levels(lines);
  const finite = all.flat().filter((value, i) => i > 0 && Number.isFinite(value));
  const low = Math.min(...finite, needed) - 4;
  const high = Math.max(...finite, needed) + 2;
  const row = (name, value, last, kind) =>
    h("tr", {class: kind}, h("th", {scope: "row", text: name}),
      h("td", {class: "number", text: value}), h("td", {}, last));
  return h(
    "table", {}, h("caption", {text: title}),
    h("tbody", {},
      ...lines.map(
        (line, i) => row(
          line.what, i === 0 ? dbm(line.db) : db(line.db),
          bar(...all[i], low, high, i === 0, needed))),
      row(sum.what, dbm(sum.dbm), bar(0, sum.dbm ?? -Infinity, low, high, true, needed), "sum"),
      row(needs, dbm(needed), null), row("margin", db(margin), null, "sum")));
}

function pathText(path) {
  const met = [
    ...path.by_way_of.map((at) => `off ${at.object} (${at.material})`),
    ...(path.around ? [`around ${path.around.object}`] : []),
    ...path.through.map((at) => `through ${at.object} (${at.material})`)
  ];
  const way = met.length ? met.join(", ") : "direct";
  return path.blocked ? `${way}: blocked` : way;
}

function pathTable(paths) {
  const strongest = [...paths]
                      .sort((a, b) => (b.relative_db ?? -999) - (a.relative_db ?? -999))
                      .slice(0, MOST_PATHS);
  const blocked = paths.filter((path) => path.blocked).length;
  return h(
    "table", {}, h("caption", {
      text: `Paths: ${paths.length}${blocked ? `, ${blocked} of them blocked` : ""}` +
        (paths.length > MOST_PATHS ? `; the ${MOST_PATHS} strongest` : "")
    }),
    h("tbody", {},
      ...strongest.map(
        (path) =>
          h("tr", {}, h("td", {class: "number", text: db(path.relative_db)}),
            h("td", {class: "number", text: `${fixed(path.length_m, 2)} m`}),
            h("th", {scope: "row", text: pathText(path)})))));
}

function facts(pairs) {
  return h(
    "dl", {class: "facts"},
    ...pairs.flatMap(([name, value]) => [h("dt", {text: name}), h("dd", {text: value})]));
}

function physical(link) {
  const atReader = [
    ["signal to noise", `${signed(link.snr_db ?? NaN)} dB`],
    [
      "phase", `${fixed(link.phase_rad, 3)} rad ± ${fixed(link.phase_sigma_rad, 3)} rad (one sigma)`
    ],
    ["carrier", `${fixed(link.frequency_hz / 1e6, 3)} MHz, channel ${link.channel + 1}`]
  ];
  if (link.decode_probability !== undefined) {
    atReader.push(["replies that come through", `${fixed(100 * link.decode_probability)} %`]);
  }
  const interference = link.interference;
  if (interference?.by.length) {
    atReader.push([
      "over noise and interference",
      `${db(interference.sinr_db)}, ${db(interference.required_sinr_db)} needed`
    ]);
  }
  return [
    waterfall(
      "To the tag", link.to_tag, {what: "power at the chip", dbm: link.tag_dbm},
      link.tag_sensitivity_dbm, "the chip needs", link.tag_margin_db),
    waterfall(
      "Back to the reader", link.to_reader, {what: "power at the reader", dbm: link.reply_dbm},
      link.reader_sensitivity_dbm, "the reader needs", link.reader_margin_db),
    h("h3", {text: "At the reader"}), facts(atReader),
    link.near_tags?.length ? h("p", {
      class: "note",
      text: `Tags nearby: ${
        link.near_tags
          .map(
            (near) => `${near.tag} at ${fixed(near.distance_m, 2)} m (${db(near.alone_db)} alone)`)
          .join(", ")}`
    }) :
                             null,
    pathTable(link.paths), h("p", {
      class: "note",
      text: "Lines are the unblocked paths, the stronger the darker, and the direct path; " +
        "it is dashed where it is blocked."
    })
  ];
}

function paper(link) {
  return [facts([
    ["distance", `${fixed(link.distance_m, 2)} m`], ["range", `${fixed(link.range_m, 2)} m`],
    ["range in this update", `${fixed(link.perturbed_range_m, 2)} m`],
    ["read in", `${fixed(100 * link.read_probability)} % of the updates`],
    ["mean RSSI", dbm(link.rssi_dbm)], ["mean phase", `${fixed(link.phase_rad, 3)} rad`]
  ])];
}

export function budget(link) {
  return [
    h("p", {
      class: "verdict",
      "data-read": link.read                         ? "yes" :
        link.verdict.startsWith("not read just now") ? "soon" :
                                                       "no",
      text: link.verdict
    }),
    ...(link.model === "paper" ? paper(link) : physical(link)).filter(Boolean),
    ...(link.warnings ?? []).map((warning) => h("p", {class: "note", text: warning}))
  ];
}
