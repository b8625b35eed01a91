#include "flight/viewers/run.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>

#include "flight/bus/occupancy_messages.h"
#include "flight/bus/scan_messages.h"
#include "flight/run_files/detections_file.h"
#include "flight/viewers/recording.h"
#include "flight_viewers/made_robot.h"
#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/lidar/bags/mcap_file.h"
#include "saker/lidar/recording.h"
#include "saker/objects/map_io.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;
using flight::testing::ScratchFolder;
namespace fs = std::filesystem;

/// A run of 10 s from (0, 0) to (10, 0), with a vehicle that is measured from 4 s on.
void make_run(const fs::path& folder) {
  fs::create_directories(folder);
  const objects::ClassTable table;
  std::string rows;
  for (int i = 0; i <= 100; ++i)
    rows += std::to_string(100 + 0.1 * i) + " " + std::to_string(0.1 * i) + " 0 3 0 0 0 1\n";
  core::write_file(folder / "trajectory.txt", rows);
  objects::ObjectMap map;
  map.objects = {made_vehicle(3, 6, 2), made_pole(5, 20, 20)};
  objects::write_map(folder / "map.json", map, table);
  map.objects = {made_vehicle(31, 6.4, 2.1)};
  objects::write_map(folder / "prior.json", map, table);
  DetectionsWriter writer(folder, table);
  for (int i = 40; i <= 100; i += 5) {
    objects::MapObject seen = made_vehicle(3, 6.2 - 0.1 * i, 2);
    std::get<objects::Cuboid>(seen.model).pose.translation().z() -= 3;
    writer.add({.stamp = from_seconds(100 + 0.1 * i),
                .measurements = {{.stamp = from_seconds(100 + 0.1 * i),
                                  .class_id = seen.class_id,
                                  .class_probability = seen.class_probability,
                                  .model = seen.model,
                                  .covariance = seen.covariance}},
                .ground = {}});
  }
  writer.finish();
  core::write_file(
      folder / "results.json",
      R"({"targets": 1, "target_list": [{"id": 31, "status": "done", "reason": "seen"}],
                       "events": [{"t_s": 1.0, "from": "preflight", "to": "tour", "cause": "took_off",
                                   "text": "3 m"}]})");
}

struct Played {
  explicit Played(const fs::path& path)
      : run(open_run(path, *made_site())), views(made_site(), kForever) {}

  void go(double t) { run->advance(t, views); }
  Json said(const std::string& robot, Topic topic, double t) {
    const auto json = views.of(robot)->message(topic, t);
    return json ? *json : Json();
  }

  std::unique_ptr<Run> run;
  RobotViews views;
};

TEST(FolderRun, AnObjectIsThereFromItsFirstMeasurementOn) {
  const ScratchFolder folder;
  make_run(folder / "out");
  Played played(folder / "out");
  EXPECT_EQ(played.run->begin_s(), 100);
  EXPECT_EQ(played.run->end_s(), 110);
  played.go(103.9);
  Json objects = played.said("R1", Topic::objects, 103.9)["objects"];
  ASSERT_EQ(objects.size(), 1u);  // no measurement is of the pole: it was always there
  EXPECT_EQ(objects[0]["id"], 5);
  played.go(104.1);
  objects = played.said("R1", Topic::objects, 104.1)["objects"];
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0]["size"], (std::vector<double>{4, 2, 1.5}));
  EXPECT_EQ(objects[0]["target"]["state"], "waiting");
}

TEST(FolderRun, ItsEndIsWhatTheFilesSay) {
  const ScratchFolder folder;
  make_run(folder / "out");
  Played played(folder / "out");
  played.go(110);
  const Json objects = played.said("R1", Topic::objects, 110)["objects"];
  EXPECT_EQ(objects[0]["target"]["state"], "done");
  EXPECT_EQ(objects[0]["target"]["reason"], "seen");
  EXPECT_NEAR(played.said("R1", Topic::path, 110)["length_m"].get<double>(), 10, 0.3);
  const Json odometry = played.said("R1", Topic::odometry, 110);
  EXPECT_EQ(odometry["position"], (std::vector<double>{10, 0, 3}));
  EXPECT_NEAR(odometry["speed_mps"].get<double>(), 1, 1e-3);
  EXPECT_EQ(played.said("R1", Topic::mission, 110)["phase"], "tour");
  EXPECT_EQ(played.said("R1", Topic::figures, 110)["targets"], 1);
}

TEST(FolderRun, RewoundItSaysTheSameAgain) {
  const ScratchFolder folder;
  make_run(folder / "out");
  Played played(folder / "out");
  played.go(110);
  played.run->rewind(played.views);
  played.go(102);
  EXPECT_EQ(played.said("R1", Topic::odometry, 102)["position"], (std::vector<double>{2, 0, 3}));
  EXPECT_EQ(played.said("R1", Topic::objects, 102)["objects"].size(), 1u);
}

TEST(FolderRun, AMissionHasItsRobotsAndTheirMap) {
  const ScratchFolder folder;
  make_run(folder / "out/R1");
  make_run(folder / "out/R2");
  fs::copy(folder / "out/R1/map.json", folder / "out/map.json");
  Played played(folder / "out");
  played.go(110);
  EXPECT_EQ(played.views.all().size(), 3u);
  EXPECT_EQ(played.said("TEAM", Topic::objects, 110)["objects"].size(), 2u);
}

TEST(FolderRun, WhatIsNoRunIsRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(open_run(folder.path(), Site()), Error);
  EXPECT_THROW(open_run(folder / "none", Site()), Error);
  core::write_file(folder / "a.txt", "text");
  EXPECT_THROW(open_run(folder / "a.txt", Site()), Error);
}

/// A log as lcm-logger writes it.
class Logger {
 public:
  explicit Logger(const fs::path& file) : log_(file.string(), "w") {}

  template <class Message>
  void add(double t, const std::string& channel, const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    lcm::LogEvent event;
    event.channel = channel;
    event.timestamp = static_cast<std::int64_t>(t * 1e6);
    event.data = bytes.data();
    event.datalen = static_cast<std::int32_t>(bytes.size());
    ASSERT_EQ(log_.writeEvent(&event), 0);
  }

 private:
  lcm::LogFile log_;
};

void make_log(const fs::path& file) {
  Logger log(file);
  for (int i = 0; i < 50; ++i) {
    const double t = 1000 + 0.1 * i;
    log.add(t, "R1_ODOMETRY", made_odometry(100000 * i, 0.1 * i, 0));
    autonomy::RegisteredScan scan = made_scan(200);
    scan.stamp = from_seconds(0.1 * i);
    for (const scan_t& chunk : to_lcm(scan, i)) log.add(t, "R1_SCAN", chunk);
  }
  log.add(1005, "R1_OBJECTS", made_objects({made_vehicle(3, 10, 0)}));
  log.add(1005, "NOT_A_ROBOTS", made_state());
}

TEST(LogRun, SaysWhatWasHeardWhenItWas) {
  const ScratchFolder folder;
  make_log(folder / "a.log");
  Played played(folder / "a.log");
  EXPECT_EQ(played.run->begin_s(), 1000);
  EXPECT_EQ(played.run->end_s(), 1005);
  played.go(1002.05);
  EXPECT_NEAR(played.said("R1", Topic::odometry, 1002)["position"][0].get<double>(), 2, 1e-6);
  EXPECT_TRUE(played.said("R1", Topic::objects, 1002).is_null());
  played.go(1005);
  EXPECT_EQ(played.said("R1", Topic::objects, 1005)["objects"].size(), 1u);
  EXPECT_EQ(played.views.all().size(), 1u);  // NOT_A_ROBOTS is none
  played.run->rewind(played.views);
  played.go(1001.05);
  EXPECT_NEAR(played.said("R1", Topic::odometry, 1001)["position"][0].get<double>(), 1, 1e-6);
}

TEST(Recording, OfALogHoldsItsTopicsAndItsScans) {
  const ScratchFolder folder;
  make_log(folder / "a.log");
  const auto run = open_run(folder / "a.log", *made_site());
  record_run(*run, *made_site(), folder / "a.mcap");
  const lidar::McapFile file(folder / "a.mcap");
  std::map<std::string, long> counted;
  for (const lidar::Topic& topic : file.topics()) counted[topic.name] = topic.messages;
  EXPECT_EQ(counted["/R1/scan"], 50);
  EXPECT_GE(counted["/R1/odometry"], 45);
  EXPECT_GE(counted["/R1/objects"], 1);
  EXPECT_GE(counted["/R1/scene"], 4);
}

TEST(Recording, ItsScansAreReadAsAnyOthers) {
  const ScratchFolder folder;
  make_log(folder / "a.log");
  const auto run = open_run(folder / "a.log", *made_site());
  record_run(*run, *made_site(), folder / "a.mcap");
  const auto scans = lidar::open_recording(folder / "a.mcap");
  int count = 0;
  while (const auto frame = scans->next()) {
    EXPECT_EQ(frame->fault, "");
    ASSERT_EQ(frame->scan.points.size(), 200u);
    EXPECT_NEAR(frame->scan.points[100].x(), 1.1f, 0.006f);  // scans travel to 1 cm
    EXPECT_EQ(frame->scan.stamp, from_seconds(0.1 * count));
    ++count;
  }
  EXPECT_EQ(count, 50);
}

TEST(Recording, OfAFolderEndsWithItsMap) {
  const ScratchFolder folder;
  make_run(folder / "out");
  const auto run = open_run(folder / "out", *made_site());
  EXPECT_GT(record_run(*run, *made_site(), folder / "a.mcap"), 100u);
  lidar::McapFile file(folder / "a.mcap");
  std::string last;
  while (const auto message = file.next()) {
    if (file.topics()[message->topic].name == "/R1/objects")
      last.assign(message->bytes.begin(), message->bytes.end());
  }
  EXPECT_EQ(Json::parse(last)["objects"].size(), 2u);
}

}  // namespace
}  // namespace saker::flight::viewers
