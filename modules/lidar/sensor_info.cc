#include "saker/lidar/sensor_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

// The four columns of emitters of an OS1, and the offset by which its pixel shifts are counted: as
// its metadata says.
constexpr std::array<double, 4> kOs1AzimuthDeg = {4.22, 1.41, -1.41, -4.22};
constexpr double kOs1HighestBeamDeg = 22.5;

using P = PacketProfile;
constexpr std::array<std::pair<PacketProfile, const char*>, 13> kProfiles = {
    {{P::kLegacy, "LEGACY"},
     {P::kRng19Rfl8Sig16Nir16, "RNG19_RFL8_SIG16_NIR16"},
     {P::kRng19Rfl8Sig16Nir16Dual, "RNG19_RFL8_SIG16_NIR16_DUAL"},
     {P::kRng15Rfl8Nir8, "RNG15_RFL8_NIR8"},
     {P::kRng15Rfl8Nir8Dual, "RNG15_RFL8_NIR8_DUAL"},
     {P::kFusaRng15Rfl8Nir8Dual, "FUSA_RNG15_RFL8_NIR8_DUAL"},
     {P::kRng15Rfl8Win8, "RNG15_RFL8_WIN8"},
     {P::kRng15Rfl8Nir8Zone16, "RNG15_RFL8_NIR8_ZONE16"},
     {P::kRng19Rfl8Sig16Nir16Zone16, "RNG19_RFL8_SIG16_NIR16_ZONE16"},
     {P::kRng19Rfl8Sig16Zone16Dual, "RNG19_RFL8_SIG16_ZONE16_DUAL"},
     {P::kRng19Rfl8Sig16Nir16Rgb16, "RNG19_RFL8_SIG16_NIR16_RGB16"},
     {P::kRng19Rfl8Sig16Nir16Rgb16Dual, "RNG19_RFL8_SIG16_NIR16_RGB16_DUAL"},
     {P::kFiveWordPixel, "FIVE_WORD_PIXEL"}}};

SE3 half_turn(double height_m) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  T.translation().z() = height_m;
  return T;
}

int pixel_shift(double azimuth_deg, int columns) {
  return static_cast<int>(std::lround((azimuth_deg + kOs1AzimuthDeg[0]) * columns / 360));
}

bool one_of(int value, std::initializer_list<int> values) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void expect(bool holds, const std::string& where, const std::string& what) {
  if (!holds) throw Error(where + ": " + what);
}

void check_size(const SensorInfo& info, const std::string& where) {
  expect(one_of(info.rows, {4, 8, 16, 32, 48, 64, 128, 256}), where,
         "pixels_per_column: " + std::to_string(info.rows) +
             ", expected 4, 8, 16, 32, 48, 64, 128 or 256");
  expect(one_of(info.columns, {512, 1024, 1280, 2048, 4096}), where,
         "columns_per_frame: " + std::to_string(info.columns) +
             ", expected 512, 1024, 1280, 2048 or 4096");
  expect(info.columns_per_packet > 0 && info.columns_per_packet <= 128 &&
             info.columns % info.columns_per_packet == 0,
         where,
         "columns_per_packet: " + std::to_string(info.columns_per_packet) +
             ", expected a divisor of the columns of a frame, at most 128");
  expect(info.frame_rate_hz >= 2 && info.frame_rate_hz <= 100, where,
         "frame rate: " + std::to_string(info.frame_rate_hz) + ", expected 2 to 100 Hz");
}

template <class T>
void check_rows(const std::vector<T>& values, const SensorInfo& info, const std::string& where,
                const char* key) {
  expect(static_cast<int>(values.size()) == info.rows, where,
         std::string(key) + ": " + std::to_string(values.size()) + " values, expected " +
             std::to_string(info.rows) + ", one a row");
  for (const T value : values) {
    expect(std::isfinite(static_cast<double>(value)), where,
           std::string(key) + ": a value that is not finite");
  }
}

}  // namespace

const char* to_string(PacketProfile profile) {
  for (const auto& [known, name] : kProfiles) {
    if (known == profile) return name;
  }
  return "";
}

const std::vector<PacketProfile>& packet_profiles() {
  static const std::vector<PacketProfile> profiles = [] {
    std::vector<PacketProfile> all;
    for (const auto& [profile, name] : kProfiles) all.push_back(profile);
    return all;
  }();
  return profiles;
}

SensorInfo SensorInfo::make_os1(int rows, int columns, PacketProfile profile) {
  SensorInfo info;
  info.product_line = "OS-1-" + std::to_string(rows);
  info.rows = rows;
  info.columns = columns;
  info.profile = profile;
  if (profile == PacketProfile::kFusaRng15Rfl8Nir8Dual) info.header = PacketHeader::kFusa;
  info.column_window = {0, columns - 1};
  for (int row = 0; row < rows; ++row) {
    const double azimuth_deg = kOs1AzimuthDeg[static_cast<std::size_t>(row) % 4];
    info.beam_altitude_deg.push_back(kOs1HighestBeamDeg * (1 - 2.0 * row / (rows - 1)));
    info.beam_azimuth_deg.push_back(azimuth_deg);
    info.pixel_shift_by_row.push_back(pixel_shift(azimuth_deg, columns));
  }
  info.beam_origin_m = 0.015806;
  info.T_sensor_lidar = half_turn(0.03618);
  info.T_sensor_imu.translation() = Eigen::Vector3d(0.006253, -0.011775, 0.007645);
  check(info, "make_os1");
  return info;
}

std::string name_and_mode(const SensorInfo& info) {
  std::string name = info.product_line;
  if (name.starts_with("OS-")) name.erase(2, 1);  // metadata has "OS-1-64"
  return name + " " + std::to_string(info.columns) + "x" +
         std::to_string(std::lround(info.frame_rate_hz));
}

void check(const SensorInfo& info, const std::string& where) {
  check_size(info, where);
  check_rows(info.beam_altitude_deg, info, where, "beam_altitude_angles");
  check_rows(info.beam_azimuth_deg, info, where, "beam_azimuth_angles");
  check_rows(info.pixel_shift_by_row, info, where, "pixel_shift_by_row");
  const auto inside = [&](int column) { return column >= 0 && column < info.columns; };
  expect(inside(info.column_window.first) && inside(info.column_window.last), where,
         "column_window: [" + std::to_string(info.column_window.first) + ", " +
             std::to_string(info.column_window.last) + "], expected columns from 0 to " +
             std::to_string(info.columns - 1));
  const auto is_zero = [](double angle) { return angle == 0; };
  expect(!std::all_of(info.beam_altitude_deg.begin(), info.beam_altitude_deg.end(), is_zero), where,
         "beam_altitude_angles: all 0, expected the angles of the beams");
  for (const double altitude : info.beam_altitude_deg) {
    expect(std::abs(altitude) <= 90, where,
           "beam_altitude_angles: " + std::to_string(altitude) + ", expected -90 to 90");
  }
}

}  // namespace saker::lidar
