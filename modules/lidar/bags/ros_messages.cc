#include "saker/lidar/bags/ros_messages.h"

#include <deque>
#include <map>

#include "saker/core/error.h"
#include "saker/core/one_line.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kCdrHead = 4;
constexpr std::size_t kMostFields = 256;
constexpr std::size_t kCovariance = 9;

std::optional<NumberType> number_type(int datatype) {
  constexpr std::array kTypes = {NumberType::kI8,  NumberType::kU8,  NumberType::kI16,
                                 NumberType::kU16, NumberType::kI32, NumberType::kU32,
                                 NumberType::kF32, NumberType::kF64};
  if (datatype < 1 || datatype > static_cast<int>(kTypes.size())) return std::nullopt;
  return kTypes[static_cast<std::size_t>(datatype - 1)];
}

ByteView content(ByteView bytes, Encoding encoding) {
  if (encoding != Encoding::kCdr) return bytes;
  return bytes.subspan(std::min(kCdrHead, bytes.size()));
}

bool big_endian(ByteView bytes, Encoding encoding) {
  return encoding == Encoding::kCdr && bytes.size() >= kCdrHead && (bytes[1] & 1) == 0;
}

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

}  // namespace

MessageReader::MessageReader(ByteView bytes, Encoding encoding)
    : cdr_(encoding == Encoding::kCdr),
      cursor_(content(bytes, encoding), big_endian(bytes, encoding)) {}

std::string MessageReader::text() {
  std::string text(text_of(cursor_.take(number<std::uint32_t>())));
  if (cdr_ && !text.empty() && text.back() == 0) text.pop_back();
  return text;
}

ByteView MessageReader::bytes() { return cursor_.take(number<std::uint32_t>()); }

std::size_t MessageReader::count(std::size_t least_bytes) {
  const std::size_t elements = number<std::uint32_t>();
  if (elements * least_bytes <= cursor_.left()) return elements;
  cursor_.skip(elements * least_bytes);  // fails
  return 0;
}

Eigen::Vector3d MessageReader::vector() {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = number<double>();
  return v;
}

void MessageReader::skip_numbers(std::size_t numbers) {
  for (std::size_t i = 0; i < numbers; ++i) (void)number<double>();
}

Time MessageReader::time() {
  const Time seconds = cdr_ ? number<std::int32_t>() : Time{number<std::uint32_t>()};
  return seconds * kNanosecondsPerSecond + number<std::uint32_t>();
}

MessageReader::Header MessageReader::header() {
  Header header;
  if (!cdr_) (void)number<std::uint32_t>();  // its number
  header.stamp = time();
  header.frame = without_slash(text());
  return header;
}

std::optional<CloudMessage> read_point_cloud2(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  CloudMessage cloud;
  cloud.header = reader.header();
  cloud.rows = reader.number<std::uint32_t>();
  cloud.columns = reader.number<std::uint32_t>();
  const std::size_t fields = reader.count();
  if (fields > kMostFields) return std::nullopt;
  for (std::size_t i = 0; i < fields && reader.ok(); ++i) {
    PointField field;
    field.name = one_line(reader.text());
    field.offset = reader.number<std::uint32_t>();
    const auto type = number_type(reader.number<std::uint8_t>());
    (void)reader.number<std::uint32_t>();  // how many; the first counts
    if (!type) continue;
    field.type = *type;
    cloud.layout.fields.push_back(field);
  }
  cloud.layout.big_endian = reader.number<std::uint8_t>() != 0;
  cloud.layout.step = reader.number<std::uint32_t>();
  cloud.row_step = reader.number<std::uint32_t>();
  cloud.data = reader.bytes();
  if (!reader.ok()) return std::nullopt;
  if (cloud.rows == 1) cloud.row_step = std::max(cloud.row_step, cloud.columns * cloud.layout.step);
  return cloud;
}

std::optional<CloudMessage> read_livox(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  CloudMessage cloud;
  cloud.header = reader.header();
  (void)reader.number<std::uint64_t>();  // the stamp once more
  (void)reader.number<std::uint32_t>();  // the number of points, which the sequence says, too
  for (int i = 0; i < 4; ++i) (void)reader.number<std::uint8_t>();
  cloud.layout.append("offset_time", NumberType::kU32);
  for (const char* name : {"x", "y", "z"}) cloud.layout.append(name, NumberType::kF32);
  for (const char* name : {"reflectivity", "tag", "line"}) {
    cloud.layout.append(name, NumberType::kU8);
  }
  cloud.rows = 1;
  cloud.columns = reader.count(cloud.layout.step);
  cloud.row_step = cloud.columns * cloud.layout.step;
  cloud.made.reserve(cloud.row_step);
  const auto append = [&](auto value) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    cloud.made.insert(cloud.made.end(), from, from + sizeof value);
  };
  for (std::size_t i = 0; i < cloud.columns && reader.ok(); ++i) {
    append(reader.number<std::uint32_t>());
    for (int k = 0; k < 3; ++k) append(reader.number<float>());
    for (int k = 0; k < 3; ++k) append(reader.number<std::uint8_t>());
  }
  if (!reader.ok()) return std::nullopt;
  cloud.data = cloud.made;
  return cloud;
}

std::optional<ImuMessage> read_imu(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  ImuMessage imu;
  imu.header = reader.header();
  reader.skip_numbers(4 + kCovariance);  // the attitude
  imu.angular_velocity = reader.vector();
  reader.skip_numbers(kCovariance);
  imu.acceleration = reader.vector();
  if (!reader.ok() || !imu.angular_velocity.allFinite() || !imu.acceleration.allFinite()) {
    return std::nullopt;
  }
  return imu;
}

std::optional<ByteView> read_packet(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  const ByteView packet = reader.bytes();
  if (!reader.ok()) return std::nullopt;
  return packet;
}

std::vector<TimedPacket> read_packets(ByteView bytes, Encoding encoding, const std::string& type) {
  constexpr std::size_t kVelodyneBytes = 1206, kPandarBytes = 1500, kLeastBytes = 12;
  const bool velodyne = type == "velodyne_msgs/VelodyneScan";
  const bool fixed = velodyne || type == "pandar_msgs/PandarScan";
  MessageReader reader(bytes, encoding);
  (void)reader.header();
  std::vector<TimedPacket> packets;
  const std::size_t count = reader.count(kLeastBytes);
  for (std::size_t i = 0; i < count; ++i) {
    TimedPacket packet;
    packet.received = reader.time();
    packet.bytes = fixed ? reader.array(velodyne ? kVelodyneBytes : kPandarBytes) : reader.bytes();
    if (!velodyne) {
      const std::size_t size = reader.number<std::uint32_t>();
      if (size <= packet.bytes.size()) packet.bytes = packet.bytes.first(size);
    }
    if (!reader.ok()) break;
    packets.push_back(packet);
  }
  return packets;
}

std::optional<std::string> read_string(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  const std::string text = reader.text();
  if (!reader.ok()) return std::nullopt;
  return text;
}

std::vector<TransformMessage> read_transforms(ByteView bytes, Encoding encoding) {
  MessageReader reader(bytes, encoding);
  std::vector<TransformMessage> transforms;
  const std::size_t count = reader.count();
  for (std::size_t i = 0; i < count; ++i) {
    TransformMessage message;
    message.parent = reader.header().frame;
    message.child = without_slash(reader.text());
    const Eigen::Vector3d place = reader.vector();
    const Eigen::Vector3d axis = reader.vector();
    const Eigen::Quaterniond turn(reader.number<double>(), axis.x(), axis.y(), axis.z());
    if (!reader.ok()) break;
    if (!place.allFinite() || !(std::abs(turn.norm() - 1) <= 0.01)) continue;
    message.T_parent_child = Eigen::Translation3d(place) * turn.normalized();
    transforms.push_back(message);
  }
  return transforms;
}

std::optional<Eigen::Isometry3d> find_transform(const std::vector<TransformMessage>& transforms,
                                                const std::string& a, const std::string& b) {
  std::map<std::string, Eigen::Isometry3d> T_a_known = {{a, Eigen::Isometry3d::Identity()}};
  std::deque<std::string> open = {a};
  while (!open.empty()) {
    const std::string at = open.front();
    open.pop_front();
    if (at == b) return T_a_known[b];
    for (const TransformMessage& t : transforms) {
      const bool down = t.parent == at;
      if (!down && t.child != at) continue;
      const std::string& next = down ? t.child : t.parent;
      if (T_a_known.contains(next)) continue;
      T_a_known[next] = T_a_known[at] * (down ? t.T_parent_child : t.T_parent_child.inverse());
      open.push_back(next);
    }
  }
  return std::nullopt;
}

}  // namespace saker::lidar
