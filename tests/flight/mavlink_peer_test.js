// An independent decoder reads our stream: npm's node-mavlink. node mavlink_peer_test.js STREAM, where STREAM is the program that
// writes it (mavlink_stream.cc). Without node-mavlink (NODE_PATH) it is skipped with status 77.
const { execFileSync } = require('child_process');
const { Readable } = require('stream');
const assert = require('assert');

let peer, mappings;
try {
  peer = require('node-mavlink');
  mappings = require('mavlink-mappings');
} catch {
  console.log('skipped: npm\'s node-mavlink is not there (scripts/setup --peers)');
  process.exit(77);
}

const MESSAGES = 27;
const registry = { ...mappings.minimal.REGISTRY, ...mappings.common.REGISTRY, ...mappings.ardupilotmega.REGISTRY };
const key = Buffer.from(Array.from({ length: 32 }, (_, i) => i));

function packets(bytes) {
  return new Promise((done, fail) => {
    const found = [];
    const splitter = new peer.MavLinkPacketSplitter();
    const parser = new peer.MavLinkPacketParser();
    Readable.from([bytes]).pipe(splitter).pipe(parser);
    parser.on('data', packet => found.push(packet));
    parser.on('end', () => done(found));
    parser.on('error', fail);
  });
}

// The values of a message in the order on the wire; a text is its characters.
function values(message, type) {
  return [...type.FIELDS].sort((a, b) => a.offset - b.offset).flatMap(field => {
    const value = message[field.name];
    if (typeof value === 'string') return [...value].map(c => c.charCodeAt(0));
    return [value].flat().map(Number);
  });
}

async function check(signed) {
  const bytes = execFileSync(process.argv[2], signed ? ['signed'] : []);
  const found = await packets(bytes);
  assert.strictEqual(found.length, MESSAGES);
  for (const packet of found) {
    const type = registry[packet.header.msgid];
    const message = packet.protocol.data(packet.payload, type);
    const got = values(message, type);
    const expected = got.map((_, k) => (7 * k + type.MSG_ID) % 100 + 1);
    assert.deepStrictEqual(got, expected, type.MSG_NAME);
    assert.strictEqual(packet.signature !== null, signed);
    if (signed) assert(packet.signature.matches(key), type.MSG_NAME);
  }
  console.log(`${found.length} messages, ${signed ? 'signed' : 'not signed'}: equal`);
}

check(false).then(() => check(true)).catch(error => { console.error(error); process.exit(1); });
