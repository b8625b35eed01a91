#include "saker/lidar/clouds/point_layout.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "saker/core/error.h"
#include "saker/core/one_line.h"

namespace saker::lidar {
namespace {

constexpr double kShortestScan_ns = 5e6;
constexpr double kLongestScan_ns = 1.1e9;
constexpr double kLongestRelative_ns = 10e9;  // beyond it a time counts from the clock's zero
constexpr double kLargestTime_ns = 9e18;
constexpr double kMostClocksApart_ns = 60e9;

bool is_float(NumberType type) { return type == NumberType::kF32 || type == NumberType::kF64; }

template <class T>
T load(const std::uint8_t* at, bool big_endian) {
  return Cursor({at, sizeof(T)}, big_endian).number<T>();
}

std::int64_t integer(const std::uint8_t* at, NumberType type, bool big_endian) {
  switch (type) {
    case NumberType::kI8:
      return load<std::int8_t>(at, big_endian);
    case NumberType::kU8:
      return load<std::uint8_t>(at, big_endian);
    case NumberType::kI16:
      return load<std::int16_t>(at, big_endian);
    case NumberType::kU16:
      return load<std::uint16_t>(at, big_endian);
    case NumberType::kI32:
      return load<std::int32_t>(at, big_endian);
    case NumberType::kU32:
      return load<std::uint32_t>(at, big_endian);
    default:
      return load<std::int64_t>(at, big_endian);
  }
}

std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (text.rfind("scalar_", 0) == 0) text = text.substr(7);
  return text;
}

/// The unit in ns that makes the scan as long as scans are; 0 where none does.
double unit_of(double span) {
  for (const double unit_ns : {1.0, 1e3, 1e6, 1e9}) {
    const double span_ns = span * unit_ns;
    if (span_ns >= kShortestScan_ns && span_ns <= kLongestScan_ns) return unit_ns;
  }
  return 0;
}

}  // namespace

std::size_t bytes_of(NumberType type) {
  switch (type) {
    case NumberType::kI8:
    case NumberType::kU8:
      return 1;
    case NumberType::kI16:
    case NumberType::kU16:
      return 2;
    case NumberType::kI32:
    case NumberType::kU32:
    case NumberType::kF32:
      return 4;
    default:
      return 8;
  }
}

void PointLayout::append(std::string name, NumberType type) {
  fields.push_back({one_line(std::move(name)), step, type});
  step += bytes_of(type);
}

std::string PointLayout::names() const {
  std::string text;
  for (const PointField& field : fields) text += (text.empty() ? "" : " ") + field.name;
  return text;
}

PointReader::PointReader(PointLayout layout, const std::string& where)
    : layout_(std::move(layout)) {
  for (const PointField& field : layout_.fields) {
    if (field.offset > layout_.step || layout_.step - field.offset < bytes_of(field.type)) {
      throw Error(where + ": field " + field.name + " at byte " + std::to_string(field.offset) +
                  ", expected it inside the " + std::to_string(layout_.step) + " bytes of a point");
    }
  }
  const std::array<const char*, 3> axes = {"x", "y", "z"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto role = find({axes[i]});
    if (!role) {
      throw Error(where + ": fields " + layout_.names() + ", expected x, y and z among them");
    }
    place_[i] = *role;
  }
  intensity_ = find({"reflectivity", "intensity", "i", "remission", "reflectance"});
  ring_ = find({"ring", "line", "laser_id", "channel", "row"});
  time_ = find({"t", "time", "timestamp", "time_stamp", "offset_time", "offset", "stamp"});
}

std::optional<PointReader::Role> PointReader::find(
    std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    for (const PointField& field : layout_.fields) {
      if (plain(field.name) == name) return Role{field.offset, field.type};
    }
  }
  return std::nullopt;
}

double PointReader::number(const std::uint8_t* record, const Role& role) const {
  const std::uint8_t* at = record + role.offset;
  if (role.type == NumberType::kF32) {
    return static_cast<double>(load<float>(at, layout_.big_endian));
  }
  if (role.type == NumberType::kF64) return load<double>(at, layout_.big_endian);
  return static_cast<double>(integer(at, role.type, layout_.big_endian));
}

std::string PointReader::read(ByteView bytes, std::size_t rows, std::size_t columns,
                              std::size_t row_step, Time stamp, Scan& scan) {
  if (rows == 0 || columns == 0) return "holds no points";
  const std::size_t row_bytes = columns * layout_.step;
  if (row_bytes / layout_.step != columns || row_step < row_bytes ||
      (bytes.size() - std::min(bytes.size(), row_bytes)) / row_step + 1 < rows ||
      bytes.size() < row_bytes) {
    return std::to_string(bytes.size()) + " bytes, expected " + std::to_string(rows) + " rows of " +
           std::to_string(columns) + " points of " + std::to_string(layout_.step);
  }
  scan = {};
  scan.points.reserve(rows * columns);
  scan.reflectivity.reserve(rows * columns);
  times_.clear();
  first_known_ = !time_;
  for (std::size_t i = 0; i < rows * columns && !first_known_; ++i) {
    first_known_ =
        take_first_time(bytes.data() + i / columns * row_step + i % columns * layout_.step);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* record = bytes.data() + row * row_step;
    for (std::size_t column = 0; column < columns; ++column, record += layout_.step) {
      read_record(record, scan);
      if (!ring_ && rows > 1) scan.ring.push_back(static_cast<std::uint16_t>(row));
    }
  }
  scale_reflectivity(scan);
  place_times(stamp, scan);
  return "";
}

Eigen::Vector3f PointReader::place(const std::uint8_t* record) const {
  Eigen::Vector3f p;
  for (int i = 0; i < 3; ++i) p[i] = static_cast<float>(number(record, place_[i]));
  if (p.isZero(0)) p.setConstant(NAN);
  return p;
}

/// Of a point with a return: where there is none drivers write a time of zero, or nothing.
bool PointReader::take_first_time(const std::uint8_t* record) {
  if (!place(record).allFinite()) return false;
  if (is_float(time_->type)) {
    first_number_ = number(record, *time_);
    return std::isfinite(first_number_);
  }
  first_integer_ = integer(record + time_->offset, time_->type, layout_.big_endian);
  return true;
}

void PointReader::read_record(const std::uint8_t* record, Scan& scan) {
  scan.points.push_back(place(record));
  scan.reflectivity.push_back(intensity_ ? static_cast<float>(number(record, *intensity_)) : 0.0F);
  if (ring_) {
    const double ring = number(record, *ring_);
    scan.ring.push_back(ring >= 0 && ring < 65536 ? static_cast<std::uint16_t>(ring) : 0);
  }
  if (!time_ || !first_known_) return;
  if (is_float(time_->type)) {
    times_.push_back(number(record, *time_) - first_number_);
  } else {
    const auto value = integer(record + time_->offset, time_->type, layout_.big_endian);
    times_.push_back(static_cast<double>(static_cast<std::int64_t>(
        static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(first_integer_))));
  }
}

void PointReader::scale_reflectivity(Scan& scan) {
  if (intensity_scale_ == 0) {
    float largest = 0;
    for (const float value : scan.reflectivity) {
      if (std::isfinite(value)) largest = std::max(largest, value);
    }
    if (largest > 0) intensity_scale_ = largest <= 1 ? 1 : largest <= 255 ? 255 : 65535;
  }
  const double scale = intensity_scale_ > 0 ? intensity_scale_ : 1;
  for (float& value : scan.reflectivity) {
    const auto scaled = static_cast<float>(value / scale);
    value = std::isfinite(scaled) ? std::clamp(scaled, 0.0F, 1.0F) : 0;
  }
}

void PointReader::place_times(Time stamp, Scan& scan) {
  scan.stamp = stamp;
  scan.offset_ns.assign(scan.points.size(), 0);
  double least = INFINITY, most = -INFINITY;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (!std::isfinite(times_[i]) || !scan.points[i].allFinite()) continue;
    least = std::min(least, times_[i]);
    most = std::max(most, times_[i]);
  }
  if (!(most >= least)) return;
  if (unit_ns_ == 0) unit_ns_ = unit_of(most - least);
  if (unit_ns_ == 0 || (most - least) * unit_ns_ > kLongestScan_ns) return;
  const bool floats = is_float(time_->type);
  const double first_ns = (floats ? first_number_ : static_cast<double>(first_integer_)) * unit_ns_;
  if (!(std::abs(first_ns) < kLargestTime_ns)) return;
  const Time first = floats ? static_cast<Time>(std::llround(first_ns))
                            : first_integer_ * static_cast<Time>(unit_ns_);
  const auto from_first = [&](double time) {
    return static_cast<Time>(std::llround(time * unit_ns_));
  };
  const bool absolute = std::abs(first_ns) > kLongestRelative_ns;
  const double apart = first_ns - static_cast<double>(stamp);
  if (!absolute) {
    scan.stamp = stamp + first + from_first(most);
  } else if (std::abs(apart) < kMostClocksApart_ns) {
    scan.stamp = first + from_first(most);
  } else {  // of another clock than the message's stamp, which counts as the scan's begin
    scan.stamp = stamp + from_first(most - least);
  }
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (times_[i] >= least && times_[i] <= most) {
      scan.offset_ns[i] = static_cast<std::int32_t>(from_first(times_[i]) - from_first(most));
    }
  }
}

}  // namespace saker::lidar
