#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saker/lidar/cursor.h"
#include "saker/lidar/scan.h"

/// Points as records of named numbers, as PCD, PLY, NumPy and PointCloud2 have them.
namespace saker::lidar {

enum class NumberType { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };

[[nodiscard]] std::size_t bytes_of(NumberType type);

struct PointField {
  std::string name;
  std::size_t offset = 0;  ///< in a point's record
  NumberType type = NumberType::kF32;
};

struct PointLayout {
  std::vector<PointField> fields;
  std::size_t step = 0;  ///< bytes from one point to the next
  bool big_endian = false;

  /// Puts a field behind those that are there.
  void append(std::string name, NumberType type);

  /// "x y z intensity ring".
  [[nodiscard]] std::string names() const;
};

/// Turns records into scans.
///
/// Fields are found by name, whatever their case and "scalar_" before it: x, y, z; reflectivity,
/// intensity, i or remission; ring, line, laser_id or channel; t, time, timestamp, time_stamp,
/// offset_time or offset. A point at 0, 0, 0 had no return and becomes NaN. Intensities are brought
/// to 0 … 1 by what the first scan's largest say (1, 255, 65535). Times are seconds, milli-, micro-
/// or nanoseconds, whichever makes a scan between 5 ms and 1.1 s long; they count from the
/// message's stamp, or, beyond 10 s, from the clock's zero. Where no unit fits, points have no
/// times.
class PointReader {
 public:
  /// Throws Error (`where` is what it begins with) when x, y or z is not there or a field does not
  /// lie inside the record.
  PointReader(PointLayout layout, const std::string& where);

  /// Of each record in turn. `stamp` is the message's; the scan's becomes that of the last point.
  /// \param rows, row_step  of an organised cloud, each row beginning at a multiple of `row_step`;
  ///                        without ring numbers a row counts as one ring
  /// \return why there is no scan, or empty
  [[nodiscard]] std::string read(ByteView bytes, std::size_t rows, std::size_t columns,
                                 std::size_t row_step, Time stamp, Scan& scan);

  [[nodiscard]] const PointLayout& layout() const { return layout_; }
  [[nodiscard]] bool has_times() const { return time_.has_value(); }
  [[nodiscard]] bool has_rings() const { return ring_.has_value(); }

 private:
  struct Role {
    std::size_t offset = 0;
    NumberType type = NumberType::kF32;
  };

  [[nodiscard]] std::optional<Role> find(std::initializer_list<std::string_view> names) const;
  [[nodiscard]] double number(const std::uint8_t* record, const Role& role) const;
  [[nodiscard]] Eigen::Vector3f place(const std::uint8_t* record) const;
  bool take_first_time(const std::uint8_t* record);
  void read_record(const std::uint8_t* record, Scan& scan);
  void scale_reflectivity(Scan& scan);
  void place_times(Time stamp, Scan& scan);

  PointLayout layout_;
  std::array<Role, 3> place_;
  std::optional<Role> intensity_, ring_, time_;
  double intensity_scale_ = 0;  // 0: not known yet
  double unit_ns_ = 0;          // of the points' times; 0: not known yet
  std::vector<double> times_;   // as read, less that of the first point with a return
  bool first_known_ = false;
  std::int64_t first_integer_ = 0;
  double first_number_ = 0;
};

}  // namespace saker::lidar
