// velodyne.cjs PACKETS POINTS [CALIBRATION.json]: Velodyne packets (the bytes of messages), decoded by @foxglove/velodyne-cloud: of each
// packet a message of five float64 a point (x, y, z, ring, ns after the packet's time).
const fs = require("fs");
const { Calibration, PointCloud, RawPacket, Transformer } = require("@foxglove/velodyne-cloud");
const messages = require("./messages.cjs");

const [, , from, to, file] = process.argv;
const NAMES = ["x", "y", "z", "ring", "delta_ns"];
const LENGTHS = ["dist_correction_x", "dist_correction_y", "vert_offset_correction", "horiz_offset_correction", "focal_distance", "focal_slope"];
let transformer;

// It leaves out what ROS takes for 0.
function calibration(file) {
  const read = JSON.parse(fs.readFileSync(file));
  const none = Object.fromEntries(LENGTHS.map((name) => [name, 0]));
  return new Calibration(4, { ...read, lasers: read.lasers.map((laser) => ({ ...none, ...laser })) });
}

function decoded(bytes) {
  const raw = new RawPacket(new Uint8Array(bytes));
  transformer ??= new Transformer(file ? calibration(file) : new Calibration(raw.inferModel()), { minRange: 0, maxRange: 1000 });
  const cloud = new PointCloud({ stamp: 0, maxPoints: RawPacket.MAX_POINTS_PER_PACKET });
  transformer.unpack(raw, 0, 0, cloud);
  cloud.trim();
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const fields = NAMES.map((name) => cloud.fields.find((f) => f.name === name));
  const values = [];
  for (let at = 0; at < cloud.width * cloud.point_step; at += cloud.point_step) {
    for (const { offset, datatype } of fields) {
      const reader = { 2: "getUint8", 4: "getUint16", 5: "getInt32", 6: "getUint32", 7: "getFloat32", 8: "getFloat64" }[datatype];
      values.push(view[reader](at + offset, true));
    }
  }
  return Buffer.from(Float64Array.from(values).buffer);
}

messages.write(to, messages.read(from).map((m) => ({ ...m, bytes: decoded(m.bytes) })));
