// read_ros1.cjs BAG MESSAGES: the messages of a bag by @foxglove/rosbag. Clouds come as six float64 a point (x, y, z, intensity,
// t, ring) and inertial samples as six (acceleration, rate): this library parses what it reads.
const { Bag } = require("@foxglove/rosbag");
const { FileReader } = require("@foxglove/rosbag/node");
const { loadDecompressHandlers } = require("@mcap/support");
const messages = require("./messages.cjs");

const READERS = { 4: "getUint16", 6: "getUint32", 7: "getFloat32" };

function points(cloud) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const fields = ["x", "y", "z", "intensity", "t", "ring"].map((name) => cloud.fields.find((f) => f.name === name));
  const values = [];
  for (let i = 0; i < cloud.width * cloud.height; ++i) {
    for (const { offset, datatype } of fields) {
      values.push(view[READERS[datatype]](i * cloud.point_step + offset, !cloud.is_bigendian));
    }
  }
  return values;
}

function sample(imu) {
  const a = imu.linear_acceleration, w = imu.angular_velocity;
  return [a.x, a.y, a.z, w.x, w.y, w.z];
}

async function main() {
  const decompress = await loadDecompressHandlers();
  const bag = new Bag(new FileReader(process.argv[2]), {
    decompress: { lz4: (bytes, size) => decompress.lz4(bytes, BigInt(size)), bz2: (bytes, size) => decompress.bz2(bytes, BigInt(size)) },
  });
  await bag.open();
  const found = [];
  for await (const { topic, message, timestamp } of bag.messageIterator()) {
    const values = Float64Array.from(message.fields ? points(message) : sample(message));
    const type = message.fields ? "sensor_msgs/PointCloud2" : "sensor_msgs/Imu";
    const time = BigInt(timestamp.sec) * 1000000000n + BigInt(timestamp.nsec);
    found.push({ topic, type, time, bytes: Buffer.from(values.buffer) });
  }
  messages.write(process.argv[3], found);
}

main();
