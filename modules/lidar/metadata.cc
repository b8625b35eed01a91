#include "saker/lidar/metadata.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::lidar {
namespace {

using Json = nlohmann::json;

constexpr double kMillimetre = 1e-3;

/// Finds keys in either form and says in one line what is wrong with one.
class Document {
 public:
  Document(const std::string& text, const std::string& where) : where_(where) {
    root_ = Json::parse(text, nullptr, false);
    if (root_.is_discarded()) throw Error(where_ + ": not valid JSON");
    if (!root_.is_object()) throw Error(where_ + ": expected a JSON object of sensor metadata");
    nested_ = root_.contains("beam_intrinsics");
    forget_refused_sections();
    refuse_mixture();
  }

  [[nodiscard]] bool nested() const { return nested_; }
  /// Firmware 1, which the vendor's newer tools ask for more than it knows.
  [[nodiscard]] bool old_firmware() const { return answered_.contains("lidar_data_format"); }
  [[nodiscard]] bool has(const char* section) const { return root_.contains(section); }

  /// Null when the key is absent; in the flat form everything but the data format stands at the
  /// top.
  [[nodiscard]] const Json* find(const char* section, const char* key) const {
    const Json* parent = &root_;
    if (root_.contains(section)) parent = &root_[section];
    if (parent->is_object() && parent->contains(key)) return &(*parent)[key];
    return !nested_ && root_.contains(key) ? &root_[key] : nullptr;
  }

  template <class T>
  [[nodiscard]] T required(const char* section, const char* key, const char* expected) const {
    const Json* value = find(section, key);
    if (value == nullptr) {
      throw Error(where_ + ": " + name(section, key) + ": missing, expected " + expected);
    }
    return convert<T>(*value, section, key, expected);
  }

  template <class T>
  [[nodiscard]] T optional(const char* section, const char* key, const char* expected,
                           const T& otherwise) const {
    const Json* value = find(section, key);
    return value == nullptr ? otherwise : convert<T>(*value, section, key, expected);
  }

  [[noreturn]] void refuse(const char* section, const char* key, const std::string& found,
                           const std::string& expected) const {
    throw Error(where_ + ": " + name(section, key) + ": " + found + ", expected " + expected);
  }

 private:
  /// Old firmware answers "error: Command not recognized." where it does not know a section.
  void forget_refused_sections() {
    for (const char* section : kSections) {
      if (root_.contains(section) && root_[section].is_string()) {
        answered_.insert(section);
        root_.erase(section);
      }
    }
  }

  /// The two forms hold different keys; a file with keys of both was put together by hand. One that
  /// a vendor's client wrote in the nested form holds every section.
  void refuse_mixture() const {
    if (!nested_) {
      for (const char* section : kSections) {
        if (root_.contains(section)) {
          throw Error(where_ + ": " + section + ": a section of the nested form, expected " +
                      "beam_intrinsics beside it or the flat form alone");
        }
      }
      return;
    }
    for (const char* key : kFlatKeys) {
      if (root_.contains(key)) {
        throw Error(where_ + ": " + key + ": a key of the flat form, expected the nested form " +
                    "alone, as there is beam_intrinsics");
      }
    }
    if (!root_.contains("client_version")) return;
    for (const char* section : kSections) {
      if (!root_.contains(section) && !answered_.contains(section)) {
        throw Error(where_ + ": " + section + ": missing, expected the section");
      }
    }
  }

  [[nodiscard]] std::string name(const char* section, const char* key) const {
    return nested_ || root_.contains(section) ? std::string(section) + "." + key : key;
  }

  /// JSON's own conversions round a fraction and wrap a large number; these do not.
  template <class T>
  [[nodiscard]] static bool fits(const Json& value) {
    if constexpr (std::is_same_v<T, int>) {
      return value.is_number_integer() && std::abs(value.get<double>()) < 2147483647.0;
    } else if constexpr (std::is_same_v<T, double>) {
      return value.is_number() && std::isfinite(value.get<double>());
    } else if constexpr (std::is_same_v<T, std::string>) {
      return value.is_string();
    } else {
      return value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& v) {
               return fits<typename T::value_type>(v);
             });
    }
  }

  template <class T>
  [[nodiscard]] T convert(const Json& value, const char* section, const char* key,
                          const char* expected) const {
    if (fits<T>(value)) return value.get<T>();
    refuse(section, key, value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 60),
           expected);
  }

  static constexpr std::array kSections = {"sensor_info",       "beam_intrinsics",
                                           "imu_intrinsics",    "lidar_intrinsics",
                                           "lidar_data_format", "calibration_status"};
  static constexpr std::array kFlatKeys = {
      "beam_altitude_angles",    "beam_azimuth_angles", "data_format",
      "imu_to_sensor_transform", "prod_line",           "prod_sn"};

  Json root_;
  bool nested_ = false;
  std::set<std::string> answered_;  // sections that the firmware did not know
  std::string where_;
};

struct LidarMode {
  int columns = 0;
  double rate_hz = 10;
};

LidarMode read_mode(const Document& document) {
  const auto text = document.optional<std::string>("config_params", "lidar_mode", "a mode", "");
  LidarMode mode;
  if (text.empty()) return mode;
  int rate = 0;
  if (std::sscanf(text.c_str(), "%dx%d", &mode.columns, &rate) != 2 || rate <= 0) {
    document.refuse("config_params", "lidar_mode", "\"" + text + "\"", "a mode such as 1024x10");
  }
  mode.rate_hz = rate;
  return mode;
}

PacketProfile read_profile(const Document& document, const char* format) {
  const auto name = document.optional<std::string>(format, "udp_profile_lidar", "a name",
                                                   to_string(PacketProfile::kLegacy));
  std::string known;
  for (const PacketProfile profile : packet_profiles()) {
    if (name == to_string(profile)) return profile;
    known += (known.empty() ? "" : ", ") + std::string(to_string(profile));
  }
  document.refuse(format, "udp_profile_lidar", name, "one of " + known);
}

/// Firmware 3.2 says which; before, the profile did.
PacketHeader read_header(const Document& document, const char* format, PacketProfile profile) {
  if (profile == PacketProfile::kFusaRng15Rfl8Nir8Dual) return PacketHeader::kFusa;
  const auto name = document.optional<std::string>(format, "header_type", "a name", "STANDARD");
  if (name == "STANDARD") return PacketHeader::kStandard;
  if (name == "FUSA") return PacketHeader::kFusa;
  document.refuse(format, "header_type", name, "STANDARD or FUSA");
}

/// What sensors without the key do: each row moves so that its beams point where the left-most
/// row's do.
std::vector<int> shifts_from_azimuth(const SensorInfo& info) {
  const auto& azimuth = info.beam_azimuth_deg;
  std::vector<int> shifts;
  if (azimuth.empty()) return shifts;
  const double least = *std::min_element(azimuth.begin(), azimuth.end());
  for (const double deg : azimuth) {
    shifts.push_back(static_cast<int>(std::lround((deg - least) * info.columns / 360)));
  }
  return shifts;
}

ColumnWindow read_window(const Document& document, const char* format, int columns) {
  const char* expected = "two columns: the first and the last one";
  const auto ends =
      document.optional<std::vector<int>>(format, "column_window", expected, {0, columns - 1});
  if (ends.size() != 2) {
    document.refuse(format, "column_window", std::to_string(ends.size()) + " values", expected);
  }
  return {ends[0], ends[1]};
}

void read_format(const Document& document, SensorInfo& info) {
  const char* format = document.nested() ? "lidar_data_format" : "data_format";
  const LidarMode mode = read_mode(document);
  if (document.has(format) || mode.columns == 0) {
    info.columns = document.required<int>(format, "columns_per_frame", "a number of columns");
  } else {
    info.columns = mode.columns;
  }
  info.rows = document.has(format)
                  ? document.required<int>(format, "pixels_per_column", "a number of rows")
                  : static_cast<int>(info.beam_altitude_deg.size());
  info.columns_per_packet = document.optional<int>(format, "columns_per_packet", "a number", 16);
  info.frame_rate_hz = document.optional<double>(format, "fps", "a rate in Hz", mode.rate_hz);
  info.profile = read_profile(document, format);
  info.header = read_header(document, format, info.profile);
  info.column_window = read_window(document, format, info.columns);
  info.pixel_shift_by_row = document.optional<std::vector<int>>(
      format, "pixel_shift_by_row", "whole numbers, one a row", shifts_from_azimuth(info));
}

SE3 read_transform(const Document& document, const char* section, const char* key,
                   const std::vector<double>& otherwise) {
  const char* expected = "16 numbers, a rigid motion in mm";
  const auto values =
      document.nested() ? document.required<std::vector<double>>(section, key, expected)
                        : document.optional<std::vector<double>>(section, key, expected, otherwise);
  if (values.size() != 16) {
    document.refuse(section, key, std::to_string(values.size()) + " values", expected);
  }
  SE3 T = SE3::Identity();
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  T.translation() *= kMillimetre;
  const double skew = (T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(skew < 1e-3) || T.linear().determinant() < 0) {
    document.refuse(section, key, "a matrix that is no rotation", expected);
  }
  return T;
}

double default_beam_origin_mm(const std::string& product_line) {
  if (product_line.rfind("OS-0-", 0) == 0) return 27.67;
  if (product_line.rfind("OS-1-", 0) == 0) return 15.806;
  if (product_line.rfind("OS-2-", 0) == 0) return 13.762;
  return 12.163;  // the first generation
}

void read_beams(const Document& document, SensorInfo& info) {
  const char* section = "beam_intrinsics";
  const char* expected = "angles in degrees, one a row";
  using Values = std::vector<double>;
  info.beam_altitude_deg = document.required<Values>(section, "beam_altitude_angles", expected);
  info.beam_azimuth_deg = document.required<Values>(section, "beam_azimuth_angles", expected);
  const char* origin = "lidar_origin_to_beam_origin_mm";
  info.beam_origin_m =
      kMillimetre * (document.nested() && !document.old_firmware()
                         ? document.required<double>(section, origin, "a length in mm")
                         : document.optional<double>(section, origin, "a length in mm",
                                                     default_beam_origin_mm(info.product_line)));
  const auto beam = document.optional<Values>(section, "beam_to_lidar_transform", "16 numbers", {});
  if (beam.empty()) return;
  if (beam.size() != 16) {
    document.refuse(section, "beam_to_lidar_transform", std::to_string(beam.size()) + " values",
                    "16 numbers");
  }
  info.beam_origin_m = kMillimetre * beam[3];
  info.beam_origin_height_m = kMillimetre * beam[11];
}

std::vector<double> millimetres(const SE3& T) {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = T.matrix();
  matrix.topRightCorner<3, 1>() /= kMillimetre;
  return {matrix.data(), matrix.data() + 16};
}

std::string mode_of(const SensorInfo& info) {
  return std::to_string(info.columns) + "x" + std::to_string(std::lround(info.frame_rate_hz));
}

Json format_json(const SensorInfo& info) {
  return {{"columns_per_frame", info.columns},
          {"columns_per_packet", info.columns_per_packet},
          {"pixels_per_column", info.rows},
          {"fps", info.frame_rate_hz},
          {"column_window", {info.column_window.first, info.column_window.last}},
          {"pixel_shift_by_row", info.pixel_shift_by_row},
          {"udp_profile_lidar", to_string(info.profile)},
          {"header_type", info.header == PacketHeader::kFusa ? "FUSA" : "STANDARD"},
          {"udp_profile_imu", "LEGACY"}};
}

Json beams_json(const SensorInfo& info) {
  SE3 beam = SE3::Identity();
  beam.translation() = Eigen::Vector3d(info.beam_origin_m, 0, info.beam_origin_height_m);
  return {{"beam_altitude_angles", info.beam_altitude_deg},
          {"beam_azimuth_angles", info.beam_azimuth_deg},
          {"lidar_origin_to_beam_origin_mm", info.beam_origin_m / kMillimetre},
          {"beam_to_lidar_transform", millimetres(beam)}};
}

}  // namespace

SensorInfo read_metadata(const std::filesystem::path& file) {
  return parse_metadata(core::read_file(file), file.string());
}

SensorInfo parse_metadata(const std::string& json, const std::string& where) {
  const Document document(json, where);
  SensorInfo info;
  info.product_line = document.optional<std::string>("sensor_info", "prod_line", "a name", "");
  info.serial_number = document.optional<std::string>("sensor_info", "prod_sn", "a number", "");
  info.initialization_id =
      document.optional<int>("sensor_info", "initialization_id", "a number", 0);
  read_beams(document, info);
  read_format(document, info);
  const std::vector<double> half_turn = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1};
  const std::vector<double> imu = {1, 0, 0, 6.253, 0, 1, 0, -11.775, 0, 0, 1, 7.645, 0, 0, 0, 1};
  info.T_sensor_lidar =
      read_transform(document, "lidar_intrinsics", "lidar_to_sensor_transform", half_turn);
  info.T_sensor_imu = read_transform(document, "imu_intrinsics", "imu_to_sensor_transform", imu);
  info.lidar_port = document.optional<int>("config_params", "udp_port_lidar", "a port", 7502);
  info.imu_port = document.optional<int>("config_params", "udp_port_imu", "a port", 7503);
  check(info, where);
  return info;
}

std::string metadata_json(const SensorInfo& info) {
  const Json json = {
      {"sensor_info",
       {{"prod_line", info.product_line},
        {"prod_sn", info.serial_number},
        {"initialization_id", info.initialization_id}}},
      {"config_params",
       {{"lidar_mode", mode_of(info)},
        {"udp_port_lidar", info.lidar_port},
        {"udp_port_imu", info.imu_port},
        {"udp_profile_lidar", to_string(info.profile)},
        {"columns_per_packet", info.columns_per_packet}}},
      {"lidar_data_format", format_json(info)},
      {"beam_intrinsics", beams_json(info)},
      {"lidar_intrinsics", {{"lidar_to_sensor_transform", millimetres(info.T_sensor_lidar)}}},
      {"imu_intrinsics", {{"imu_to_sensor_transform", millimetres(info.T_sensor_imu)}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_metadata(const SensorInfo& info, const std::filesystem::path& file) {
  core::write_file(file, metadata_json(info));
}

}  // namespace saker::lidar
