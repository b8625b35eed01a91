#include "made_bag.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

namespace saker::lidar::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
void put(Bytes& bytes, T value) {
  const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

void put(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

void put_text(Bytes& bytes, const std::string& text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.insert(bytes.end(), text.begin(), text.end());
}

template <class T>
std::string raw(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

using Fields = std::vector<std::pair<std::string, std::string>>;

Bytes ros1_head(const Fields& fields) {
  Bytes head;
  for (const auto& [name, value] : fields) put_text(head, name + "=" + value);
  return head;
}

void put_ros1_record(Bytes& bytes, const Fields& fields, const Bytes& data) {
  const Bytes head = ros1_head(fields);
  put(bytes, static_cast<std::uint32_t>(head.size()));
  put(bytes, head);
  put(bytes, static_cast<std::uint32_t>(data.size()));
  put(bytes, data);
}

std::string op(int code) { return {static_cast<char>(code)}; }

std::string ros1_time(Time time) {
  return raw(static_cast<std::uint32_t>(time / kNanosecondsPerSecond)) +
         raw(static_cast<std::uint32_t>(time % kNanosecondsPerSecond));
}

/// A type's checksum and text, as ROS has them.
struct Definition {
  std::string md5sum = "0123", text = "float64 x";
};

Definition definition_of(const std::string& type) {
  const std::string line(80, '=');
  const std::string header =
      line + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
  if (type == "sensor_msgs/PointCloud2") {
    return {"1158d486dd51d683ce2f1be655c3c181",
            "Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n"
            "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n" +
                header + line +
                "\nMSG: sensor_msgs/PointField\nuint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\n"
                "uint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
                "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"};
  }
  if (type == "sensor_msgs/Imu") {
    return {"6a62c6daae103f4ff57a132d6f95cec2",
            "Header header\ngeometry_msgs/Quaternion orientation\n"
            "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
            "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
            "float64[9] linear_acceleration_covariance\n" +
                header + line +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n" +
                line + "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"};
  }
  return {};
}

/// What a bag tells about a chunk besides its content.
struct ChunkIndex {
  std::uint64_t position = 0;
  Time begin = 0, end = 0;
  std::map<std::uint32_t, Bytes> entries;  // of each connection: time and place in the chunk

  void add(std::uint32_t connection, Time time, std::size_t place) {
    begin = begin == 0 ? time : std::min(begin, time);
    end = std::max(end, time);
    const std::string stamp = ros1_time(time);
    Bytes& list = entries[connection];
    list.insert(list.end(), stamp.begin(), stamp.end());
    put(list, static_cast<std::uint32_t>(place));
  }
};

constexpr std::size_t kEntryBytes = 12;

/// Behind the chunk: a record a connection.
void put_index(Bytes& bytes, const ChunkIndex& index) {
  for (const auto& [connection, list] : index.entries) {
    put_ros1_record(bytes,
                    {{"op", op(4)},
                     {"ver", raw(std::uint32_t{1})},
                     {"conn", raw(connection)},
                     {"count", raw(static_cast<std::uint32_t>(list.size() / kEntryBytes))}},
                    list);
  }
}

/// At the end of the bag.
void put_chunk_info(Bytes& bytes, const ChunkIndex& index) {
  Bytes counts;
  for (const auto& [connection, list] : index.entries) {
    put(counts, connection);
    put(counts, static_cast<std::uint32_t>(list.size() / kEntryBytes));
  }
  put_ros1_record(bytes,
                  {{"op", op(6)},
                   {"ver", raw(std::uint32_t{1})},
                   {"chunk_pos", raw(index.position)},
                   {"start_time", ros1_time(index.begin)},
                   {"end_time", ros1_time(index.end)},
                   {"count", raw(static_cast<std::uint32_t>(index.entries.size()))}},
                  counts);
}

void put_connection(Bytes& bytes, std::uint32_t number, const MadeMessage& message) {
  const Definition definition = definition_of(message.type);
  put_ros1_record(bytes, {{"op", op(7)}, {"conn", raw(number)}, {"topic", message.topic}},
                  ros1_head({{"topic", message.topic},
                             {"type", message.type},
                             {"md5sum", definition.md5sum},
                             {"message_definition", definition.text}}));
}

void put_mcap_record(Bytes& bytes, int code, const Bytes& content) {
  bytes.push_back(static_cast<std::uint8_t>(code));
  put(bytes, static_cast<std::uint64_t>(content.size()));
  put(bytes, content);
}

Bytes mcap_schema(std::uint16_t id, const std::string& type) {
  Bytes content;
  put(content, id);
  put_text(content, type);
  put_text(content, "ros2msg");
  put_text(content, "float64 x");
  return content;
}

Bytes mcap_channel(std::uint16_t id, const std::string& topic, Encoding encoding) {
  Bytes content;
  put(content, id);
  put(content, id);
  put_text(content, topic);
  put_text(content, encoding == Encoding::kCdr ? "cdr" : "ros1");
  put(content, std::uint32_t{0});
  return content;
}

Bytes mcap_message(std::uint16_t channel, const MadeMessage& message) {
  Bytes content;
  put(content, channel);
  put(content, std::uint32_t{0});
  put(content, static_cast<std::uint64_t>(message.received));
  put(content, static_cast<std::uint64_t>(message.received));
  put(content, message.bytes);
  return content;
}

/// Numbers of topics, in their order, from 1.
std::map<std::string, std::uint16_t> numbered(const std::vector<MadeMessage>& messages) {
  std::map<std::string, std::uint16_t> numbers;
  for (const MadeMessage& m : messages) {
    numbers.emplace(m.topic, static_cast<std::uint16_t>(numbers.size() + 1));
  }
  return numbers;
}

std::string ros2_type(const std::string& type) {
  const auto slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

void put_mcap_chunk(Bytes& file, const Bytes& records, const std::string& compression) {
  const Bytes packed = compressed(compression, records);
  Bytes content;
  put(content, std::uint64_t{0});
  put(content, std::uint64_t{0});
  put(content, static_cast<std::uint64_t>(records.size()));
  put(content, std::uint32_t{0});
  put_text(content, compression == "none" ? "" : compression);
  put(content, static_cast<std::uint64_t>(packed.size()));
  put(content, packed);
  put_mcap_record(file, 0x06, content);
}

Bytes mcap_statistics(const std::vector<MadeMessage>& messages,
                      const std::map<std::string, std::uint16_t>& numbers) {
  std::map<std::uint16_t, std::uint64_t> counts;
  for (const MadeMessage& m : messages) ++counts[numbers.at(m.topic)];
  Bytes content;
  put(content, static_cast<std::uint64_t>(messages.size()));
  put(content, static_cast<std::uint16_t>(numbers.size()));
  for (int i = 0; i < 4; ++i) put(content, static_cast<std::uint32_t>(numbers.size()));
  put(content, static_cast<std::uint64_t>(messages.front().received));
  put(content, static_cast<std::uint64_t>(messages.back().received));
  put(content, static_cast<std::uint32_t>(10 * counts.size()));
  for (const auto& [channel, count] : counts) {
    put(content, channel);
    put(content, count);
  }
  return content;
}

void run(sqlite3* database, const std::string& query) {
  if (sqlite3_exec(database, query.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw std::runtime_error(sqlite3_errmsg(database));
  }
}

}  // namespace

Bytes compressed(const std::string& name, const Bytes& bytes) {
  Bytes packed;
  if (name == "lz4") {
    LZ4F_preferences_t as_ros_wants = {};  // its own library reads no other frames
    as_ros_wants.frameInfo.blockMode = LZ4F_blockIndependent;
    as_ros_wants.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    packed.resize(LZ4F_compressFrameBound(bytes.size(), &as_ros_wants));
    packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(),
                                     &as_ros_wants));
  } else if (name == "zstd") {
    packed.resize(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
  } else if (name == "bz2") {
    packed.resize(bytes.size() + bytes.size() / 50 + 700);
    auto size = static_cast<unsigned>(packed.size());
    auto* from = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
    BZ2_bzBuffToBuffCompress(reinterpret_cast<char*>(packed.data()), &size, from,
                             static_cast<unsigned>(bytes.size()), 1, 0, 0);
    packed.resize(size);
  } else {
    packed = bytes;
  }
  return packed;
}

void write_bytes(const std::filesystem::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

Bytes made_ros1_bag(const std::vector<MadeMessage>& messages, const BagOptions& options) {
  const auto numbers = numbered(messages);
  const std::string magic = "#ROSBAG V2.0\n";
  const auto bag_head = [&](std::uint64_t index, std::size_t connections, std::size_t chunks) {
    Bytes head;
    put_ros1_record(head,
                    {{"op", op(3)},
                     {"index_pos", raw(index)},
                     {"conn_count", raw(static_cast<std::uint32_t>(connections))},
                     {"chunk_count", raw(static_cast<std::uint32_t>(chunks))}},
                    Bytes(64, ' '));
    return head;
  };
  Bytes file(magic.begin(), magic.end());
  put(file, bag_head(0, 0, 0));
  std::map<std::string, bool> told;
  std::vector<ChunkIndex> indices;
  for (std::size_t first = 0; first < messages.size(); first += options.messages_a_chunk) {
    Bytes chunk;
    ChunkIndex& index = indices.emplace_back();
    index.position = file.size();
    const std::size_t end = std::min(messages.size(), first + options.messages_a_chunk);
    for (std::size_t i = first; i < end; ++i) {
      const MadeMessage& m = messages[i];
      const std::uint32_t number = numbers.at(m.topic);
      if (!std::exchange(told[m.topic], true)) put_connection(chunk, number, m);
      index.add(number, m.received, chunk.size());
      put_ros1_record(
          chunk, {{"op", op(2)}, {"conn", raw(number)}, {"time", ros1_time(m.received)}}, m.bytes);
    }
    put_ros1_record(file,
                    {{"op", op(5)},
                     {"compression", options.compression},
                     {"size", raw(static_cast<std::uint32_t>(chunk.size()))}},
                    compressed(options.compression, chunk));
    put_index(file, index);
  }
  if (!options.index) return file;
  const std::uint64_t index = file.size();
  for (const auto& [topic, number] : numbers) {
    for (const MadeMessage& m : messages) {
      if (m.topic != topic) continue;
      put_connection(file, number, m);
      break;
    }
  }
  for (const ChunkIndex& chunk : indices) put_chunk_info(file, chunk);
  const Bytes head = bag_head(index, numbers.size(), indices.size());
  std::copy(head.begin(), head.end(), file.begin() + static_cast<std::ptrdiff_t>(magic.size()));
  return file;
}

Bytes made_mcap(const std::vector<MadeMessage>& messages, Encoding encoding,
                const BagOptions& options) {
  const auto numbers = numbered(messages);
  const std::string magic = "\x89MCAP0\r\n";
  Bytes file(magic.begin(), magic.end());
  put_mcap_record(file, 0x01, Bytes(8, 0));
  std::map<std::string, bool> told;
  Bytes summary;
  for (std::size_t first = 0; first < messages.size(); first += options.messages_a_chunk) {
    Bytes records;
    const std::size_t end = std::min(messages.size(), first + options.messages_a_chunk);
    for (std::size_t i = first; i < end; ++i) {
      const MadeMessage& m = messages[i];
      const std::uint16_t number = numbers.at(m.topic);
      if (!std::exchange(told[m.topic], true)) {
        const std::string type = encoding == Encoding::kCdr ? ros2_type(m.type) : m.type;
        for (Bytes* into : {&records, &summary}) {
          put_mcap_record(*into, 0x03, mcap_schema(number, type));
          put_mcap_record(*into, 0x04, mcap_channel(number, m.topic, encoding));
        }
      }
      put_mcap_record(records, 0x05, mcap_message(number, m));
    }
    if (options.chunks) {
      put_mcap_chunk(file, records, options.compression);
    } else {
      put(file, records);
    }
  }
  put_mcap_record(file, 0x0F, Bytes(4, 0));
  const std::uint64_t summary_at = options.index ? file.size() : 0;
  if (options.index) {
    put(file, summary);
    put_mcap_record(file, 0x0B, mcap_statistics(messages, numbers));
  }
  Bytes footer;
  put(footer, summary_at);
  put(footer, std::uint64_t{0});
  put(footer, std::uint32_t{0});
  put_mcap_record(file, 0x02, footer);
  file.insert(file.end(), magic.begin(), magic.end());
  return file;
}

void write_ros2_database(const std::vector<MadeMessage>& messages,
                         const std::filesystem::path& file) {
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  run(database,
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run(database,
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  const auto numbers = numbered(messages);
  for (const auto& [topic, number] : numbers) {
    for (const MadeMessage& m : messages) {
      if (m.topic != topic) continue;
      run(database, "INSERT INTO topics VALUES(" + std::to_string(number) + ", '" + topic + "', '" +
                        ros2_type(m.type) + "', 'cdr', '')");
      break;
    }
  }
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                     -1, &insert, nullptr);
  for (const MadeMessage& m : messages) {
    sqlite3_bind_int(insert, 1, numbers.at(m.topic));
    sqlite3_bind_int64(insert, 2, m.received);
    sqlite3_bind_blob(insert, 3, m.bytes.data(), static_cast<int>(m.bytes.size()), SQLITE_STATIC);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  sqlite3_close(database);
}

}  // namespace saker::lidar::testing
