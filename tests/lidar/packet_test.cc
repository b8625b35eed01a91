#include "saker/lidar/packet.h"

#include <gtest/gtest.h>

#include "made_sensor.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

/// Of each profile, a packet's size by the vendor's manual for 128 rows and 16 columns.
std::size_t documented_bytes(PacketProfile profile) {
  switch (profile) {
    case PacketProfile::kLegacy:
      return 24896;
    case PacketProfile::kRng19Rfl8Sig16Nir16:
      return 24832;
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      return 33024;
    case PacketProfile::kRng15Rfl8Nir8:
    case PacketProfile::kRng15Rfl8Win8:
      return 8448;
    case PacketProfile::kRng15Rfl8Nir8Dual:
    case PacketProfile::kFusaRng15Rfl8Nir8Dual:
    case PacketProfile::kRng15Rfl8Nir8Zone16:
      return 16640;
    case PacketProfile::kRng19Rfl8Sig16Nir16Zone16:
      return 24832;
    case PacketProfile::kRng19Rfl8Sig16Zone16Dual:
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16:
      return 33024;
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16Dual:
    case PacketProfile::kFiveWordPixel:
      return 41216;
  }
  return 0;
}

Column random_column(const SensorInfo& info, core::Rng& rng) {
  Column column;
  column.time = 1'600'000'000'000'000'000 + rng.index(1'000'000'000);
  column.frame_id = 40000;
  column.measurement_id = rng.index(info.columns);
  for (int row = 0; row < info.rows; ++row) {
    Pixel pixel;
    pixel.range_mm = static_cast<std::uint32_t>(8 * rng.index(32768));
    pixel.reflectivity = static_cast<std::uint8_t>(rng.index(256));
    const std::string fields = to_string(info.profile);
    const bool words =
        info.profile == PacketProfile::kLegacy || info.profile == PacketProfile::kFiveWordPixel;
    if (words || fields.find("SIG16") != std::string::npos) {
      pixel.signal = static_cast<std::uint16_t>(rng.index(65536));
    }
    if (words || fields.find("NIR") != std::string::npos) {
      pixel.near_infrared = static_cast<std::uint16_t>(16 * rng.index(256));
    }
    column.pixels.push_back(pixel);
  }
  return column;
}

class EveryProfile : public ::testing::TestWithParam<PacketProfile> {};
INSTANTIATE_TEST_SUITE_P(Packet, EveryProfile, ::testing::ValuesIn(packet_profiles()),
                         [](const auto& p) { return std::string(to_string(p.param)); });

TEST_P(EveryProfile, HasTheDocumentedSize) {
  const PacketFormat format(SensorInfo::make_os1(128, 1024, GetParam()));
  EXPECT_EQ(format.packet_bytes(), documented_bytes(GetParam()));
}

TEST_P(EveryProfile, EveryFieldSurvivesEncodingAndDecoding) {
  core::Rng rng(7);
  for (const int rows : {16, 32, 64, 128}) {
    const SensorInfo info = SensorInfo::make_os1(rows, 1024, GetParam());
    const PacketFormat format(info);
    std::vector<Column> columns;
    for (int i = 0; i < 16; ++i) columns.push_back(random_column(info, rng));
    columns[3].valid = false;
    const auto packet = format.encode(columns);
    ASSERT_EQ(packet.size(), format.packet_bytes());
    for (int i = 0; i < 16; ++i) {
      const Column decoded = format.column(packet, i);
      EXPECT_EQ(decoded.time, columns[i].time);
      EXPECT_EQ(decoded.frame_id, 40000);
      EXPECT_EQ(decoded.measurement_id, columns[i].measurement_id);
      EXPECT_EQ(decoded.valid, i != 3);
      EXPECT_EQ(decoded.pixels, columns[i].pixels);
    }
  }
}

TEST_P(EveryProfile, TheFastReaderAgreesWithTheWholeOne) {
  core::Rng rng(8);
  const SensorInfo info = SensorInfo::make_os1(64, 512, GetParam());
  const PacketFormat format(info);
  const std::vector<Column> columns = {random_column(info, rng)};
  const auto packet = format.encode(columns);
  std::vector<std::uint32_t> ranges(64 * 3);
  std::vector<std::uint8_t> reflectivity(64 * 3);
  format.read_column(packet, 0, ranges.data(), reflectivity.data(), 3);
  for (int row = 0; row < 64; ++row) {
    EXPECT_EQ(ranges[3 * row], columns[0].pixels[row].range_mm);
    EXPECT_EQ(reflectivity[3 * row], columns[0].pixels[row].reflectivity);
  }
}

TEST_P(EveryProfile, ColumnsThatAreNotGivenAreNotValid) {
  const SensorInfo info = SensorInfo::make_os1(16, 512, GetParam());
  const PacketFormat format(info);
  const std::vector<Column> one = {testing::made_column(info, 0, 5, 32)};
  const auto packet = format.encode(one);
  EXPECT_TRUE(format.valid(packet, 0));
  for (int i = 1; i < 16; ++i) EXPECT_FALSE(format.valid(packet, i));
}

TEST_P(EveryProfile, ARangeThatDoesNotFitIsNoReturn) {
  const PacketFormat format(SensorInfo::make_os1(16, 512, GetParam()));
  EXPECT_EQ(format.representable_mm(4'000'000), 0U);
  EXPECT_EQ(format.representable_mm(8000), 8000U);
}

TEST(Packet, Rng15RoundsDownToEightMillimetres) {
  const PacketFormat format(SensorInfo::make_os1(16, 512, PacketProfile::kRng15Rfl8Nir8));
  EXPECT_EQ(format.representable_mm(8007), 8000U);
  EXPECT_EQ(format.representable_mm(262143), 262136U);
  EXPECT_EQ(format.representable_mm(262144), 0U);
}

TEST(Packet, SaysWhoSentIt) {
  for (const PacketProfile profile : packet_profiles()) {
    SensorInfo info = SensorInfo::make_os1(16, 512, profile);
    info.serial_number = "122246000293";
    info.initialization_id = 390076;
    core::Rng rng(3);
    const PacketFormat format(info);
    const std::vector<Column> columns = {random_column(info, rng)};
    const auto sender = format.sender(format.encode(columns));
    ASSERT_EQ(sender.has_value(), profile != PacketProfile::kLegacy);
    if (!sender) continue;
    EXPECT_EQ(sender->serial_number, 122246000293U) << to_string(profile);
    EXPECT_EQ(sender->initialization_id, 390076U) << to_string(profile);
  }
}

TEST(Packet, FunctionalSafetySensorsCountFramesBeyond16Bits) {
  const SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kFusaRng15Rfl8Nir8Dual);
  const PacketFormat format(info);
  core::Rng rng(3);
  Column column = random_column(info, rng);
  column.frame_id = 1'000'003;
  EXPECT_EQ(format.frame_id(format.encode(std::vector<Column>{column}), 0), 1'000'003);
}

}  // namespace
}  // namespace saker::lidar
