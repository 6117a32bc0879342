// SPDX-License-Identifier: Apache-2.0
// Reads and writes MCAP files with @mcap/core, whose packages are in PACKAGES/node_modules:
//
//   node others.mjs PACKAGES read FILE                 what its two readers find, as JSON
//   node others.mjs PACKAGES query FILE TOPIC FROM TO  messages of a topic in a time range, by the index
//   node others.mjs PACKAGES decode FILE               messages of each topic by their ROS 2 schemas, as JSON
//   node others.mjs PACKAGES write FILE none|zstd|flat writes a file with its writer; flat: without chunks
//
// Exits with code 1 and a line on standard error if a reader rejects the file.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [packages, verb, file, ...words] = process.argv.slice(2);
const require = createRequire(path.resolve(packages, "package.json"));
const { McapIndexedReader, McapStreamReader, McapWriter } = require("@mcap/core");
const { crc32 } = require("@foxglove/crc");
const lz4 = require("@foxglove/wasm-lz4");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const zstd = require("@foxglove/wasm-zstd");

const decompressHandlers = {
  lz4: (bytes, size) => lz4(bytes, Number(size)),
  zstd: (bytes, size) => zstd.decompress(bytes, Number(size)),
};

function fileAsReadable(bytes) {
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => {
      const end = Number(offset + length);
      if (end > bytes.length) throw new Error(`read beyond the end: ${end} of ${bytes.length}`);
      return new Uint8Array(bytes.subarray(Number(offset), end));
    },
  };
}

function indexedReader(bytes) {
  return McapIndexedReader.Initialize({ readable: fileAsReadable(bytes), decompressHandlers });
}

const asText = (bytes) => Buffer.from(bytes).toString("utf8");
const asMessage = (message) => [
  message.channelId, message.sequence, String(message.logTime), String(message.publishTime),
  Buffer.from(message.data).toString("hex")];
const asChannel = (channel) => ({
  id: channel.id, schema: channel.schemaId, topic: channel.topic,
  encoding: channel.messageEncoding, metadata: Object.fromEntries(channel.metadata) });
const asSchema = (schema) => ({
  id: schema.id, name: schema.name, encoding: schema.encoding, text: asText(schema.data) });

async function collect(messages) {
  const found = [];
  for await (const message of messages) found.push(asMessage(message));
  return found;
}

async function byIndex(bytes) {
  const reader = await indexedReader(bytes);
  const { statistics } = reader;
  return {
    profile: reader.header.profile,
    library: reader.header.library,
    channels: [...reader.channelsById.values()].map(asChannel),
    schemas: [...reader.schemasById.values()].map(asSchema),
    messages: await collect(reader.readMessages()),
    backward: await collect(reader.readMessages({ reverse: true })),
    chunks: reader.chunkIndexes.length,
    compressions: [...new Set(reader.chunkIndexes.map((index) => index.compression))],
    counts: Object.fromEntries(
      [...statistics.channelMessageCounts].map(([id, count]) => [id, Number(count)])),
    statistics: {
      messages: Number(statistics.messageCount), schemas: statistics.schemaCount,
      channels: statistics.channelCount, chunks: statistics.chunkCount,
      from: String(statistics.messageStartTime), to: String(statistics.messageEndTime) },
    summaryOffsets: [...reader.summaryOffsetsByOpcode.keys()],
  };
}

// A stream arrives in pieces of any size.
function byStream(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, includeChunks: true });
  const messages = [];
  const kinds = {};
  let isRightData = false;
  for (let at = 0; at < bytes.length; at += 1000) {
    reader.append(bytes.subarray(at, at + 1000));
    for (let record; (record = reader.nextRecord()); ) {
      kinds[record.type] = (kinds[record.type] ?? 0) + 1;
      if (record.type === "Message") messages.push(asMessage(record));
      if (record.type === "DataEnd") isRightData = dataCrc(bytes, record.dataSectionCrc);
    }
  }
  return { done: reader.done(), left: reader.bytesRemaining(), messages, kinds, isRightData };
}

// The reader does not verify this CRC. Its record is the last one before the summary.
function dataCrc(bytes, expected) {
  const footer = bytes.length - 8 - 29;
  const end = Number(bytes.readBigUInt64LE(footer + 9)) - 13;
  return expected !== 0 && crc32(bytes.subarray(0, end)) === expected;
}

// Converts values that JSON does not have: typed arrays, bigints, NaN and infinities.
const asJson = (key, value) => (ArrayBuffer.isView(value) ? [...value] : typeof value === "bigint"
  ? Number(value) : typeof value === "number" && !Number.isFinite(value) ? String(value) : value);

async function decode(bytes) {
  const reader = await indexedReader(bytes);
  const decoders = new Map();
  const topics = {};
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    decoders.set(channel.id, new MessageReader(parse(asText(schema.data), { ros2: true })));
    topics[channel.topic] = { type: schema.name, metadata: Object.fromEntries(channel.metadata),
                              messages: [] };
  }
  for await (const message of reader.readMessages()) {
    const { topic } = reader.channelsById.get(message.channelId);
    topics[topic].messages.push(decoders.get(message.channelId).readMessage(message.data));
  }
  return topics;
}

async function write(kind) {
  const out = fs.openSync(file, "w");
  let position = 0n;
  const writable = {
    write: async (bytes) => { position += BigInt(fs.writeSync(out, bytes)); },
    position: () => position,
  };
  const compressChunk = kind !== "zstd" ? undefined
    : (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes) });
  const writer = new McapWriter({ writable, compressChunk, useChunks: kind !== "flat", chunkSize: 500 });
  await writer.start({ profile: "ros2", library: "another" });
  const data = Buffer.from("string data\n");
  const schemaId = await writer.registerSchema({ name: "std_msgs/msg/String", encoding: "ros2msg", data });
  const ids = [];
  for (const topic of ["/a", "/b"]) {
    ids.push(await writer.registerChannel(
      { schemaId, topic, messageEncoding: "cdr", metadata: new Map([["key", topic]]) }));
  }
  await writer.addAttachment(
    { name: "note", logTime: 1n, createTime: 1n, mediaType: "text/plain", data: Buffer.from("hello") });
  for (let i = 0; i < 100; ++i) {
    await writer.addMessage({ channelId: ids[i % 2], sequence: i, logTime: BigInt((i * 37) % 100),
                              publishTime: BigInt(i), data: Buffer.alloc(i, i) });
  }
  await writer.addMetadata({ name: "more", metadata: new Map([["key", "value"]]) });
  await writer.end();
  fs.closeSync(out);
}

async function main() {
  await Promise.all([lz4.isLoaded, zstd.isLoaded]);
  if (verb === "write") return write(words[0]);
  const bytes = fs.readFileSync(file);
  if (verb === "decode") return decode(bytes);
  if (verb === "read") return { index: await byIndex(bytes), stream: byStream(bytes) };
  const [topic, from, to] = words;
  const reader = await indexedReader(bytes);
  return collect(reader.readMessages(
    { topics: [topic], startTime: BigInt(from), endTime: BigInt(to) }));
}

main().then((found) => found && console.log(JSON.stringify(found, asJson)), (error) => {
  console.error(error.message);
  process.exitCode = 1;
});
