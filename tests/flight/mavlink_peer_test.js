// An independent peer: npm's node-mavlink reads our stream and we read its. node mavlink_peer_test.js STREAM, where STREAM is our
// end (mavlink_stream.cc). Every message, with any, the least and the greatest values, signed and not. Without node-mavlink
// (NODE_PATH) it is skipped with status 77.
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
const ours = (...words) => execFileSync(process.argv[2], words);

const FLOAT = 2 ** 128 - 2 ** 104;
const LIMITS = { float: [-FLOAT, FLOAT], double: [-Number.MAX_VALUE, Number.MAX_VALUE], char: [128, 127] };  // of signed characters

function limits(type) {
  if (LIMITS[type]) return LIMITS[type];
  const [, unsigned, bits] = type.match(/^(u?)int(\d+)_t/);
  const least = unsigned ? 0n : -(2n ** BigInt(bits - 1)), greatest = 2n ** BigInt(unsigned ? bits : bits - 1) - 1n;
  return bits === '64' ? [least, greatest] : [Number(least), Number(greatest)];
}

// The k-th value of a message; 64 bits are BigInt.
function expected(type, how, k, id) {
  const scalar = type.replace('[]', '');
  if (how !== 'any') return limits(scalar)[how === 'least' ? 0 : 1];
  const value = (7 * k + id) % 100 + 1;
  return /int64/.test(scalar) ? BigInt(value) : value;
}

const inOrder = type => [...type.FIELDS].sort((a, b) => a.offset - b.offset);
const isArray = field => field.type.endsWith('[]');

// All values that a message has to have, in the order on the wire.
function expectedValues(type, how) {
  let k = 0;
  return inOrder(type).flatMap(field => Array.from({ length: isArray(field) ? field.length : 1 },
    () => expected(field.type, how, k++, type.MSG_ID)));
}

// The values of a message in the order on the wire; a text is its characters.
function values(message, type) {
  return inOrder(type).flatMap(field => {
    const value = message[field.name];
    return typeof value === 'string' ? [...value].map(c => c.charCodeAt(0)) : [value].flat();
  });
}

function packets(bytes) {
  return new Promise((done, fail) => {
    const found = [];
    const splitter = new peer.MavLinkPacketSplitter();
    const parser = new peer.MavLinkPacketParser();
    Readable.from([bytes]).pipe(splitter).pipe(parser);
    parser.on('data', packet => found.push(packet));
    parser.on('end', () => done({ found, invalid: splitter.invalidPackages }));
    parser.on('error', fail);
  });
}

async function peerReadsUs(how, signed) {
  const { found, invalid } = await packets(ours('write', how, ...(signed ? ['signed'] : [])));
  assert.strictEqual(invalid, 0);
  assert.strictEqual(found.length, MESSAGES);
  for (const packet of found) {
    const type = registry[packet.header.msgid];
    const message = packet.protocol.data(packet.payload, type);
    assert.deepStrictEqual(values(message, type), expectedValues(type, how), `${type.MSG_NAME}, ${how}`);
    assert.strictEqual(packet.signature !== null, signed);
    if (signed) assert(packet.signature.matches(key), type.MSG_NAME);
  }
  return found.map(packet => packet.header.msgid);
}

function written(type, how) {
  const message = new type(), all = expectedValues(type, how);
  for (const field of inOrder(type)) {
    const own = all.splice(0, isArray(field) ? field.length : 1);
    message[field.name] = field.type === 'char[]' ? String.fromCharCode(...own) : isArray(field) ? own : own[0];
  }
  return message;
}

function weReadPeer(ids, how, signed) {
  const protocol = new peer.MavLinkProtocolV2(1, 191, signed ? peer.MavLinkProtocolV2.IFLAG_SIGNED : 0);
  const bytes = Buffer.concat(ids.map((id, i) => {
    const plain = protocol.serialize(written(registry[id], how), i);
    return signed ? protocol.sign(plain, 3, key, Date.UTC(2026, 0, 1) + i) : plain;
  }));
  const said = execFileSync(process.argv[2], ['read', ...(signed ? ['signed'] : [])], { input: bytes }).toString();
  const lines = said.trim().split('\n');
  assert.strictEqual(lines.length, ids.length);
  lines.forEach((line, i) => {
    const [id, ...got] = line.split(' ');
    assert.strictEqual(Number(id), ids[i]);
    const wanted = expectedValues(registry[ids[i]], how);
    assert.deepStrictEqual(got.map((text, k) => typeof wanted[k] === 'bigint' ? BigInt(text) : Number(text)), wanted,
      `${registry[ids[i]].MSG_NAME}, ${how}`);
  });
}

async function check() {
  for (const signed of [false, true]) {
    for (const how of ['any', 'least', 'greatest']) {
      const ids = await peerReadsUs(how, signed);
      weReadPeer(ids, how, signed);
      console.log(`${ids.length} messages, values ${how}, ${signed ? 'signed' : 'not signed'}: equal both ways`);
    }
  }
}

check().catch(error => { console.error(error); process.exit(1); });
