// read_mcap.cjs MCAP MESSAGES: the messages of an MCAP file by @mcap/core, as far as it goes.
const fs = require("fs");
const { McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");
const messages = require("./messages.cjs");

async function main() {
  const reader = new McapStreamReader({ decompressHandlers: await loadDecompressHandlers() });
  reader.append(fs.readFileSync(process.argv[2]));
  const schemas = new Map(), channels = new Map(), found = [];
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record.name.replace("/msg/", "/"));
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    found.push({ topic: channel.topic, type: schemas.get(channel.schemaId), time: record.logTime, bytes: Buffer.from(record.data) });
  }
  messages.write(process.argv[3], found);
}

main();
