#include "saker/simulation/sensor/sensor_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace saker::simulation {
namespace {

/// What a maker's sheet says of its beams.
struct Sheet {
  const char* name;
  std::vector<BeamAngle> beams;
  std::size_t count;
  double highest_deg, lowest_deg;
  double finest_deg;        ///< between neighbours
  double most_azimuth_deg;  ///< of a laser's offset
};

std::vector<Sheet> sheets() {
  return {{"HDL-64E", hdl64_angles(), 64, 2, -24.33, 1 / 3.0, 0},
          {"VLP-32C", vlp32c_angles(), 32, 15, -25, 1 / 3.0, 4.2},
          {"VLS-128", vls128_angles(), 128, 15, -25, 0.11, 6.354},
          {"Pandar40", pandar40_angles(), 40, 7, -16, 1 / 3.0, 2.5},
          {"Pandar40P", pandar40p_angles(), 40, 14.882, -24.897, 1 / 3.0, 5.208},
          {"Pandar64", pandar64_angles(), 64, 14.882, -24.897, 1 / 6.0, 5.208},
          {"Pandar128", pandar128_angles(), 128, 15.139, -24.71, 0.11, 4.677},
          {"QT64", qt64_angles(), 64, 52.133, -52.121, 1.45, 8.736}};
}

double finest(const std::vector<BeamAngle>& beams) {
  double least = 90;
  for (std::size_t i = 1; i < beams.size(); ++i)
    least = std::min(least, beams[i - 1].elevation_deg - beams[i].elevation_deg);
  return least;
}

TEST(SensorTables, EachHasAsManyBeamsAsItsSheetSays) {
  for (const Sheet& sheet : sheets()) EXPECT_EQ(sheet.beams.size(), sheet.count) << sheet.name;
}

TEST(SensorTables, EachLooksFromItsHighestToItsLowestBeam) {
  for (const Sheet& sheet : sheets()) {
    EXPECT_NEAR(sheet.beams.front().elevation_deg, sheet.highest_deg, 1e-9) << sheet.name;
    EXPECT_NEAR(sheet.beams.back().elevation_deg, sheet.lowest_deg, 0.01) << sheet.name;
  }
}

TEST(SensorTables, BeamsRunDownwardsWithoutRepetition) {
  for (const Sheet& sheet : sheets()) EXPECT_GT(finest(sheet.beams), 0.05) << sheet.name;
}

TEST(SensorTables, TheFinestStepIsTheResolutionOfTheSheet) {
  for (const Sheet& sheet : sheets())
    EXPECT_NEAR(finest(sheet.beams), sheet.finest_deg, 0.1 * sheet.finest_deg) << sheet.name;
}

TEST(SensorTables, NoLaserLooksFartherAsideThanTheSheetSays) {
  for (const Sheet& sheet : sheets()) {
    double most = 0;
    for (const BeamAngle& beam : sheet.beams) most = std::max(most, std::abs(beam.azimuth_deg));
    EXPECT_DOUBLE_EQ(most, sheet.most_azimuth_deg) << sheet.name;
  }
}

/// Lasers in columns: neighbours in elevation do not stand above each other.
TEST(SensorTables, OfDenseSensorsNeighboursLookToOtherAzimuths) {
  for (const auto& beams : {vls128_angles(), vlp32c_angles()}) {
    for (std::size_t i = 1; i < beams.size(); ++i)
      EXPECT_NE(beams[i].azimuth_deg, beams[i - 1].azimuth_deg) << i;
  }
}

TEST(SensorTables, Vlp32cHasItsFourColumnsOfLasers) {
  std::map<double, int> columns;
  for (const BeamAngle& beam : vlp32c_angles()) ++columns[beam.azimuth_deg];
  ASSERT_EQ(columns.size(), 4U);
  EXPECT_EQ(columns[-4.2], columns[4.2]);
  EXPECT_EQ(columns[-1.4], columns[1.4]);
}

TEST(SensorTables, Vls128HasSixteenBeamsInEachOfItsEightColumns) {
  std::map<double, int> columns;
  for (const BeamAngle& beam : vls128_angles()) ++columns[beam.azimuth_deg];
  ASSERT_EQ(columns.size(), 8U);
  for (const auto& [azimuth, count] : columns) EXPECT_EQ(count, 16) << azimuth;
}

TEST(SensorTables, HalfTheBeamsOfAnHdl64AreInItsUpperBlock) {
  const std::vector<BeamAngle> beams = hdl64_angles();
  EXPECT_NEAR(beams[30].elevation_deg - beams[31].elevation_deg, 1 / 3.0, 1e-9);
  EXPECT_NEAR(beams[31].elevation_deg, 2 - 31 / 3.0, 1e-9);
  EXPECT_NEAR(beams[32].elevation_deg, -8.83, 1e-9);
  EXPECT_NEAR(beams[32].elevation_deg - beams[33].elevation_deg, 0.5, 1e-9);
}

TEST(SensorTables, APandar40IsAThirdOfADegreeApartNearTheHorizonAndADegreeOutside) {
  const std::vector<BeamAngle> beams = pandar40_angles();
  for (std::size_t i = 1; i < beams.size(); ++i) {
    const double step = beams[i - 1].elevation_deg - beams[i].elevation_deg;
    const bool inside = beams[i - 1].elevation_deg <= 2.01 && beams[i].elevation_deg >= -6.01;
    EXPECT_NEAR(step, inside ? 1 / 3.0 : 1, 1e-9) << i;
  }
}

TEST(SensorTables, AQt64LooksAsFarUpAsDown) {
  const std::vector<BeamAngle> beams = qt64_angles();
  for (std::size_t i = 0; i < beams.size(); ++i) {
    EXPECT_NEAR(beams[i].elevation_deg, -beams[beams.size() - 1 - i].elevation_deg, 0.02) << i;
  }
}

TEST(EvenBeams, AreEquallyFarApartFromTheHighestToTheLowest) {
  for (const int count : {2, 16, 32, 128}) {
    const std::vector<BeamAngle> beams = even_beams(count, 22.5, -22.5);
    ASSERT_EQ(beams.size(), static_cast<std::size_t>(count));
    EXPECT_DOUBLE_EQ(beams.front().elevation_deg, 22.5);
    EXPECT_DOUBLE_EQ(beams.back().elevation_deg, -22.5);
    for (std::size_t i = 1; i < beams.size(); ++i) {
      EXPECT_NEAR(beams[i - 1].elevation_deg - beams[i].elevation_deg, 45.0 / (count - 1), 1e-9);
      EXPECT_EQ(beams[i].azimuth_deg, 0);
    }
  }
}

}  // namespace
}  // namespace saker::simulation
