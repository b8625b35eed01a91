#include "saker/lidar/clouds/scan_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/clouds/natural_order.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;
using Files = std::vector<std::filesystem::path>;

TEST(NaturalOrder, CountsAsPeopleDo) {
  std::vector<std::string> names = {"10.bin", "9.bin",   "scan2", "scan10",
                                    "1.bin",  "001.bin", "a",     ""};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_EQ(names, (std::vector<std::string>{"", "001.bin", "1.bin", "9.bin", "10.bin", "a",
                                             "scan2", "scan10"}));
}

TEST(NaturalOrder, IsAnOrder) {
  const std::vector<std::string> names = {"", "0", "00", "a0", "a00b", "a0b", "1a", "01a", "b"};
  for (const auto& a : names) {
    EXPECT_FALSE(natural_less(a, a));
    for (const auto& b : names) {
      if (a == b) continue;
      EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << " " << b;
    }
  }
}

TEST(ScanTimes, KittisDatesAreTimesAlsoWhereScansAreMissing) {
  const TemporaryFolder folder;
  std::ofstream(folder / "timestamps.txt") << "2011-09-26 13:02:25.951199337\n"
                                              "2011-09-26 13:02:26.054453632\n"
                                              "2011-09-26 13:02:26.157707849\n";
  std::filesystem::create_directory(folder / "data");
  const auto times = times_of_scans(folder / "data", Files{"0000000000.bin", "0000000002.bin"});
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0] / kNanosecondsPerSecond, 1317042145);
  EXPECT_NEAR(to_seconds(times[1] - times[0]), 0.206508512, 1e-6);
}

TEST(ScanTimes, NamesMayBeTimes) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      times_of_scans(folder.path(), Files{"1561000444390857630.bin", "1561000444490857630.bin"})[1],
      1561000444490857630);
  EXPECT_EQ(times_of_scans(
                folder.path(),
                Files{"n015-2018-07-24-11-22-45+0800__LIDAR_TOP__1532402927647951.pcd.bin"})[0],
            1532402927647951000);
  EXPECT_EQ(times_of_scans(folder.path(), Files{"cloud_1583836591_82590976.pcd"})[0],
            1583836591082590976);
  EXPECT_EQ(times_of_scans(folder.path(), Files{"1583836591.25.pcd"})[0], 1583836591250000000);
}

TEST(ScanTimes, OtherNamesAreATenthOfASecondApart) {
  const TemporaryFolder folder;
  EXPECT_EQ(times_of_scans(folder.path(), Files{"000000.bin", "000001.bin"}),
            (std::vector<Time>{0, 100'000'000}));
}

TEST(ScanTimes, DatesThatDoNotFitAreRefused) {
  const TemporaryFolder folder;
  for (const char* text :
       {"soon\n", "2011-09-26\n", "2011-09-26 13:02:25.9\n2011-09-26 13:02:26.0\n"}) {
    std::ofstream(folder / "timestamps.txt") << text;
    EXPECT_THROW((void)times_of_scans(folder.path(), Files{"a.bin"}), Error) << text;
  }
}

TEST(ScanTimes, DatesThatNoCalendarHasAreRefused) {
  const TemporaryFolder folder;
  for (const char* text : {"2011-13-26 13:02:25", "2011-00-26 13:02:25", "2011-09-32 13:02:25",
                           "2011-09-26 24:02:25", "2011-09-26 13:60:25", "2011-09-26 13:02:61",
                           "2011--2147483648-26 13:02:25", "1969-09-26 13:02:25"}) {
    std::ofstream(folder / "timestamps.txt") << text << "\n";
    EXPECT_THROW((void)times_of_scans(folder.path(), Files{"a.bin"}), Error) << text;
  }
}

TEST(ScanTimes, NumbersInNamesThatNoClockShowsAreNone) {
  const TemporaryFolder folder;
  for (const char* name : {"9999999999999999.bin", "9999999999999999999.bin", "9999999999_1.bin",
                           "9999999999.5.bin"}) {
    EXPECT_EQ(times_of_scans(folder.path(), Files{name}), std::vector<Time>{0}) << name;
  }
}

TEST(ScanTimes, NamesWhoseTimesGoBackAreNone) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      times_of_scans(folder.path(), Files{"1561000444490857630.bin", "1561000444390857630.bin"}),
      (std::vector<Time>{0, 100'000'000}));
}

}  // namespace
}  // namespace saker::lidar
