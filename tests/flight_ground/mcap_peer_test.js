// npm's @mcap/core reads what `saker convert` writes: by index and streamed, with checksums, each message by its schema.
// node mcap_peer_test.js BIN
import assert from "node:assert";
import {execFileSync} from "node:child_process";
import {mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {peers, Schemas} from "./peers.js";

const {McapIndexedReader, McapStreamReader, fzstd, ...others} = peers();
const decompressHandlers = {zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size)))};
const folder = mkdtempSync(`${tmpdir()}/saker_mcap_`);

function madeRun() {
  const out = `${folder}/out`;
  mkdirSync(out);
  let rows = "";
  for (let i = 0; i <= 200; ++i) rows += `${100 + 0.1 * i} ${0.1 * i} 0 3 0 0 0 1\n`;
  writeFileSync(`${out}/trajectory.txt`, rows);
  const objects = Array.from({length: 300}, (_, id) => ({id, class: "vehicle", probability: 0.9, observations: 4, position: [5 * id, 1, 0.8],
    rotation: [0, 0, 0, 1], size: [4.5, 1.8, 1.5]}));
  writeFileSync(`${out}/map.json`, JSON.stringify({frame: "world", objects, ground: []}));
  return out;
}

try {
  const file = `${folder}/a.mcap`;
  execFileSync(`${process.argv[2]}/saker`, ["convert", madeRun(), file, "--set", "site.origin=[47.1, 8.2, 90]"]);
  const bytes = readFileSync(file);
  const readable = {size: async () => BigInt(bytes.length),
                    read: async (at, size) => new Uint8Array(bytes.subarray(Number(at), Number(at + size)))};
  const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
  assert(reader.chunkIndexes.length > 1);
  const schemas = new Schemas(others), counted = new Map();
  let last = 0n;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId), schema = reader.schemasById.get(channel.schemaId);
    assert.strictEqual(schema.encoding, "jsonschema");
    const text = new TextDecoder().decode(message.data);
    assert.strictEqual(schemas.wrong(schema.name, new TextDecoder().decode(schema.data), JSON.parse(text)), "", channel.topic);
    assert(message.logTime >= last);
    last = message.logTime;
    counted.set(channel.topic, (counted.get(channel.topic) ?? 0) + 1);
  }
  for (const topic of ["/R1/objects", "/R1/odometry", "/R1/path", "/R1/scene", "/R1/tf", "/R1/location", "/R1/site"])
    assert(counted.get(topic) > 0, topic);
  for (const [id, count] of reader.statistics.channelMessageCounts)
    assert.strictEqual(Number(count), counted.get(reader.channelsById.get(id).topic) ?? 0);
  const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
  stream.append(bytes);
  let streamed = 0n;
  for (let record; (record = stream.nextRecord());) streamed += record.type === "Message" ? 1n : 0n;
  assert(stream.done());
  assert.strictEqual(streamed, reader.statistics.messageCount);
  console.log(`${counted.size} topics, ${streamed} messages, each as its schema says`);
} finally {
  rmSync(folder, {recursive: true, force: true});
}
