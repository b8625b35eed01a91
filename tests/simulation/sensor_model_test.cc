#include "saker/simulation/sensor/sensor_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace saker::simulation {
namespace {

double elevation_deg(const Eigen::Vector3f& d) { return std::asin(d.z()) * 180 / M_PI; }

/// Beams of one sensor by its name: the number at its end, or what is known of it.
std::size_t beams_by_name(const std::string& name) {
  static const std::map<std::string, std::size_t> kOthers = {
      {"HDL-32E", 32},  {"HDL-64E", 64},    {"VLP-32C", 32}, {"Pandar40", 40}, {"Pandar40P", 40},
      {"Pandar64", 64}, {"Pandar128", 128}, {"XT32", 32},    {"QT64", 64},     {"VLP-32Cx2", 32}};
  const auto known = kOthers.find(name);
  if (known != kOthers.end()) return known->second;
  return static_cast<std::size_t>(std::stoi(name.substr(name.rfind('-') + 1)));
}

int beams_between(const SensorModel& m, double low, double high) {
  return static_cast<int>(std::count_if(m.beams.begin(), m.beams.end(), [&](const BeamAngle& b) {
    return b.elevation_deg >= low && b.elevation_deg <= high;
  }));
}

TEST(SensorModel, EachHasTheBeamsThatItsNameSaysTheHighestFirst) {
  for (const SensorModel& m : sensor_models()) {
    EXPECT_EQ(m.beams.size(), beams_by_name(m.name)) << m.name;
    for (std::size_t i = 1; i < m.beams.size(); ++i)
      EXPECT_LT(m.beams[i].elevation_deg, m.beams[i - 1].elevation_deg) << m.name << " " << i;
  }
}

TEST(SensorModel, NamesOfTheConfigurationAreThoseOfTheTable) {
  const std::vector<std::string> names = enum_names(SensorChoice::mixed);
  ASSERT_EQ(names.size(), sensor_models().size() + 1);
  for (std::size_t i = 1; i < names.size(); ++i)
    EXPECT_EQ(names[i], sensor_model(static_cast<SensorChoice>(i)).name);
}

TEST(SensorModel, Pandar64IsASixthOfADegreeApartInTheMiddleAndADegreeBelow) {
  const SensorModel& m = sensor_model(SensorChoice::pandar64);
  EXPECT_NEAR(m.beams.front().elevation_deg, 15, 0.2);
  EXPECT_NEAR(m.beams.back().elevation_deg, -25, 0.2);
  for (std::size_t i = 6; i < 54; ++i)  // from +2° to -6°
    EXPECT_NEAR(m.beams[i - 1].elevation_deg - m.beams[i].elevation_deg, 0.167, 0.02);
  for (std::size_t i = 54; i < 62; ++i)  // to -14°
    EXPECT_NEAR(m.beams[i - 1].elevation_deg - m.beams[i].elevation_deg, 1, 0.05);
}

TEST(SensorModel, Vlp32cIsDenseNearTheHorizon) {
  const SensorModel& m = sensor_model(SensorChoice::vlp_32c);
  EXPECT_EQ(beams_between(m, -4.1, 1.7), 18);  // every third of a degree
  EXPECT_EQ(m.beams.front().elevation_deg, 15);
  EXPECT_EQ(m.beams.back().elevation_deg, -25);
}

TEST(SensorModel, AUnitsRowsRunFromTheHighestBeamDown) {
  for (std::size_t i = 1; i <= sensor_models().size(); ++i) {
    core::Rng rng(i);
    const SensorUnit unit = make_unit(static_cast<SensorChoice>(i), rng);
    const int beams = static_cast<int>(sensor_models()[i - 1].beams.size());
    EXPECT_EQ(unit.beams.rows, beams * sensor_models()[i - 1].parts);
    if (unit.name == "VLP-32Cx2") continue;  // tilted to each other
    for (int row = 1; row < unit.beams.rows; ++row) {
      EXPECT_LT(elevation_deg(unit.beams.directions[unit.beams.index(row, 7)]),
                elevation_deg(unit.beams.directions[unit.beams.index(row - 1, 7)]))
          << unit.name << " " << row;
    }
  }
}

TEST(SensorModel, AUnitIsCalibratedWithinTenthsOfADegreeOfItsSheet) {
  core::Rng a(1), b(2);
  const SensorUnit one = make_unit(SensorChoice::vls_128, a);
  const SensorUnit other = make_unit(SensorChoice::vls_128, b);
  EXPECT_NE(one.beams.directions[100], other.beams.directions[100]);
  const SensorModel& m = sensor_model(SensorChoice::vls_128);
  for (int row = 0; row < 128; ++row) {
    EXPECT_NEAR(elevation_deg(one.beams.directions[one.beams.index(row, 0)]),
                m.beams[static_cast<std::size_t>(row)].elevation_deg, 0.5);
  }
}

TEST(SensorModel, TheSecondOfTwoStackedOnesIsBelowTheFirst) {
  core::Rng rng(4);
  const SensorUnit unit = make_unit(SensorChoice::vlp_32c_pair, rng);
  int lower = 0;
  for (int row = 0; row < unit.beams.rows; ++row) {
    const float height = unit.beams.origins[unit.beams.index(row, 0)].z();
    const bool second = unit.part_of_row[static_cast<std::size_t>(row)] == 1;
    EXPECT_EQ(height < -0.05F, second);
    lower += second;
  }
  EXPECT_EQ(lower, 32);
}

TEST(SensorModel, MixedDrawsManyAndANameDrawsItself) {
  core::Rng rng(1);
  std::set<SensorChoice> drawn;
  for (int k = 0; k < 500; ++k) drawn.insert(any_sensor(SensorChoice::mixed, rng));
  EXPECT_EQ(drawn.size(), sensor_models().size());
  EXPECT_EQ(any_sensor(SensorChoice::qt64, rng), SensorChoice::qt64);
}

TEST(SensorModel, EveryReceiverIsWithinItsBounds) {
  for (const SensorModel& m : sensor_models()) {
    EXPECT_NO_THROW((void)core::checked(m.receiver, m.name)) << m.name;
    EXPECT_LT(m.receiver.min_range_m, m.receiver.max_range_m) << m.name;
    EXPECT_GT(m.weight, 0) << m.name;
  }
}

TEST(SensorModel, AnOusterSeesHalfAnglesOfItsLine) {
  for (const SensorModel& m : sensor_models()) {
    if (m.ouster_origin_m == 0) continue;
    const double half = m.name.starts_with("OS0") ? 45 : m.name.starts_with("OS1") ? 22.5 : 11.25;
    EXPECT_NEAR(m.beams.front().elevation_deg, half, 1e-9) << m.name;
    EXPECT_NEAR(m.beams.back().elevation_deg, -half, 1e-9) << m.name;
  }
}

TEST(SensorModel, AUnitTurnsAtItsTypesRate) {
  for (std::size_t i = 0; i < sensor_models().size(); ++i) {
    core::Rng rng(i);
    const SensorUnit unit = make_unit(static_cast<SensorChoice>(i + 1), rng);
    const double rate = unit.name == "HDL-32E" ? 20 : 10;
    EXPECT_NEAR(unit.period_s, 1 / rate, 1e-12) << unit.name;
  }
}

TEST(SensorModel, EveryBeamOfAUnitIsOfUnitLength) {
  for (std::size_t i = 0; i < sensor_models().size(); ++i) {
    core::Rng rng(i);
    const SensorUnit unit = make_unit(static_cast<SensorChoice>(i + 1), rng);
    ASSERT_EQ(unit.beams.directions.size(), unit.beams.origins.size());
    ASSERT_EQ(unit.beams.directions.size(),
              static_cast<std::size_t>(unit.beams.rows) * unit.beams.columns);
    ASSERT_EQ(unit.part_of_row.size(), static_cast<std::size_t>(unit.beams.rows));
    for (const Eigen::Vector3f& beam : unit.beams.directions) ASSERT_NEAR(beam.norm(), 1, 1e-5);
  }
}

TEST(SensorModel, ColumnsTurnClockwiseOnceAround) {
  for (const SensorChoice choice : {SensorChoice::vlp_16, SensorChoice::pandar40,
                                    SensorChoice::hdl_64e, SensorChoice::os1_32}) {
    core::Rng rng(4);
    const BeamTable beams = make_unit(choice, rng).beams;
    double turned = 0;
    for (int column = 1; column < beams.columns; ++column) {
      const auto azimuth = [&](int c) {
        const Eigen::Vector3f& d = beams.directions[beams.index(beams.rows / 2, c)];
        return std::atan2(d.y(), d.x());
      };
      const double step = std::remainder(azimuth(column) - azimuth(column - 1), 2 * M_PI);
      ASSERT_LT(step, 0);
      turned += step;
    }
    EXPECT_NEAR(turned, -2 * M_PI * (beams.columns - 1) / beams.columns, 1e-2);
  }
}

TEST(SensorModel, UnitsOfOneTypeScatterBySeveralTimes) {
  const double nominal = sensor_model(SensorChoice::vlp_16).receiver.noise_m;
  double least = 1, most = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    core::Rng rng(seed);
    const double noise = make_unit(SensorChoice::vlp_16, rng).receiver.noise_m;
    least = std::min(least, noise);
    most = std::max(most, noise);
    EXPECT_GE(noise, nominal * std::exp(-1.001));
    EXPECT_LE(noise, nominal * std::exp(1.001));
  }
  EXPECT_GT(most, 5 * least);
}

TEST(SensorModel, BeamsFarAsideLookWhereTheirColumnWillBe) {
  core::Rng rng(2);
  const BeamTable beams = make_unit(SensorChoice::vls_128, rng).beams;
  const std::vector<BeamAngle>& sheet = sensor_model(SensorChoice::vls_128).beams;
  const auto azimuth_deg = [&](int row) {
    const Eigen::Vector3f& d = beams.directions[beams.index(row, 0)];
    return std::atan2(d.y(), d.x()) * 180 / M_PI;
  };
  const double apart = std::remainder(azimuth_deg(3) - azimuth_deg(4), 360);
  const double said = sheet[4].azimuth_deg - sheet[3].azimuth_deg;  // ahead is clockwise
  EXPECT_NEAR(apart, said, 0.3);
}

TEST(SensorModel, FourBeamsOfFiveAnswerAtTheSheetsRangeOfTenPercent) {
  const ReceiverConfig& qt = sensor_model(SensorChoice::qt64).receiver;
  EXPECT_NEAR(1 - std::exp(-0.1 / (20.0 * 20 * qt.sensitivity)), 1 - std::exp(-1.6), 1e-9);
}

}  // namespace
}  // namespace saker::simulation
