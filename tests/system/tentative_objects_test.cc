#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saker/core/files.h"
#include "saker/objects/map_io.h"
#include "tools/saker/picture/map_picture.h"
#include "tools/saker/picture/picture.h"
#include "tools/saker/replay/run_recorder.h"

/// What was seen too seldom for the map is written and drawn beside it.
namespace saker::tools {
namespace {

namespace fs = std::filesystem;

objects::MapObject vehicle_at(int id, double x, int windows) {
  objects::MapObject object;
  object.id = id;
  object.class_id = 1;
  object.class_probability.assign(static_cast<std::size_t>(objects::ClassTable{}.size()), 0);
  object.class_probability[1] = 1;
  object.observations = windows;
  objects::Cuboid cuboid;
  cuboid.pose.translation() = Eigen::Vector3d(x, 2, 0);
  cuboid.size = Eigen::Vector3d(4.4, 1.8, 1.5);
  object.model = cuboid;
  return object;
}

class TentativeObjects : public ::testing::Test {
 protected:
  TentativeObjects() : folder_(fs::path(::testing::TempDir()) / "saker_tentative") {
    fs::create_directories(folder_);
    result_.scans.resize(1);
    result_.T_world_lidar.push_back(SE3::Identity());
    result_.map.objects.push_back(vehicle_at(3, 0, 12));
  }
  ~TentativeObjects() override { fs::remove_all(folder_); }

  std::string written_map() {
    RunRecorder(folder_, table_).write(result_);
    return core::read_file(folder_ / "map.json");
  }
  std::string drawn() {
    write_map_picture(folder_ / "map.svg", {.map = result_.map, .tentative = result_.tentative},
                      table_);
    return core::read_file(folder_ / "map.svg");
  }

  fs::path folder_;
  objects::ClassTable table_;
  autonomy::LockstepResult result_;
};

TEST_F(TentativeObjects, StandBesideTheMapWithHowOftenTheyWereSeen) {
  result_.tentative = {vehicle_at(5, 8, 1)};
  const auto document = nlohmann::json::parse(written_map());
  ASSERT_EQ(document["tentative"].size(), 1U);
  EXPECT_EQ(document["tentative"][0]["id"], 5);
  EXPECT_EQ(document["tentative"][0]["observations"], 1);
  EXPECT_EQ(document["tentative"][0]["class"], table_[1].name);
}

TEST_F(TentativeObjects, AreNoPartOfTheMapThatIsRead) {
  const std::string before = written_map();
  const std::string smap = core::read_file(folder_ / "map.smap");
  result_.tentative = {vehicle_at(5, 8, 1)};
  (void)written_map();
  EXPECT_EQ(objects::to_json(objects::read_map(folder_ / "map.json", table_), table_), before);
  EXPECT_EQ(core::read_file(folder_ / "map.smap"), smap);
}

TEST_F(TentativeObjects, AMapWithoutAnyIsWrittenAsBefore) {
  EXPECT_EQ(written_map(), objects::to_json(result_.map, table_));
}

TEST_F(TentativeObjects, AreDrawnInStrokes) {
  const auto lines = [](const std::string& svg) {
    std::size_t count = 0;
    for (auto at = svg.find("<polyline"); at != std::string::npos;
         at = svg.find("<polyline", at + 1))
      ++count;
    return count;
  };
  const std::string plain = drawn();
  result_.tentative = {vehicle_at(5, 8, 1)};
  const std::string dashed = drawn();
  EXPECT_GE(lines(dashed), lines(plain) + 16);  // 12.4 m of outline, a stroke of 0.3 m each 0.6 m
  EXPECT_NE(dashed.find("seen too seldom"), std::string::npos);
}

}  // namespace
}  // namespace saker::tools
