#include "made_bag.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <fstream>
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

void put_connection(Bytes& bytes, std::uint32_t number, const MadeMessage& message) {
  put_ros1_record(bytes, {{"op", op(7)}, {"conn", raw(number)}, {"topic", message.topic}},
                  ros1_head({{"topic", message.topic},
                             {"type", message.type},
                             {"md5sum", "0123"},
                             {"message_definition", "float64 x"}}));
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
    packed.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    packed.resize(
        LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
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
  const auto bag_head = [&](std::uint64_t index, std::uint32_t connections) {
    Bytes head;
    put_ros1_record(head,
                    {{"op", op(3)},
                     {"index_pos", raw(index)},
                     {"conn_count", raw(connections)},
                     {"chunk_count", raw(std::uint32_t{0})}},
                    Bytes(64, ' '));
    return head;
  };
  Bytes file(magic.begin(), magic.end());
  put(file, bag_head(0, 0));
  std::map<std::string, bool> told;
  for (std::size_t first = 0; first < messages.size(); first += options.messages_a_chunk) {
    Bytes chunk;
    const std::size_t end = std::min(messages.size(), first + options.messages_a_chunk);
    for (std::size_t i = first; i < end; ++i) {
      const MadeMessage& m = messages[i];
      const std::uint32_t number = numbers.at(m.topic);
      if (!std::exchange(told[m.topic], true)) put_connection(chunk, number, m);
      put_ros1_record(
          chunk, {{"op", op(2)}, {"conn", raw(number)}, {"time", ros1_time(m.received)}}, m.bytes);
    }
    put_ros1_record(file,
                    {{"op", op(5)},
                     {"compression", options.compression},
                     {"size", raw(static_cast<std::uint32_t>(chunk.size()))}},
                    compressed(options.compression, chunk));
    put_ros1_record(file, {{"op", op(4)}, {"ver", raw(std::uint32_t{1})}}, Bytes(12, 1));
  }
  if (!options.index) return file;
  const std::uint64_t index = file.size();
  std::map<std::string, std::uint32_t> counts;
  for (const MadeMessage& m : messages) ++counts[m.topic];
  for (const auto& [topic, number] : numbers) {
    for (const MadeMessage& m : messages) {
      if (m.topic != topic) continue;
      put_connection(file, number, m);
      break;
    }
  }
  Bytes data;
  for (const auto& [topic, count] : counts) {
    put(data, std::uint32_t{numbers.at(topic)});
    put(data, count);
  }
  put_ros1_record(file,
                  {{"op", op(6)},
                   {"start_time", ros1_time(messages.front().received)},
                   {"end_time", ros1_time(messages.back().received)}},
                  data);
  const Bytes head = bag_head(index, static_cast<std::uint32_t>(numbers.size()));
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
