#include "tools/saker/experiment/viewpoint_log.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

objects::MapObject vehicle(int id, double x, double length, double width) {
  objects::Cuboid cuboid;
  cuboid.pose = SE3::Identity();
  cuboid.pose.translation() = Eigen::Vector3d(x, 0, 0.7);
  cuboid.size = {length, width, 1.4};
  objects::MapObject object;
  object.id = id;
  object.model = cuboid;
  return object;
}

objects::ObjectMap map_of(std::vector<objects::MapObject> list) {
  objects::ObjectMap map;
  map.objects = std::move(list);
  return map;
}

class ViewpointLogTest : public testing::Test {
 protected:
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / "viewpoint_log_test.csv";
  const objects::ObjectMap truth_ = map_of({vehicle(3, 0, 4.5, 1.8), vehicle(4, 5, 4.0, 1.7)});

  std::vector<Outcome> outcomes_of(const ViewpointLog& log) {
    core::write_file(file_, log.csv());
    return read_outcomes(file_);
  }
};

TEST_F(ViewpointLogTest, TheFirstMapAfterAViewpointSaysWhatCameOfIt) {
  ViewpointLog log;
  log.add(from_seconds(2), 3, 17, {0.1, 0.05});
  log.take(from_seconds(1.5), map_of({vehicle(9, 0, 3.0, 1.0)}), truth_);
  log.take(from_seconds(2.5), map_of({vehicle(9, 0.3, 4.7, 1.75)}), truth_);
  log.take(from_seconds(3), map_of({vehicle(9, 0, 9.0, 9.0)}), truth_);
  const auto outcomes = outcomes_of(log);
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_NEAR(outcomes[0].predicted_sd, 0.1, 1e-6);
  EXPECT_NEAR(outcomes[0].error, 0.2, 1e-6);
  EXPECT_NEAR(outcomes[1].predicted_sd, 0.05, 1e-6);
  EXPECT_NEAR(outcomes[1].error, -0.05, 1e-6);
}

TEST_F(ViewpointLogTest, TheMappedObjectIsTheOneNearestToTheTarget) {
  ViewpointLog log;
  log.add(0, 4, 1, {0.1, 0.1});
  log.take(0, map_of({vehicle(1, 0, 4.4, 1.8), vehicle(2, 4.6, 4.2, 1.7)}), truth_);
  EXPECT_NEAR(outcomes_of(log)[0].error, 0.2, 1e-6);
}

TEST_F(ViewpointLogTest, WhatIsNotInTheMapHasNoOutcome) {
  ViewpointLog log;
  log.add(0, 3, 1, {0.1, 0.1});
  log.take(0, map_of({vehicle(1, 9, 4.4, 1.8)}), truth_);
  log.add(from_seconds(1), 3, 2, {0.1, 0.1});  // no map comes after it
  const auto outcomes = outcomes_of(log);
  EXPECT_EQ(outcomes.size(), 4U);
  EXPECT_TRUE(calibration(outcomes).empty());
}

TEST_F(ViewpointLogTest, AFileThatIsCutIsRefusedWithItsLine) {
  ViewpointLog log;
  log.add(0, 3, 1, {0.1, 0.1});
  const std::string whole = log.csv();
  core::write_file(file_, whole.substr(0, whole.size() - 12));
  try {
    (void)read_outcomes(file_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos);
  }
  core::write_file(file_, "nothing\n");
  EXPECT_THROW((void)read_outcomes(file_), Error);
}

}  // namespace
}  // namespace saker::tools
