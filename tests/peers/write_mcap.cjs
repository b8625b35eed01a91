// write_mcap.cjs MESSAGES MCAP none|lz4|zstd summary|plain: an MCAP file by @mcap/core; "plain" has no summary and no indices.
const fs = require("fs");
const path = require("path");
const { execFileSync } = require("child_process");
const { McapWriter } = require("@mcap/core");
const zstd = require("@foxglove/wasm-zstd");
const messages = require("./messages.cjs");

const [, , from, to, compression, kind] = process.argv;

function compressed(bytes) {
  if (compression === "zstd") return zstd.compress(bytes);
  return execFileSync("/usr/bin/python3", ["-B", path.join(__dirname, "lz4_frame.py")], { input: bytes, maxBuffer: 1 << 28 });
}

async function main() {
  await zstd.isLoaded;
  const parts = [];
  let written = 0n;
  const writable = {
    position: () => written,
    write: async (bytes) => {
      parts.push(Buffer.from(bytes));
      written += BigInt(bytes.length);
    },
  };
  const indexed = kind === "summary";
  const writer = new McapWriter({
    writable, chunkSize: 20000, useStatistics: indexed, useSummaryOffsets: indexed, repeatSchemas: indexed, repeatChannels: indexed,
    useMessageIndex: indexed, useChunkIndex: indexed, useAttachmentIndex: indexed, useMetadataIndex: indexed,
    compressChunk: compression === "none" ? undefined : (bytes) => ({ compression, compressedData: compressed(bytes) }),
  });
  await writer.start({ profile: "ros2", library: "peers" });
  const channels = new Map();
  let sequence = 0;
  for (const { topic, type, time, bytes } of messages.read(from)) {
    if (!channels.has(topic)) {
      const schemaId = await writer.registerSchema({ name: type.replace("/", "/msg/"), encoding: "ros2msg", data: new Uint8Array() });
      channels.set(topic, await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(topic), sequence: sequence++, logTime: time, publishTime: time, data: bytes });
  }
  await writer.end();
  fs.writeFileSync(to, Buffer.concat(parts));
}

main();
