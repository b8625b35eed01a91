#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>

#include "flight/viewers/recording.h"
#include "flight/viewers/run.h"
#include "flight_viewers/made_robot.h"
#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"

/// Runs of which a part is missing, cut or wrong.
namespace saker::flight::viewers {
namespace {

using namespace testing;
using flight::testing::ScratchFolder;
namespace fs = std::filesystem;

/// Ten seconds along x, from 100 s on.
void write_poses(const fs::path& folder) {
  fs::create_directories(folder);
  std::string rows = "# t x y z qx qy qz qw\n";
  for (int i = 0; i <= 10; ++i)
    rows += std::to_string(100 + i) + " " + std::to_string(i) + " 0 3 0 0 0 1\n";
  core::write_file(folder / "trajectory.txt", rows);
}

void write_map(const fs::path& file, const std::vector<objects::MapObject>& objects) {
  objects::ObjectMap map;
  map.objects = objects;
  objects::write_map(file, map, objects::ClassTable());
}

/// What the error says that opening throws; empty: it throws none.
std::string fault(const fs::path& path) {
  try {
    static_cast<void>(open_run(path, *made_site()));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

struct RunFolder : ::testing::Test {
  RunFolder() { write_poses(out); }

  /// The state of R1 at `t`, as that run has it.
  Json message(Topic topic, double t) {
    const auto run = open_run(out, *made_site());
    RobotViews views(made_site(), kForever);
    run->advance(t, views);
    const auto json = views.of("R1")->message(topic, t);
    return json ? *json : Json();
  }

  ScratchFolder scratch;
  fs::path out = scratch / "out";
};

TEST_F(RunFolder, APathAloneIsARun) {
  EXPECT_EQ(message(Topic::odometry, 104)["position"][0], 4);
  EXPECT_TRUE(message(Topic::figures, 110).is_null());
}

TEST_F(RunFolder, AMapAloneIsARunOfNoLength) {
  fs::remove(out / "trajectory.txt");
  write_map(out / "map.json", {made_vehicle(3, 1, 2)});
  const auto run = open_run(out, *made_site());
  EXPECT_EQ(run->begin_s(), 0);
  EXPECT_EQ(run->end_s(), 0);
  EXPECT_EQ(message(Topic::objects, 0)["objects"].size(), 1u);
}

TEST_F(RunFolder, BeforeItsFirstPoseNothingIsSaid) {
  EXPECT_TRUE(message(Topic::odometry, 99).is_null());
}

TEST_F(RunFolder, TheFirstPoseHasNoSpeed) {
  EXPECT_FALSE(message(Topic::odometry, 100).contains("speed_mps"));
  EXPECT_EQ(message(Topic::odometry, 101)["speed_mps"], 1);
}

TEST_F(RunFolder, AViewpointIsSaidOnceItIsFlownTo) {
  core::write_file(out / "viewpoints.txt", "103 5 6 3 0 0 0.70710678 0.70710678\n");
  EXPECT_TRUE(message(Topic::plan, 102.9).is_null());
  const Json candidate = message(Topic::plan, 103)["candidates"][0];
  EXPECT_EQ(candidate["position"], (std::vector<double>{5, 6, 3}));
  EXPECT_NEAR(candidate["yaw_rad"].get<double>(), M_PI / 2, 1e-5);
  EXPECT_EQ(candidate["chosen"], true);
}

TEST_F(RunFolder, APathThatIsNoneIsNamedWithItsLine) {
  core::write_file(out / "trajectory.txt", "100 0 0 3 0 0 0 1\n101 1 0\n");
  EXPECT_NE(fault(out).find("trajectory.txt:2"), std::string::npos);
}

TEST_F(RunFolder, AMapThatIsNoneIsNamed) {
  core::write_file(out / "map.json", R"({"objects": [)");
  EXPECT_NE(fault(out).find("map.json"), std::string::npos);
}

TEST_F(RunFolder, APriorMapThatIsNoneIsNamed) {
  core::write_file(out / "prior.json", "[]");
  EXPECT_NE(fault(out).find("prior.json"), std::string::npos);
}

TEST_F(RunFolder, ResultsThatAreNoneAreNamed) {
  for (const char* text :
       {"", "{", "[]", "7", R"({"targets": "many"})", R"({"events": [{}]})", R"({"events": [1]})",
        R"({"events": [{"t_s": "1", "to": "tour", "cause": "armed", "text": ""}]})",
        R"({"target_list": [{"id": "x", "status": "done", "reason": ""}]})",
        R"({"target_list": {"id": 1}})"}) {
    core::write_file(out / "results.json", text);
    EXPECT_NE(fault(out).find("results.json"), std::string::npos) << text;
  }
}

/// 200,000 brackets would take the whole stack when they are copied.
TEST_F(RunFolder, ResultsThatAreNestedWithoutEndAreNamed) {
  const std::string open(200000, '['), close(200000, ']');
  core::write_file(out / "results.json", R"({"a": )" + open + close + "}");
  EXPECT_NE(fault(out).find("results.json"), std::string::npos);
  core::write_file(out / "results.json",
                   R"({"a": )" + open.substr(0, 60) + close.substr(0, 60) + "}");
  EXPECT_EQ(fault(out), "");
}

TEST_F(RunFolder, ResultsOfNothingAreResults) {
  core::write_file(out / "results.json", "{}");
  EXPECT_EQ(fault(out), "");
  EXPECT_TRUE(message(Topic::mission, 110).is_null());
  EXPECT_EQ(message(Topic::figures, 110), Json::object());
}

TEST_F(RunFolder, EventsCountFromTheBeginningOfTheRun) {
  core::write_file(out / "results.json",
                   R"({"targets": 4, "events": [
    {"t_s": 1, "to": "takeoff", "cause": "armed", "text": ""},
    {"t_s": 3, "to": "tour", "cause": "took_off", "text": "3 m"},
    {"t_s": 8, "to": "hold", "cause": "no such cause", "text": "x"}]})");
  EXPECT_TRUE(message(Topic::mission, 100.9).is_null());
  EXPECT_EQ(message(Topic::mission, 101)["phase"], "takeoff");
  const Json tour = message(Topic::mission, 103);
  EXPECT_EQ(tour["phase"], "tour");
  EXPECT_EQ(tour["cause"], "took_off");
  EXPECT_EQ(tour["targets"], 4);
  EXPECT_NEAR(tour["elapsed_s"].get<double>(), 2, 1e-6);  // since it was armed
  EXPECT_EQ(message(Topic::mission, 109)["cause"], "none");
}

TEST_F(RunFolder, DetectionsThatAreNoneAreNamed) {
  core::write_file(out / "detections.jsonl", "{}\n");
  EXPECT_NE(fault(out).find("detections.jsonl"), std::string::npos);
}

TEST_F(RunFolder, AFolderOfAnotherNameIsNoRobot) {
  write_poses(scratch / "two/R1");
  write_poses(scratch / "two/notes");
  write_poses(scratch / "two/r2");
  fs::create_directories(scratch / "two/R3");  // with nothing in it
  const auto run = open_run(scratch / "two", *made_site());
  RobotViews views(made_site(), kForever);
  run->advance(110, views);
  EXPECT_EQ(views.all().size(), 1u);
  EXPECT_TRUE(views.all().contains("R1"));
}

TEST_F(RunFolder, ARunOfSeveralIsAsLongAsTheLongest) {
  write_poses(scratch / "two/R1");
  fs::create_directories(scratch / "two/R2");
  core::write_file(scratch / "two/R2/trajectory.txt", "90 0 0 3 0 0 0 1\n105 0 0 3 0 0 0 1\n");
  const auto run = open_run(scratch / "two", *made_site());
  EXPECT_EQ(run->begin_s(), 90);
  EXPECT_EQ(run->end_s(), 110);
}

TEST_F(RunFolder, AdvancedInStepsItSaysWhatItSaysAtOnce) {
  const auto run = open_run(out, *made_site());
  RobotViews views(made_site(), kForever);
  for (double t = 99; t <= 110; t += 0.05) run->advance(t, views);
  run->advance(110, views);
  EXPECT_EQ(*views.of("R1")->message(Topic::path, 110), message(Topic::path, 110));
}

/// A log as lcm-logger writes it, of these messages.
template <class Message>
void write_log(const fs::path& file,
               const std::vector<std::tuple<double, std::string, Message>>& messages) {
  lcm::LogFile log(file.string(), "w");
  for (const auto& [t, channel, message] : messages) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    lcm::LogEvent event;
    event.channel = channel;
    event.timestamp = static_cast<std::int64_t>(t * 1e6);
    event.data = bytes.data();
    event.datalen = static_cast<std::int32_t>(bytes.size());
    ASSERT_EQ(log.writeEvent(&event), 0);
  }
}

TEST(LogRun, WithoutARobotsMessageItIsRefused) {
  const ScratchFolder folder;
  write_log<vehicle_state_t>(folder / "a.log", {{1, "CLOCK", made_state()}});
  EXPECT_NE(fault(folder / "a.log").find("no message of a robot"), std::string::npos);
}

TEST(LogRun, OneThatIsCutIsReadToTheCut) {
  const ScratchFolder folder;
  write_log<vehicle_state_t>(folder / "a.log",
                             {{1, "R1_STATE", made_state()}, {2, "R1_STATE", made_state()}});
  fs::resize_file(folder / "a.log", fs::file_size(folder / "a.log") - 5);
  const auto run = open_run(folder / "a.log", *made_site());
  EXPECT_EQ(run->begin_s(), 1);
  EXPECT_EQ(run->end_s(), 1);
}

TEST(LogRun, BytesThatAreNoMessageAreCounted) {
  const ScratchFolder folder;
  write_log<vehicle_state_t>(folder / "a.log",
                             {{1, "R1_ODOMETRY", made_state()}, {2, "R1_STATE", made_state()}});
  const auto run = open_run(folder / "a.log", *made_site());
  RobotViews views(made_site(), kForever);
  run->advance(2, views);
  EXPECT_EQ(views.find("R1")->state().malformed, 1);
  EXPECT_TRUE(views.find("R1")->state().vehicle);
}

TEST(LogRun, WhatIsNotYetDueIsNotHeard) {
  const ScratchFolder folder;
  write_log<vehicle_state_t>(folder / "a.log",
                             {{1, "R1_STATE", made_state()}, {2, "R2_STATE", made_state()}});
  const auto run = open_run(folder / "a.log", *made_site());
  RobotViews views(made_site(), kForever);
  run->advance(1.999, views);
  EXPECT_EQ(views.find("R2"), nullptr);
  run->advance(2, views);
  EXPECT_NE(views.find("R2"), nullptr);
}

/// A computer without a battery for its clock begins in 1970; then the network sets it.
TEST(Recording, OfALogWhoseClockWasSetIsRefusedAtOnce) {
  const ScratchFolder folder;
  write_log<vehicle_state_t>(folder / "a.log",
                             {{5, "R1_STATE", made_state()}, {1.7e9, "R1_STATE", made_state()}});
  const auto run = open_run(folder / "a.log", *made_site());
  EXPECT_THROW(record_run(*run, *made_site(), folder / "a.mcap"), Error);
  EXPECT_FALSE(fs::exists(folder / "a.mcap"));
}

TEST(Recording, OfARunOfNoLengthHoldsWhatIsKnown) {
  const ScratchFolder folder;
  fs::create_directories(folder / "out");
  write_map(folder / "out/map.json", {made_vehicle(3, 1, 2)});
  const auto run = open_run(folder / "out", *made_site());
  EXPECT_GT(record_run(*run, *made_site(), folder / "a.mcap"), 0u);
  EXPECT_TRUE(fs::exists(folder / "a.mcap"));
}

TEST(Recording, AScanIsAddedOnce) {
  const ScratchFolder folder;
  Recording recording(folder / "a.mcap");
  RobotView view = made_view();
  recording.add_scan(view.state());
  EXPECT_EQ(recording.messages(), 0u);
  view.hear(made_scan(10), 1);
  recording.add_scan(view.state());
  recording.add_scan(view.state());
  EXPECT_EQ(recording.messages(), 1u);
  view.hear(made_scan(10), 1.1);
  recording.add_scan(view.state());
  EXPECT_EQ(recording.messages(), 2u);
}

}  // namespace
}  // namespace saker::flight::viewers
