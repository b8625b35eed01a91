#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "paths.h"
#include "saker/core/files.h"
#include "saker/lidar/kitti_folder.h"
#include "saker/segmentation/segmentation.h"

namespace saker::segmentation {
namespace {

namespace fs = std::filesystem;

const fs::path kData = source_dir() + "/../shared/data";
constexpr std::array<std::uint32_t, 5> kIgnored = {0, 1, 52, 81, 99};  // ids that do not count

std::vector<std::uint32_t> true_ids(const fs::path& file) {
  const std::string bytes = core::read_file(file);
  std::vector<std::uint32_t> ids(bytes.size() / 4);
  std::copy_n(bytes.begin(), ids.size() * 4, reinterpret_cast<char*>(ids.data()));
  for (std::uint32_t& id : ids) id &= 0xFFFF;
  return ids;
}

/// Intersection over union per class, over all points that count.
class Score {
 public:
  void add(const lidar::Labels& labels, const std::vector<std::uint32_t>& truth,
           const objects::ClassTable& table) {
    ASSERT_EQ(labels.classes.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (std::find(kIgnored.begin(), kIgnored.end(), truth[i]) != kIgnored.end()) continue;
      const std::uint8_t expected = table.of_label(truth[i]), found = labels.classes[i];
      if (expected == found) ++both_[found];
      ++either_[found];
      if (expected != found) ++either_[expected];
    }
  }
  [[nodiscard]] double of(std::uint8_t id) const { return both_[id] / std::max(either_[id], 1.0); }

 private:
  std::array<double, 256> both_{}, either_{};
};

/// The weights never saw a real scan.
TEST(RealScans, AreSegmentedByANetworkThatSawOnlySimulatedOnes) {
  if (!fs::exists(kData / "unpack")) GTEST_SKIP() << "no recordings in " << kData;
  const fs::path folder = fs::path(::testing::TempDir()) / "saker_semantic_kitti";
  const std::string command =
      (kData / "unpack").string() + " semantic_kitti " + folder.string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const objects::ClassTable table;
  Segmentation segmentation({}, table);
  lidar::KittiFolder scans(folder);
  Score score;
  for (auto frame = scans.next(); frame; frame = scans.next()) {
    ASSERT_EQ(frame->fault, "");
    score.add(segmentation.segment(frame->scan),
              true_ids(folder / "labels" / (frame->name + ".label")), table);
  }
  EXPECT_GE(score.of(table.find("vehicle")), 0.70);
  EXPECT_GE(score.of(table.find("trunk")), 0.38);
  EXPECT_GE(score.of(table.find("pole")), 0.44);
  EXPECT_GE(score.of(table.find("ground")), 0.93);
}

}  // namespace
}  // namespace saker::segmentation
