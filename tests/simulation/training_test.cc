#include "simulation/training.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "core/files.h"

namespace saker::simulation {
namespace {

std::filesystem::path scans(const std::string& name, std::uint64_t seed) {
  TrainingConfig config;
  config.worlds = 3;
  config.scans_per_world = 1;
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  write_training_scans(config, seed, folder, nullptr);
  return folder;
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
  const auto folder = scans("training_d", 3);
  std::map<std::uint32_t, int> count;
  for (const char* name : {"000000", "000001", "000002"}) {
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

}  // namespace
}  // namespace saker::simulation
