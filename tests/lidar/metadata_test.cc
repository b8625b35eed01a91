#include "saker/lidar/metadata.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "made_sensor.h"
#include "saker/core/error.h"

namespace saker::lidar {
namespace {

using Json = nlohmann::json;

Json flat() {
  return Json::parse(R"({
    "prod_line": "OS-1-16", "prod_sn": "992101000280", "lidar_mode": "1024x20",
    "beam_altitude_angles": [15, 13, 11, 9, 7, 5, 3, 1, -1, -3, -5, -7, -9, -11, -13, -15],
    "beam_azimuth_angles": [3.164, 1.055, -1.055, -3.164, 3.164, 1.055, -1.055, -3.164,
                            3.164, 1.055, -1.055, -3.164, 3.164, 1.055, -1.055, -3.164],
    "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1],
    "imu_to_sensor_transform": [1, 0, 0, 6.253, 0, 1, 0, -11.775, 0, 0, 1, 7.645, 0, 0, 0, 1]})");
}

std::string message_of(const Json& json) {
  try {
    (void)parse_metadata(json.dump(), "sensor.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_equal(const SensorInfo& a, const SensorInfo& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.columns_per_packet, b.columns_per_packet);
  EXPECT_EQ(a.frame_rate_hz, b.frame_rate_hz);
  EXPECT_EQ(a.profile, b.profile);
  EXPECT_EQ(a.column_window.first, b.column_window.first);
  EXPECT_EQ(a.column_window.last, b.column_window.last);
  EXPECT_EQ(a.pixel_shift_by_row, b.pixel_shift_by_row);
  EXPECT_EQ(a.beam_altitude_deg, b.beam_altitude_deg);
  EXPECT_EQ(a.beam_azimuth_deg, b.beam_azimuth_deg);
  EXPECT_NEAR(a.beam_origin_m, b.beam_origin_m, 1e-12);
  EXPECT_TRUE(a.T_sensor_lidar.isApprox(b.T_sensor_lidar));
  EXPECT_TRUE(a.T_sensor_imu.isApprox(b.T_sensor_imu));
  EXPECT_EQ(a.lidar_port, b.lidar_port);
  EXPECT_EQ(a.serial_number, b.serial_number);
}

TEST(Metadata, WhatIsWrittenReadsBackTheSame) {
  for (const PacketProfile profile : packet_profiles()) {
    SensorInfo info = SensorInfo::make_os1(32, 2048, profile);
    info.column_window = {2000, 47};
    info.lidar_port = 53750;
    info.frame_rate_hz = 10;
    info.serial_number = "992210000957";
    expect_equal(parse_metadata(metadata_json(info), "made"), info);
  }
}

TEST(Metadata, FlatFormWithoutAFormatGetsTheVendorsDefaults) {
  const SensorInfo info = parse_metadata(flat().dump(), "flat");
  EXPECT_EQ(info.profile, PacketProfile::kLegacy);
  EXPECT_EQ(info.rows, 16);
  EXPECT_EQ(info.columns, 1024);
  EXPECT_EQ(info.frame_rate_hz, 20);
  EXPECT_EQ(info.column_window.size(info.columns), 1024);
  EXPECT_NEAR(info.beam_origin_m, 0.015806, 1e-12);  // of an OS-1
  const std::vector<int> shifts(info.pixel_shift_by_row.begin(),
                                info.pixel_shift_by_row.begin() + 4);
  EXPECT_EQ(shifts, (std::vector<int>{18, 12, 6, 0}));
}

TEST(Metadata, FormatOverridesTheMode) {
  Json json = flat();
  json["data_format"] = {{"columns_per_frame", 512},
                         {"column_window", {500, 11}},
                         {"udp_profile_lidar", "RNG15_RFL8_NIR8"},
                         {"pixels_per_column", 16}};
  const SensorInfo info = parse_metadata(json.dump(), "flat");
  EXPECT_EQ(info.columns, 512);
  EXPECT_EQ(info.profile, PacketProfile::kRng15Rfl8Nir8);
  EXPECT_EQ(info.column_window.size(512), 24);
}

TEST(Metadata, TransformsAreInMetres) {
  const SensorInfo info = parse_metadata(flat().dump(), "flat");
  EXPECT_NEAR(info.T_sensor_lidar.translation().z(), 0.03618, 1e-12);
  EXPECT_NEAR(info.T_sensor_imu.translation().y(), -0.011775, 1e-12);
  EXPECT_TRUE(
      (info.T_sensor_lidar * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(-1, 0, 0.03618)));
}

TEST(Metadata, MissingKeysAreNamedWithTheFile) {
  for (const char* key : {"beam_altitude_angles", "beam_azimuth_angles"}) {
    Json json = flat();
    json.erase(key);
    const std::string message = message_of(json);
    EXPECT_NE(message.find("sensor.json"), std::string::npos) << message;
    EXPECT_NE(message.find(std::string(key) + ": missing"), std::string::npos) << message;
  }
  Json json = flat();
  json.erase("lidar_mode");
  EXPECT_NE(message_of(json).find("columns_per_frame: missing"), std::string::npos);
}

TEST(Metadata, EveryKeyOfGeometryIsRequiredInTheNestedForm) {
  const Json whole = Json::parse(
      metadata_json(SensorInfo::make_os1(64, 1024, PacketProfile::kRng19Rfl8Sig16Nir16)));
  const std::vector<std::pair<std::string, std::string>> keys = {
      {"beam_intrinsics", "beam_altitude_angles"},
      {"beam_intrinsics", "beam_azimuth_angles"},
      {"beam_intrinsics", "lidar_origin_to_beam_origin_mm"},
      {"lidar_intrinsics", "lidar_to_sensor_transform"},
      {"imu_intrinsics", "imu_to_sensor_transform"}};
  for (const auto& [section, key] : keys) {
    Json json = whole;
    json[section].erase(key);
    EXPECT_NE(message_of(json).find(section + "." + key + ": missing"), std::string::npos)
        << message_of(json);
  }
}

TEST(Metadata, WrongValuesAreNamed) {
  const std::vector<std::pair<std::string, Json>> wrong = {
      {"beam_altitude_angles", "high"},
      {"beam_altitude_angles", Json::array({1, 2, "three"})},
      {"beam_azimuth_angles", Json::array({1.0, 2.0})},
      {"lidar_mode", "fast"},
      {"lidar_to_sensor_transform", Json::array({1, 2, 3})},
      {"imu_to_sensor_transform", Json(std::vector<double>(16, 1.0))}};
  for (const auto& [key, value] : wrong) {
    Json json = flat();
    json[key] = value;
    const std::string message = message_of(json);
    EXPECT_NE(message.find(key), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(Metadata, WrongFormatsAreNamed) {
  const std::vector<std::pair<std::string, Json>> wrong = {
      {"udp_profile_lidar", "RNG99"},    {"pixels_per_column", 17},
      {"columns_per_frame", 1000},       {"columns_per_packet", 0},
      {"column_window", {0, 1024}},      {"column_window", Json::array({0})},
      {"pixel_shift_by_row", {1, 2, 3}}, {"columns_per_frame", 1024.5},
      {"columns_per_packet", 1e300},     {"column_window", {-1, 12}}};
  for (const auto& [key, value] : wrong) {
    Json json = flat();
    json["data_format"] = {{"columns_per_frame", 1024}, {"pixels_per_column", 16}};
    json["data_format"][key] = value;
    EXPECT_NE(message_of(json).find(key), std::string::npos) << message_of(json);
  }
}

TEST(Metadata, WhatIsNoJsonObjectIsRefused) {
  for (const char* text : {"", "{", "[]", "null", "12", "\xff\xfe"}) {
    EXPECT_THROW((void)parse_metadata(text, "file"), Error) << text;
  }
}

TEST(Metadata, AFileThatIsNotThereIsNamed) {
  try {
    (void)read_metadata("/nowhere/sensor.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/sensor.json"), std::string::npos);
  }
}

TEST(Metadata, FilesRoundTrip) {
  const testing::TemporaryFolder folder;
  const SensorInfo info = SensorInfo::make_os1(128, 512, PacketProfile::kRng15Rfl8Nir8);
  write_metadata(info, folder / "a.json");
  expect_equal(read_metadata(folder / "a.json"), info);
}

Json nested() {
  return Json::parse(
      metadata_json(SensorInfo::make_os1(64, 1024, PacketProfile::kRng19Rfl8Sig16Nir16)));
}

TEST(Metadata, SectionsThatOldFirmwareDoesNotKnowGetTheDefaults) {
  Json json = nested();
  json["lidar_data_format"] = "error: Command not recognized.";
  json["calibration_status"] = "error: Command not recognized.";
  json["client_version"] = "ouster_client 0.2.2";
  json["beam_intrinsics"].erase("lidar_origin_to_beam_origin_mm");
  json["beam_intrinsics"].erase("beam_to_lidar_transform");
  json["sensor_info"]["prod_line"] = "OS-1-64";
  const SensorInfo info = parse_metadata(json.dump(), "old");
  EXPECT_EQ(info.profile, PacketProfile::kLegacy);
  EXPECT_EQ(info.columns, 1024);
  EXPECT_EQ(info.rows, 64);
}

TEST(Metadata, AMixtureOfBothFormsIsRefusedByItsKey) {
  Json json = nested();
  json["prod_line"] = "OS-1-64";
  EXPECT_NE(message_of(json).find("prod_line"), std::string::npos) << message_of(json);
  json = flat();
  json["calibration_status"] = {{"reflectivity", {{"valid", true}}}};
  EXPECT_NE(message_of(json).find("calibration_status"), std::string::npos) << message_of(json);
}

TEST(Metadata, WhatAVendorsClientWroteHasEverySection) {
  Json json = nested();
  json["client_version"] = "ouster_client 0.5.3";
  json["calibration_status"] = {{"reflectivity", {{"valid", true}}}};
  EXPECT_EQ(message_of(json), "accepted");
  for (const char* section : {"calibration_status", "sensor_info"}) {
    Json without = json;
    without.erase(section);
    EXPECT_NE(message_of(without).find(std::string(section) + ": missing"), std::string::npos);
  }
}

TEST(Metadata, AFormatHasItsRowsAndColumns) {
  for (const char* key : {"columns_per_frame", "pixels_per_column"}) {
    Json json = nested();
    json["lidar_data_format"].erase(key);
    EXPECT_NE(message_of(json).find(std::string(key) + ": missing"), std::string::npos);
  }
}

TEST(Metadata, BeamsThatAreAllZeroAreRefused) {
  Json json = nested();
  json["beam_intrinsics"]["beam_altitude_angles"] = std::vector<int>(64, 0);
  EXPECT_NE(message_of(json).find("beam_altitude_angles: all 0"), std::string::npos);
}

TEST(Metadata, AnUnknownProfileIsNamedWithThoseThatAreKnown) {
  Json json = nested();
  json["lidar_data_format"]["udp_profile_lidar"] = "RNG99";
  const std::string message = message_of(json);
  EXPECT_NE(message.find("RNG99"), std::string::npos);
  EXPECT_NE(message.find("RNG15_RFL8_NIR8_DUAL"), std::string::npos);
}

TEST(Metadata, FunctionalSafetyHeadsAreToldByTheProfileOrTheirKey) {
  Json json = nested();
  EXPECT_EQ(parse_metadata(json.dump(), "a").header, PacketHeader::kStandard);
  json["lidar_data_format"]["header_type"] = "FUSA";
  EXPECT_EQ(parse_metadata(json.dump(), "a").header, PacketHeader::kFusa);
  json["lidar_data_format"]["header_type"] = "OTHER";
  EXPECT_NE(message_of(json).find("header_type: OTHER"), std::string::npos);
}

}  // namespace
}  // namespace saker::lidar
