#include "flight/viewers/ros_cloud.h"

#include <bit>
#include <cstring>

#include "saker/autonomy/open_beams.h"

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
  void append(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) bytes_ += static_cast<char>(bits >> (8 * i) & 0xff);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHead = 4;
  std::string bytes_{"\0\1\0\0", kHead};
};

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
  constexpr std::uint8_t kFloat32 = 7;
  constexpr std::uint32_t kStep = 16;
  const bool reflects = scan.reflectivity && scan.reflectivity->size() == scan.points->size();
  std::uint32_t hits = 0;
  for (const Eigen::Vector3f& p : *scan.points) hits += autonomy::OpenBeams::is_open(p) ? 0 : 1;
  CdrWriter out;
  out.put(static_cast<std::uint32_t>(scan.stamp / kNanosecondsPerSecond));
  out.put(static_cast<std::uint32_t>(scan.stamp % kNanosecondsPerSecond));
  out.put(frame_id);
  out.put(std::uint32_t{1});
  out.put(hits);
  out.put(std::uint32_t{4});
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    out.put(std::string(name));
    out.put(offset);
    out.put(kFloat32);
    out.put(std::uint32_t{1});
    offset += 4;
  }
  out.put(std::uint8_t{0});
  out.put(kStep);
  out.put(kStep * hits);
  out.put(kStep * hits);  // bytes of data
  for (std::size_t i = 0; i < scan.points->size(); ++i) {
    const Eigen::Vector3f& p = (*scan.points)[i];
    if (autonomy::OpenBeams::is_open(p)) continue;
    for (int axis = 0; axis < 3; ++axis) out.append(p[axis]);
    out.append(reflects ? (*scan.reflectivity)[i] : 0.0f);
  }
  out.put(std::uint8_t{1});
  return out.take();
}

}  // namespace saker::flight::viewers
