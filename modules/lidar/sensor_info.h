#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "saker/core/se3.h"

/// What an Ouster sensor says of itself, as far as decoding needs it.
///
/// In: the vendor's metadata JSON, flat (firmware 2) or nested (firmware 3), see metadata.h; or
/// `make_os1`. Out: a plain struct. Frames: the vendor's *lidar* frame L turns with the beams'
/// zero; the *sensor* frame S (our `lidar` frame) is turned by 180° to it and 36 mm lower.
/// `T_sensor_lidar` and `T_sensor_imu` are in metres here, in millimetres in the file.
namespace saker::lidar {

/// Layout of the pixels of a packet. Of the profiles with two returns the first is read.
enum class PacketProfile {
  kLegacy,
  kRng19Rfl8Sig16Nir16,
  kRng19Rfl8Sig16Nir16Dual,
  kRng15Rfl8Nir8,
  kRng15Rfl8Nir8Dual,
  kFusaRng15Rfl8Nir8Dual,
  kRng15Rfl8Win8,
  kRng15Rfl8Nir8Zone16,
  kRng19Rfl8Sig16Nir16Zone16,
  kRng19Rfl8Sig16Zone16Dual,
  kRng19Rfl8Sig16Nir16Rgb16,
  kRng19Rfl8Sig16Nir16Rgb16Dual,
  kFiveWordPixel
};

/// What a packet begins with: functional-safety sensors count frames with 32 bits.
enum class PacketHeader { kStandard, kFusa };

[[nodiscard]] const char* to_string(PacketProfile profile);  ///< the vendor's name, as in metadata
[[nodiscard]] const std::vector<PacketProfile>& packet_profiles();

/// Columns that the sensor sends, both ends included; `first > last` wraps through column 0.
struct ColumnWindow {
  int first = 0;
  int last = 0;

  [[nodiscard]] bool contains(int column) const {
    return first <= last ? column >= first && column <= last : column >= first || column <= last;
  }
  [[nodiscard]] int size(int columns) const { return (last - first + columns) % columns + 1; }
};

struct SensorInfo {
  std::string product_line;  ///< "OS-1-64"
  std::string serial_number;
  int initialization_id = 0;  ///< changes when the sensor restarts

  int rows = 0;     ///< beams: 4 to 256
  int columns = 0;  ///< in a whole revolution: 512 to 4096
  int columns_per_packet = 16;
  double frame_rate_hz = 10;
  PacketProfile profile = PacketProfile::kLegacy;
  PacketHeader header = PacketHeader::kStandard;
  ColumnWindow column_window;
  std::vector<int>
      pixel_shift_by_row;  ///< columns by which a row moves to the right when it is destaggered

  std::vector<double> beam_altitude_deg;  ///< one a row, the highest first
  std::vector<double> beam_azimuth_deg;   ///< one a row, clockwise from above
  double beam_origin_m = 0;               ///< of the beams' origin from the axis of rotation
  double beam_origin_height_m = 0;        ///< of the beams' origin over the lidar frame's
  SE3 T_sensor_lidar = SE3::Identity();
  SE3 T_sensor_imu = SE3::Identity();

  int lidar_port = 7502;
  int imu_port = 7503;

  /// An OS1 with 16, 32, 64 or 128 rows and 512, 1024 or 2048 columns at 10 Hz: beams 45° high and
  /// in four staggered columns of ±4.2° and ±1.4°, their origin 15.806 mm off the axis. Throws
  /// Error for other sizes.
  [[nodiscard]] static SensorInfo make_os1(int rows, int columns, PacketProfile profile);

  /// Seconds between two columns.
  [[nodiscard]] double column_period_s() const { return 1 / (frame_rate_hz * columns); }
};

/// "OS1-64 512x10": model and mode as the vendor names them, columns by revolutions a second.
[[nodiscard]] std::string name_and_mode(const SensorInfo& info);

/// Throws Error that names the first value which does not fit the others; `where` is what the
/// message begins with.
void check(const SensorInfo& info, const std::string& where);

}  // namespace saker::lidar
