#include "tools/saker/faults/flight_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "saker/core/files.h"
#include "saker/objects/map_io.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

Fault disk(FaultPlace place, double at_s, double lasts_s = INFINITY, double strength = 1) {
  Fault fault;
  fault.kind = FaultKind::disk;
  fault.place = place;
  fault.at_s = at_s;
  fault.lasts_s = lasts_s;
  fault.strength = strength;
  return fault;
}

objects::ObjectMap map_of(int vehicles, const objects::ClassTable& table) {
  objects::ObjectMap map;
  for (int id = 0; id < vehicles; ++id) {
    objects::MapObject object;
    object.id = id;
    object.class_id = 1;
    object.class_probability.assign(static_cast<std::size_t>(table.size()), 0.0);
    object.class_probability[1] = 1;
    object.observations = 3;
    object.model = objects::Cuboid{SE3(Eigen::Translation3d(5.0 * id, 0, 1)), {4.5, 1.8, 1.5}};
    map.objects.push_back(object);
  }
  return map;
}

class FilesOfAFlight : public testing::Test {
 protected:
  [[nodiscard]] std::string newest() const { return core::read_file(folder / "newest"); }
  [[nodiscard]] std::size_t objects_on_disk() const {
    return objects::read_map(folder / "map.smap", table).objects.size();
  }

  objects::ClassTable table;
  fs::path folder = fs::temp_directory_path() / fmt::format("saker_flight_files_{}", ::getpid());
  FaultSchedule schedule;
};

TEST_F(FilesOfAFlight, WithoutAFaultEachIsTheNewestAndWhole) {
  FlightFiles files(folder, schedule, table);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(files.write(3.0 * i, map_of(i, table)).empty());
  EXPECT_EQ(files.written(), 5);
  EXPECT_EQ(objects_on_disk(), 4U);
  EXPECT_EQ(newest(), "12.00\n");
}

TEST_F(FilesOfAFlight, OnAFullDiskThoseOfBeforeStayWhole) {
  schedule = {disk(FaultPlace::full, 3, 5)};
  FlightFiles files(folder, schedule, table);
  EXPECT_TRUE(files.write(0, map_of(2, table)).empty());
  EXPECT_TRUE(files.write(4, map_of(7, table)).empty());
  EXPECT_EQ(files.failed(), 1);
  EXPECT_EQ(objects_on_disk(), 2U);
  EXPECT_EQ(newest(), "0.00\n");
  EXPECT_TRUE(files.write(9, map_of(7, table)).empty());
  EXPECT_EQ(objects_on_disk(), 7U);
}

TEST_F(FilesOfAFlight, AfterEachPowerCutTheyAreWholeAndGoOn) {
  schedule = {disk(FaultPlace::cut, 1)};
  FlightFiles files(folder, schedule, table);
  for (int i = 0; i < 60; ++i) {
    const auto torn = files.write(2.5 * i, map_of(i % 4, table));
    EXPECT_TRUE(torn.empty()) << i << ": " << torn.front();
  }
  EXPECT_EQ(files.written(), 60);
}

TEST_F(FilesOfAFlight, ASlowDiskIsNotWrittenToAgainBeforeItIsReady) {
  schedule = {disk(FaultPlace::slow, 0, INFINITY, 6)};
  FlightFiles files(folder, schedule, table);
  for (double t_s = 0; t_s < 12.5; t_s += 0.5) EXPECT_TRUE(files.write(t_s, {}).empty());
  EXPECT_EQ(files.written(), 3);
}

TEST_F(FilesOfAFlight, AMapThatIsCutShortIsNamed) {
  schedule = {disk(FaultPlace::full, 3)};  // it is not written over
  FlightFiles files(folder, schedule, table);
  (void)files.write(0, map_of(2, table));
  const std::string whole = core::read_file(folder / "map.smap");
  core::write_file(folder / "map.smap", whole.substr(0, whole.size() / 2));
  const auto torn = files.write(4, map_of(2, table));
  ASSERT_FALSE(torn.empty());
  EXPECT_NE(torn.front().find("map.smap"), std::string::npos);
}

TEST_F(FilesOfAFlight, NothingIsLeftBehind) {
  { FlightFiles files(folder, schedule, table); }
  EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace saker::tools
