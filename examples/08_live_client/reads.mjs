// SPDX-License-Identifier: Apache-2.0
// Reads from a live world in JavaScript, with Node.js 18 or later alone:
//
//   tagfield serve scenarios/portal.yaml &
//   node examples/08_live_client/reads.mjs http://127.0.0.1:8080 tag_01
//
// Prints each read of a tag, and how far it has moved away from the antenna according to the phase since the
// previous read on the same antenna and carrier, modulo half a wavelength.
const [server = "http://127.0.0.1:8080", tag = "tag_01", most = "Infinity"] = process.argv.slice(2);
const SPEED_OF_LIGHT = 299792458;
const before = new Map();
let count = 0;

function show(read) {
  const key = `${read.antennaName} ${read.frequency}`;
  const half = SPEED_OF_LIGHT / (read.frequency * 1000) / 2;
  let moved = "";
  if (before.has(key)) {
    const turn = (((read.phaseAngle - before.get(key)) / 360 + 1.5) % 1) - 0.5;
    moved = `moved ${(1000 * turn * half).toFixed(1)} mm, modulo ${(1000 * half).toFixed(0)} mm`;
  }
  before.set(key, read.phaseAngle);
  console.log(read.timestamp, read.antennaName, (read.peakRssiCdbm / 100).toFixed(2), "dBm", moved);
}

const response = await fetch(`${server}/api/reads?tag=${encodeURIComponent(tag)}`);
let rest = "";
for await (const part of response.body.pipeThrough(new TextDecoderStream())) {
  const lines = (rest + part).split("\n");
  rest = lines.pop();
  for (const line of lines) {
    const read = JSON.parse(line);
    if (read.dropped) console.error(`${read.dropped} reads lost: this client is too slow`);
    else show(read);
    if (++count >= Number(most)) process.exit(0);
  }
}
