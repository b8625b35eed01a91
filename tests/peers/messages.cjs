// A file of messages for the tests of peers: of each its topic, type, time (ns) and bytes.
const fs = require("fs");

function read(path) {
  const data = fs.readFileSync(path);
  const messages = [];
  for (let at = 0; at < data.length; ) {
    const parts = [];
    for (let i = 0; i < 2; ++i) {
      const size = data.readUInt32LE(at);
      parts.push(data.toString("utf8", at + 4, at + 4 + size));
      at += 4 + size;
    }
    const time = data.readBigInt64LE(at);
    const size = data.readUInt32LE(at + 8);
    at += 12;
    messages.push({ topic: parts[0], type: parts[1], time, bytes: data.subarray(at, at + size) });
    at += size;
  }
  return messages;
}

function write(path, messages) {
  const parts = [];
  for (const { topic, type, time, bytes } of messages) {
    for (const text of [Buffer.from(topic), Buffer.from(type)]) {
      const size = Buffer.alloc(4);
      size.writeUInt32LE(text.length);
      parts.push(size, text);
    }
    const head = Buffer.alloc(12);
    head.writeBigInt64LE(time);
    head.writeUInt32LE(bytes.length, 8);
    parts.push(head, bytes);
  }
  fs.writeFileSync(path, Buffer.concat(parts));
}

module.exports = { read, write };
