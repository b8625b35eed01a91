#include <gtest/gtest.h>

#include <cstring>

#include "flight/viewers/own_messages.h"
#include "flight/viewers/words.h"
#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

TEST(JsonValue, NumbersAreRoundedAndUnknownOnesLeftOut) {
  EXPECT_EQ(Json(rounded(0.30000001192092896)).dump(), "0.3");
  EXPECT_EQ(rounded(1.7e18), 1.7e18);
  Json object = Json::object();
  put(object, "a", NAN);
  put(object, "b", Eigen::Vector2d(1, NAN));
  put(object, "c", 2.5);
  EXPECT_EQ(object.dump(), R"({"c":2.5})");
}

TEST(JsonValue, Base64IsThatOfTheStandard) {
  const auto text = [](const std::string& s) {
    return base64({reinterpret_cast<const std::uint8_t*>(s.data()), s.size()});
  };
  EXPECT_EQ(text(""), "");  // RFC 4648, 10
  EXPECT_EQ(text("f"), "Zg==");
  EXPECT_EQ(text("fo"), "Zm8=");
  EXPECT_EQ(text("foo"), "Zm9v");
  EXPECT_EQ(text("foobar"), "Zm9vYmFy");
}

TEST(OwnMessages, AnObjectIsAsItIs) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);
  const Json object = (*view.message(Topic::objects, 1))["objects"][0];
  EXPECT_EQ(object["class"], "vehicle");
  EXPECT_EQ(object["size"], (std::vector<double>{4, 2, 1.5}));
  EXPECT_EQ(object["position"], (std::vector<double>{10, 2, 0.75}));
  EXPECT_NEAR(object["heading_rad"].get<double>(), M_PI / 2, 1e-6);
  EXPECT_NEAR(object["probability"].get<double>(), 0.96, 1e-6);
  EXPECT_EQ(object["sd"]["size"], (std::vector<double>{0.04, 0.02}));
}

/// The object is turned by a quarter: what is uncertain along its x is so along the map's y.
TEST(OwnMessages, TheCovarianceOfAPlaceIsInTheFrameOfTheMap) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);
  const auto covariance = (*view.message(Topic::objects, 1))["objects"][0]["place_covariance"]
                              .get<std::vector<double>>();
  EXPECT_NEAR(covariance.at(0), 0.01, 1e-6);
  EXPECT_NEAR(covariance.at(1), 0, 1e-6);
  EXPECT_NEAR(covariance.at(2), 0.09, 1e-6);
}

TEST(OwnMessages, AnObjectIsTheTargetOfThePriorMapThatItStandsOn) {
  auto site = made_site();
  site->prior.objects = {made_vehicle(40, 11, 0)};
  RobotView view = made_view(site);
  view.hear(made_objects({made_vehicle(3, 10, 0), made_vehicle(4, 13.5, 0)}), 1);
  view.hear(made_plan({40}, 1), 1);
  const Json message = *view.message(Topic::objects, 1);
  EXPECT_EQ(message["objects"][0]["target"]["id"], 40);
  EXPECT_EQ(message["objects"][0]["target"]["state"], "next");
  EXPECT_FALSE(message["objects"][1].contains("target"));
}

TEST(OwnMessages, ALongTrajectoryIsThinnedToItsEnds) {
  RobotView view = made_view();
  view.hear(made_trajectory(1, 1001), 1);
  const Json message = *view.message(Topic::trajectory, 1);
  EXPECT_LE(message["points"].size(), 400u);
  EXPECT_EQ(message["points"].front()[0], 0);
  EXPECT_EQ(message["points"].back()[0], 1000);
  EXPECT_EQ(message["end_s"], 100);
}

TEST(OwnMessages, APathIsWholeAndBounded) {
  FlownPath path;
  for (int i = 0; i < 100000; ++i) path.add({0.3 * i, 0, 3}, i);
  EXPECT_LT(path.points().size(), FlownPath::kMost);
  EXPECT_GT(path.points().size(), FlownPath::kMost / 4);
  EXPECT_EQ(path.points().front().x(), 0);
  EXPECT_NEAR(path.points().back().x(), 30000, 10);
  EXPECT_NEAR(path.length_m(), 30000, 10);
  EXPECT_EQ(path.points().size(), path.times().size());
}

TEST(OwnMessages, TheStateNamesItsFaults) {
  RobotView view = made_view();
  view.hear(made_state(), 1);
  EXPECT_EQ((*view.message(Topic::state, 1))["faults"],
            (std::vector<std::string>{"no_odometry", "battery_low"}));
}

MissionWords words_in(const std::string& phase, autonomy::Cause cause, const std::string& text) {
  RobotView view = made_view();
  view.hear(made_mission(phase, cause, text), 1);
  return words_of(view.state(), *made_site());
}

TEST(Words, SayWhatItWaitsForAndWhatThenHappens) {
  using autonomy::Cause;
  const MissionWords hold = words_in("hold", Cause::lidar_silent, "no scan for 0.7 s");
  EXPECT_EQ(hold.ladder, "hold");
  EXPECT_EQ(hold.waits_for, "the end of: no scan for 0.7 s");
  EXPECT_EQ(hold.if_it_goes_on, "it lands 10 s after it began to hold");
  EXPECT_EQ(words_in("tour", Cause::took_off, "").ladder, "none");
  EXPECT_EQ(words_in("return", Cause::battery_low, "30 %").ladder, "return");
  EXPECT_EQ(words_in("return", Cause::tour_complete, "").ladder, "none");
  EXPECT_EQ(words_in("landing", Cause::battery_empty, "").ladder, "land");
}

TEST(Words, AVehicleThatDescendsByItselfIsOnTheLastRung) {
  RobotView view = made_view();
  view.hear(made_mission("hold", autonomy::Cause::odometry_lost, ""), 1);
  vehicle_state_t state = made_state();
  state.mode = vehicle_state_t::DESCEND;
  view.hear(state, 1);
  EXPECT_EQ(words_of(view.state(), *made_site()).ladder, "silence");
}

TEST(Scene, AnObjectThatIsGoneIsDeleted) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);
  const Json first = *view.message(Topic::scene, 1);
  EXPECT_EQ(first["entities"][0]["id"], "objects/3");
  EXPECT_TRUE(first["deletions"].empty());
  object_map_t farewell = made_objects({made_vehicle(3, 10, 2)});
  farewell.objects[0].observations = 0;
  view.hear(farewell, 2);
  const Json second = *view.message(Topic::scene, 2);
  EXPECT_EQ(second["deletions"][0]["id"], "objects/3");
}

/// 95 % of a place that is known to 0.3 m along the map's y: 2.448 times as far.
TEST(Scene, TheEllipseIsThatOfThePlace) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);
  const Json points = (*view.message(Topic::scene, 1))["entities"][0]["lines"][0]["points"];
  double most_y = 0;
  for (const Json& p : points) most_y = std::max(most_y, p["y"].get<double>());
  EXPECT_NEAR(most_y - 2, 0.3 * 2.4477, 1e-3);
}

TEST(Location, IsWhereTheBodyIsOnTheEarth) {
  auto site = made_site();
  site->origin = {.latitude_deg = 47, .longitude_deg = 8, .heading_deg = 0};  // x to the north
  RobotView view = made_view(site);
  EXPECT_EQ(view.message(Topic::location, 1), std::nullopt);
  view.hear(made_odometry(1, 111.2, 0), 1);
  const Json fix = *view.message(Topic::location, 1);
  EXPECT_NEAR(fix["latitude"].get<double>(), 47.001, 2e-6);
  EXPECT_NEAR(fix["longitude"].get<double>(), 8, 1e-9);
}

std::vector<Eigen::Vector3f> points_of(const Json& cloud) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : cloud["data"].get<std::string>()) {
    if (c == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 0xff);
  }
  std::vector<Eigen::Vector3f> points;
  const auto stride = cloud["point_stride"].get<std::size_t>();
  for (std::size_t i = 0; i + stride <= bytes.size(); i += stride) {
    std::memcpy(points.emplace_back().data(), bytes.data() + i, 12);
  }
  return points;
}

TEST(Clouds, AScanIsThinnedAndInOdom) {
  RobotView view = made_view();
  view.hear(made_scan(30000), 1);
  const auto points = points_of(*view.message(Topic::points, 1));
  EXPECT_LE(points.size(), 6000u);
  EXPECT_GE(points.size(), 5000u);
  EXPECT_NEAR(points.front().x(), 11, 1e-3);
  EXPECT_NEAR(points.front().z(), 3, 1e-3);
}

TEST(Clouds, OccupancyIsTheNearestCellsAboutTheBody) {
  RobotView view = made_view();
  view.hear(made_odometry(1, 0, 0), 1);
  occupancy::OccupancyGrid grid{
      .resolution_m = 1, .origin = {0, 0, 3}, .size = {40, 1, 1}, .cells = {}};
  grid.cells.assign(40, occupancy::Cell::occupied);
  grid.cells[1] = occupancy::Cell::free;
  view.hear(grid, 1);
  const auto cells = points_of(*occupied_cells(view.state(), 1, 12, 5));
  ASSERT_EQ(cells.size(), 5u);
  for (const Eigen::Vector3f& cell : cells) {
    EXPECT_NE(cell.x(), 1.5f);
    EXPECT_LT(cell.x(), 6);
  }
}

TEST(OwnMessages, TheOdometrysDeviationsAreTheRootsOfItsCovariance) {
  RobotView view = made_view();
  view.hear(made_odometry(1, 0, 0), 1);
  const Json said = *view.message(Topic::odometry, 1);
  EXPECT_EQ(said["sd_m"], (std::vector<double>{0.2, 0.2, 0.2}));
  EXPECT_EQ(said["sd_rad"], (std::vector<double>{0.2, 0.2, 0.2}));
  EXPECT_EQ(said["speed_mps"], 5);  // of 3 and 4
}

TEST(OwnMessages, ACovarianceThatIsNoneHasNoDeviations) {
  RobotView view = made_view();
  odometry_t message = made_odometry(1, 0, 0);
  message.covariance[7 * 4] = -1;
  view.hear(message, 1);
  const Json said = *view.message(Topic::odometry, 1);
  EXPECT_FALSE(said.contains("sd_m"));
  EXPECT_TRUE(said.contains("sd_rad"));
}

TEST(OwnMessages, AShortTrajectoryIsWhole) {
  RobotView view = made_view();
  view.hear(made_trajectory(1, 7), 1);
  const Json message = *view.message(Topic::trajectory, 1);
  EXPECT_EQ(message["points"].size(), 7u);
  EXPECT_NEAR(message["step_s"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(message["end_s"].get<double>(), 0.6, 1e-9);
}

TEST(OwnMessages, ATrajectoryOfNoStatesEndsAtOnce) {
  RobotView view = made_view();
  view.hear(made_trajectory(1, 0), 1);
  const Json message = *view.message(Topic::trajectory, 1);
  EXPECT_TRUE(message["points"].empty());
  EXPECT_EQ(message["end_s"], 0);
}

TEST(OwnMessages, TrajectoriesOfAnyLengthKeepTheirEndsAndTheirCeiling) {
  for (const int states : {1, 2, 399, 400, 401, 798, 799, 1000}) {
    RobotView view = made_view();
    ASSERT_TRUE(view.hear(made_trajectory(1, states), 1)) << states;
    const Json message = *view.message(Topic::trajectory, 1);
    EXPECT_LE(message["points"].size(), 400u) << states;
    EXPECT_EQ(message["points"].front()[0], 0) << states;
    EXPECT_EQ(message["points"].back()[0], states - 1) << states;
    EXPECT_EQ(message["points"].size(), message["yaw_rad"].size()) << states;
  }
}

TEST(OwnMessages, WithoutAPriorMapEveryTargetClassWaits) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 0, 0), made_pole(4, 5, 5)}), 1);
  const Json objects = (*view.message(Topic::objects, 1))["objects"];
  EXPECT_EQ(objects[0]["target"]["state"], "waiting");
  EXPECT_FALSE(objects[0]["target"].contains("id"));
  EXPECT_FALSE(objects[1].contains("target"));  // poles are no targets
}

TEST(OwnMessages, TheWholeMapsNumberIsTheRobotsOwn) {
  RobotView view = made_view();
  object_map_t message = made_objects({made_vehicle(3, 0, 0)});
  message.total = 34;
  view.hear(message, 1);
  EXPECT_EQ((*view.message(Topic::objects, 1))["total"], 34);
}

TEST(OwnMessages, APoleHasItsRootAxisAndRadius) {
  RobotView view = made_view();
  view.hear(made_objects({made_pole(5, 1, 2)}), 1);
  const Json pole = (*view.message(Topic::objects, 1))["objects"][0];
  EXPECT_EQ(pole["shape"], "cylinder");
  EXPECT_EQ(pole["root"], (std::vector<double>{1, 2, 0}));
  EXPECT_NEAR(pole["radius"].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(pole["axis"][2].get<double>(), 1, 1e-6);
  EXPECT_FALSE(pole.contains("size"));
  EXPECT_FALSE(pole.contains("sd"));
}

TEST(Clouds, FarBeamsAreNoPoints) {
  auto scan = made_scan(3);
  auto points = std::make_shared<std::vector<Eigen::Vector3f>>(*scan.points);
  (*points)[0] = {200, 0, 0};
  (*points)[1] = {NAN, 0, 0};
  scan.points = points;
  RobotView view = made_view();
  view.hear(scan, 1);
  EXPECT_EQ(points_of(*view.message(Topic::points, 1)).size(), 1u);
}

TEST(Clouds, ReflectivityIsAByteOfItsShare) {
  auto scan = made_scan(1);
  scan.reflectivity = std::make_shared<std::vector<float>>(1, 7.0f);  // more than all
  RobotView view = made_view();
  view.hear(scan, 1);
  const Json cloud = *view.message(Topic::points, 1);
  EXPECT_EQ(cloud["point_stride"], 13);
  const std::string data = cloud["data"];
  EXPECT_EQ(data.substr(data.size() - 4), "/w==");  // ff
}

TEST(Clouds, WithoutReflectivityPointsAreTwelveBytes) {
  auto scan = made_scan(4);
  scan.reflectivity = nullptr;
  RobotView view = made_view();
  view.hear(scan, 1);
  const Json cloud = *view.message(Topic::points, 1);
  EXPECT_EQ(cloud["point_stride"], 12);
  EXPECT_EQ(cloud["fields"].size(), 3u);
  EXPECT_EQ(cloud["data"].get<std::string>().size(), 64u);  // 48 bytes
}

TEST(Clouds, AnEmptyScanIsAnEmptyCloud) {
  RobotView view = made_view();
  view.hear(made_scan(0), 1);
  EXPECT_EQ((*view.message(Topic::points, 1))["data"], "");
}

TEST(Clouds, CellsFartherThanTheRadiusAreLeftOut) {
  RobotView view = made_view();
  occupancy::OccupancyGrid grid{
      .resolution_m = 1, .origin = {0, 0, 0}, .size = {40, 1, 1}, .cells = {}};
  grid.cells.assign(40, occupancy::Cell::occupied);
  view.hear(grid, 1);  // without odometry: about the block's middle, 20 m
  const auto cells = points_of(*occupied_cells(view.state(), 1, 2, 100));
  ASSERT_EQ(cells.size(), 4u);
  for (const Eigen::Vector3f& cell : cells) EXPECT_LT(std::abs(cell.x() - 20), 2);
}

}  // namespace
}  // namespace saker::flight::viewers
