#include "tools/saker/experiment/experiment_report.h"

#include <gtest/gtest.h>

#include "saker/core/files.h"
#include "tools/saker/experiment/target_figures.h"
#include "tools/saker/experiment/viewpoint_log.h"

namespace saker::tools {
namespace {

constexpr objects::ClassId kTrunk = 2;
constexpr double kRadiusSd = 0.02;  // m
const objects::ClassTable kTable;

objects::ObjectMap trunks(double radius) {
  objects::ObjectMap map;
  map.frame = "world";
  for (int i = 0; i < 4; ++i) {
    objects::MapObject object;
    object.id = i;
    object.class_id = kTrunk;
    object.class_probability = {0, 0, 1, 0, 0};
    object.model =
        objects::Cylinder{{5.0 * i, 1.0 * i * i, 0}, Eigen::Vector3d::UnitZ(), radius, 3};
    object.covariance = kRadiusSd * kRadiusSd * Matrix6d::Identity();
    map.objects.push_back(object);
  }
  return map;
}

/// The folder that a run leaves.
std::filesystem::path flown() {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "flown";
  std::filesystem::create_directories(folder);
  core::write_file(folder / "viewpoints.csv", ViewpointLog().csv());
  return folder;
}

Json results() {
  Json run = {{"scenario", "lot"}, {"policy", "visit"}, {"seed", 1}, {"succeeded", true}};
  run.update(target_figures({}, {}, {}, kTable));
  run.update(Json{{"reachable_targets", Json::array()},
                  {"collisions", 0},
                  {"min_clearance_m", 1.0},
                  {"trajectory_error_m", 0.1},
                  {"flight_time_s", 10.0},
                  {"path_m", 5.0}});
  return run;
}

TEST(ConsistencyFigures, AreOfEveryClassThatWasFound) {
  const Json figures = consistency_figures(trunks(0.15 + 3 * kRadiusSd), trunks(0.15), kTable);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures["trunk"]["objects"], 4);
  EXPECT_NEAR(figures["trunk"]["size_nees"].get<double>(), 9, 1e-9);
  EXPECT_NEAR(figures["trunk"]["place_nees"].get<double>(), 0, 1e-9);
}

TEST(ClassCounts, TellWhatIsMappedInventedAndThereTwice) {
  objects::ObjectMap mapped = trunks(0.15);
  mapped.objects[1].model = objects::Cylinder{{100, 0, 0}, Eigen::Vector3d::UnitZ(), 0.15, 3};
  objects::MapObject twin = mapped.objects[0];
  twin.id = 4;
  std::get<objects::Cylinder>(twin.model).root.x() += 0.3;
  mapped.objects.push_back(twin);
  const Json counts = class_counts(mapped, trunks(0.15), kTable);
  EXPECT_EQ(counts["trunk"], Json({{"mapped", 5}, {"invented", 1}, {"duplicates", 1}}));
  EXPECT_EQ(counts["pole"]["mapped"], 0);
}

TEST(ExperimentReport, IsTheTableWithWhatTheResultsSayOfNees) {
  const std::filesystem::path folder = flown();
  Json run = results();
  run["consistency"] = {{"pole", {{"objects", 2}, {"size_nees", 1.5}, {"place_nees", 0.5}}}};
  const std::string text = write_report({{folder, run}}, folder);
  EXPECT_NE(text.find("pole          1.50       0.50       2"), std::string::npos) << text;
  EXPECT_EQ(core::read_file(folder / "table.txt"), text);
}

}  // namespace
}  // namespace saker::tools
