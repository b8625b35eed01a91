#include "saker/objects/map_io.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

ObjectMap some_map() {
  ObjectMap map;
  MapObject car;
  car.id = 3;
  car.class_id = 1;
  car.class_probability = {0.025, 0.9, 0.025, 0.025, 0.025};
  car.observations = 12;
  car.model = Cuboid{core::se3_exp((Vector6d() << 0.01, -0.02, 2.2, 5, 2, 0.75).finished()),
                     {4.4, 1.8, 1.5}};
  car.covariance = Matrix9d(0.01 * Matrix9d::Identity());
  car.covariance(3, 6) = car.covariance(6, 3) = -0.0032;
  MapObject pole;
  pole.id = 8;
  pole.class_id = 3;
  pole.class_probability = {0.1, 0.1, 0.1, 0.6, 0.1};
  pole.observations = 4;
  pole.model = Cylinder{{-3, 2, 0.1}, Eigen::Vector3d(0.02, -0.01, 1).normalized(), 0.11, 5.5};
  pole.points = 77;
  map.objects = {car, pole};
  map.ground.push_back({Eigen::Vector3d(0.01, 0, 1).normalized(), {1, 2, 3}, 4});
  return map;
}

std::string message(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal(const std::string& text) {
  return message([&] { (void)from_json(text, {}, "map.json"); });
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(MapIo, BothFormsGiveTheSameMapBack) {
  const ClassTable table;
  const std::string json = to_json(some_map(), table);
  const ObjectMap a = from_json(json, table, "a"),
                  b = from_smap(to_smap(some_map(), table), table, "b");
  for (const ObjectMap* map : {&a, &b}) {
    EXPECT_EQ(to_json(*map, table), json);
    ASSERT_EQ(map->objects.size(), 2U);
    const auto& car = std::get<Cuboid>(map->objects[0].model);
    EXPECT_TRUE(car.pose.isApprox(std::get<Cuboid>(some_map().objects[0].model).pose, 1e-5));
    EXPECT_NEAR(map->objects[0].covariance(8, 8), 0.01, 1e-6);
    EXPECT_EQ(map->objects[1].points, 77);
    EXPECT_EQ(map->objects[1].class_id, 3);
    EXPECT_EQ(map->objects[1].covariance.size(), 0);
  }
}

TEST(MapIo, CorrelationsOfPlaceAndSizeAreKept) {
  ObjectMap map = some_map();
  map.objects[1].covariance = Matrix6d(0.04 * Matrix6d::Identity());
  map.objects[1].covariance(0, 1) = map.objects[1].covariance(1, 0) = 0.01;
  const std::string json = to_json(map, {});
  const ObjectMap back = from_json(json, {}, "a");
  EXPECT_NEAR(back.objects[0].covariance(3, 6), -0.0032, 1e-7);
  EXPECT_NEAR(back.objects[0].covariance(6, 3), -0.0032, 1e-7);
  EXPECT_EQ(back.objects[0].covariance(3, 4), 0);
  EXPECT_NEAR(back.objects[1].covariance(1, 0), 0.01, 1e-7);
  EXPECT_EQ(to_json(back, {}), json);
  EXPECT_NE(refusal(replaced(json, "-0.32", "-1.32")).find("objects[0].correlation[1]"),
            std::string::npos);
}

TEST(MapIo, FormFollowsTheEndingAndTheContent) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "map_io";
  std::filesystem::create_directories(folder);
  write_map(folder / "m.smap", some_map(), {});
  write_map(folder / "m.json", some_map(), {});
  EXPECT_EQ(read_map(folder / "m.smap", {}).objects.size(), 2U);
  EXPECT_EQ(read_map(folder / "m.json", {}).objects.size(), 2U);
  EXPECT_NE(message([&] { write_map(folder / "m.txt", some_map(), {}); }).find(".json or .smap"),
            std::string::npos);
  EXPECT_NE(message([&] { (void)read_map(folder / "none.json", {}); }).find("none.json"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(MapIo, FaultsInJsonAreNamedWithTheField) {
  const std::string good = to_json(some_map(), {});
  EXPECT_NE(refusal("").find("not JSON"), std::string::npos);
  EXPECT_NE(refusal("[]").find("map.json"), std::string::npos);
  EXPECT_NE(refusal("{}").find("frame: missing"), std::string::npos);
  EXPECT_NE(refusal(replaced(good, "\"radius\"", "\"radios\"")).find("objects[1].radius: missing"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, "\"vehicle\"", "\"lorry\"")).find("objects[0].class"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, "\"vehicle\"", "\"ground\"")).find("objects[0].class"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, "4.4", "-4.4")).find("objects[0].size[0]"), std::string::npos);
  EXPECT_NE(refusal(replaced(good, "4.4", "null")).find("expected a number"), std::string::npos);
  EXPECT_NE(refusal(replaced(good, "0.9", "1.9")).find("objects[0].probability"),
            std::string::npos);
}

TEST(MapIo, EveryCutAndEveryFlippedByteOfASmapIsRefused) {
  const std::string good = to_smap(some_map(), {});
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_NE(message([&] { (void)from_smap(good.substr(0, size), {}, "m.smap"); }).find("m.smap"),
              std::string::npos);
  }
  for (std::size_t at = 0; at < good.size(); at += 5) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    EXPECT_NE(message([&] { (void)from_smap(bad, {}, "m.smap"); }).find("m.smap"),
              std::string::npos)
        << at;
  }
}

TEST(MapIo, WhatIsNotFiniteIsNotWritten) {
  ObjectMap map = some_map();
  std::get<Cuboid>(map.objects[0].model).size.x() = NAN;
  EXPECT_THROW((void)to_json(map, {}), Error);
}

}  // namespace
}  // namespace saker::objects
