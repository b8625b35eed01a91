#include "flight/viewers/ros_cloud.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>
#include <vector>

#include "saker/occupancy/open_beam.h"

namespace saker::flight::viewers {
namespace {

/// CDR: each number on a multiple of its size, counted from after the head of four bytes.
class CdrWriter {
 public:
  void put(std::uint8_t value) { bytes_ += static_cast<char>(value); }
  void put(std::uint32_t value) {
    while ((bytes_.size() - kHead) % 4 != 0) bytes_ += '\0';
    for (int i = 0; i < 4; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_ += text;
    bytes_ += '\0';
  }
  /// Bytes of points, as they lie in `data`.
  void append(float value) { append(std::bit_cast<std::uint32_t>(value)); }
  void append(std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
  }
  void append(std::uint16_t value) {
    for (int i = 0; i < 2; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHead = 4;
  std::string bytes_{"\0\1\0\0", kHead};
};

/// PointField.
struct Field {
  const char* name;
  std::uint8_t datatype;
  std::uint32_t bytes;
};
constexpr std::uint8_t kUint16 = 4, kUint32 = 6, kFloat32 = 7;
constexpr Field kPlace[] = {
    {"x", kFloat32, 4}, {"y", kFloat32, 4}, {"z", kFloat32, 4}, {"intensity", kFloat32, 4}};

/// All that stands before the points.
CdrWriter begin_cloud(Time stamp, const std::string& frame_id, std::uint32_t points,
                      std::span<const Field> fields) {
  CdrWriter out;
  out.put(static_cast<std::uint32_t>(stamp / kNanosecondsPerSecond));
  out.put(static_cast<std::uint32_t>(stamp % kNanosecondsPerSecond));
  out.put(frame_id);
  out.put(std::uint32_t{1});
  out.put(points);
  out.put(static_cast<std::uint32_t>(fields.size()));
  std::uint32_t step = 0;
  for (const Field& field : fields) {
    out.put(std::string(field.name));
    out.put(step);
    out.put(field.datatype);
    out.put(std::uint32_t{1});
    step += field.bytes;
  }
  out.put(std::uint8_t{0});
  out.put(step);
  out.put(step * points);
  out.put(step * points);  // bytes of data
  return out;
}

/// The beam of each point; empty where the recording does not say.
std::vector<std::uint16_t> rings_of(const lidar::Scan& scan) {
  if (!scan.organised()) return scan.ring;
  std::vector<std::uint16_t> rings(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i)
    rings[i] = static_cast<std::uint16_t>(i / static_cast<std::size_t>(scan.columns));
  return rings;
}

}  // namespace

const char* const kRosCloudDefinition = R"(std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: sensor_msgs/PointField
uint8 INT8=1
uint8 UINT8=2
uint8 INT16=3
uint8 UINT16=4
uint8 INT32=5
uint8 UINT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 datatype
uint32 count
)";

std::string ros_cloud(const autonomy::RegisteredScan& scan, const std::string& frame_id) {
  const bool reflects = scan.reflectivity && scan.reflectivity->size() == scan.points->size();
  std::uint32_t hits = 0;
  for (const Eigen::Vector3f& p : *scan.points) hits += occupancy::is_open_beam(p) ? 0 : 1;
  CdrWriter out = begin_cloud(scan.stamp, frame_id, hits, kPlace);
  for (std::size_t i = 0; i < scan.points->size(); ++i) {
    const Eigen::Vector3f& p = (*scan.points)[i];
    if (occupancy::is_open_beam(p)) continue;
    for (int axis = 0; axis < 3; ++axis) out.append(p[axis]);
    out.append(reflects ? (*scan.reflectivity)[i] : 0.0f);
  }
  out.put(std::uint8_t{1});
  return out.take();
}

std::string ros_cloud(const lidar::Scan& scan, const std::string& frame_id) {
  const std::vector<std::uint16_t> rings = rings_of(scan);
  const bool has_rings = rings.size() == scan.size() && !rings.empty();
  std::int32_t first = 0;
  std::uint32_t hits = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.points[i].allFinite()) continue;
    first = std::min(first, scan.offset_ns[i]);
    ++hits;
  }
  std::vector<Field> fields(std::begin(kPlace), std::end(kPlace));
  fields.push_back({"t", kUint32, 4});
  if (has_rings) fields.push_back({"ring", kUint16, 2});
  CdrWriter out = begin_cloud(scan.stamp + first, frame_id, hits, fields);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    if (!p.allFinite()) continue;
    for (int axis = 0; axis < 3; ++axis) out.append(p[axis]);
    out.append(scan.reflectivity[i]);
    out.append(static_cast<std::uint32_t>(scan.offset_ns[i] - first));
    if (has_rings) out.append(rings[i]);
  }
  out.put(std::uint8_t{1});
  return out.take();
}

}  // namespace saker::flight::viewers
