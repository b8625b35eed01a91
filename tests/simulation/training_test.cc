#include "saker/simulation/mission/training.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "saker/core/files.h"

namespace saker::simulation {
namespace {

std::filesystem::path scans(const std::string& name, std::uint64_t seed,
                            TrainingConfig config = {.worlds = 3, .scans_per_world = 1},
                            int threads = 1) {
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  write_training_scans(config, seed, folder, nullptr, threads);
  return folder;
}

template <class T>
std::vector<T> values_of(const std::filesystem::path& file) {
  const std::string bytes = core::read_file(file);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// Elevations by ring, of one scan in the sensor's frame.
std::map<int, std::vector<double>> elevations(const std::filesystem::path& folder,
                                              const std::string& name) {
  const auto points = values_of<float>(folder / "velodyne" / (name + ".bin"));
  const auto rings = values_of<std::uint16_t>(folder / "ring" / (name + ".u16"));
  EXPECT_EQ(points.size(), 4 * rings.size());
  std::map<int, std::vector<double>> by_ring;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double level = std::hypot(points[4 * i], points[4 * i + 1]);
    by_ring[rings[i]].push_back(std::atan2(points[4 * i + 2], level) * 180 / M_PI);
  }
  return by_ring;
}

TEST(Training, TwoRunsAreByteIdenticalAndAnotherSeedIsNot) {
  const auto a = scans("training_a", 1);
  const auto b = scans("training_b", 1);
  const auto c = scans("training_c", 2);
  const auto scan = [](const std::filesystem::path& f) {
    return core::read_file(f / "velodyne/000002.bin");
  };
  EXPECT_EQ(scan(a), scan(b));
  EXPECT_NE(scan(a), scan(c));
}

TEST(Training, ScansHoldFinitePointsAndTheClassesThatAreLearned) {
  const auto folder = scans("training_d", 3, {.worlds = 3, .scans_per_world = 2});
  std::map<std::uint32_t, int> count;
  for (const char* name : {"000000", "000001", "000002", "000003", "000004", "000005"}) {
    const std::string points = core::read_file(folder / "velodyne" / (std::string(name) + ".bin"));
    const std::string labels = core::read_file(folder / "labels" / (std::string(name) + ".label"));
    ASSERT_EQ(points.size(), 4 * labels.size());
    std::vector<float> values(points.size() / 4);
    std::memcpy(values.data(), points.data(), points.size());
    for (const float v : values) ASSERT_TRUE(std::isfinite(v));
    std::vector<std::uint32_t> ids(labels.size() / 4);
    std::memcpy(ids.data(), labels.data(), labels.size());
    for (const std::uint32_t id : ids) ++count[id & 0xFFFF];
  }
  for (const int label : {kCar, kRoad, kTerrain, kVegetation, kTrunk, kPole}) {
    EXPECT_GT(count[label], 20) << label;
  }
}

TEST(Training, AnotherSensorSeesTheSameWorldFromTheSamePlaces) {
  const TrainingConfig pandar{.worlds = 2, .scans_per_world = 2, .sensor = SensorChoice::pandar64};
  const TrainingConfig vlp{.worlds = 2, .scans_per_world = 2, .sensor = SensorChoice::vlp_16};
  const auto a = scans("training_e", 4, pandar);
  const auto b = scans("training_f", 4, vlp);
  EXPECT_EQ(core::read_file(a / "poses.txt"), core::read_file(b / "poses.txt"));
  EXPECT_NE(core::read_file(a / "velodyne/000001.bin"), core::read_file(b / "velodyne/000001.bin"));
}

TEST(Training, TwoThreadsWriteWhatOneWrites) {
  const TrainingConfig config{.worlds = 1, .scans_per_world = 3};
  const auto a = scans("training_g", 5, config, 1);
  const auto b = scans("training_h", 5, config, 2);
  for (const char* file : {"velodyne/000002.bin", "ring/000002.u16", "sensors.csv", "poses.txt"})
    EXPECT_EQ(core::read_file(a / file), core::read_file(b / file)) << file;
}

TEST(Training, RingsAreTheBeamsTheHighestFirst) {
  const TrainingConfig config{.worlds = 2, .scans_per_world = 3, .sensor = SensorChoice::pandar64};
  const auto folder = scans("training_i", 6, config);
  std::istringstream table(core::read_file(folder / "sensors.csv"));
  std::string line;
  int checked = 0;
  std::getline(table, line);
  while (std::getline(table, line)) {
    const bool as_sensed = line.find(",raw,lidar,") != std::string::npos ||
                           line.find(",0.00,compensated,lidar,") != std::string::npos;
    if (!as_sensed) continue;
    ++checked;
    double above = 90;
    for (const auto& [ring, angles] : elevations(folder, line.substr(0, 6))) {
      const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
      EXPECT_LT(*high - *low, 0.01) << line << " ring " << ring;
      EXPECT_LT(*high, above);
      above = *low;
    }
  }
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace saker::simulation
