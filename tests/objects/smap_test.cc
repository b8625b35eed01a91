#include "saker/objects/smap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

#include "made_map.h"
#include "map_error.h"
#include "saker/core/error.h"
#include "saker/objects/map_io.h"

namespace saker::objects {
namespace {

const ClassTable kTable;

/// Identities, history and covariances for all of it; ground, some of it where nothing else is.
ObjectMap with_details(ObjectMap map) {
  core::Rng rng(7);
  for (MapObject& object : map.objects) {
    object.id = 2 * object.id + 5;
    object.observations = rng.index(40);
    if (rng.chance(0.2)) object.points = rng.index(3000);
    if (rng.chance(0.1)) continue;
    const int rows = std::holds_alternative<Cuboid>(object.model) ? 9 : 6;
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(
        rows, rows, [&](Eigen::Index, Eigen::Index) { return rng.normal(0, 0.05); });
    object.covariance = root * root.transpose();
  }
  for (int i = 0; i < 300; ++i) {
    map.ground.push_back({Eigen::Vector3d(rng.normal(0, 0.1), rng.normal(0, 0.1), 1).normalized(),
                          {rng.uniform(-900, 900), rng.uniform(-900, 900), rng.normal()},
                          rng.uniform(1, 5)});
  }
  return map;
}

/// Objects to all sides of the origin.
ObjectMap centred_map(int count) {
  ObjectMap map = made::large_map(count, 3);
  Eigen::AlignedBox3d extent;
  for (const MapObject& object : map.objects) extent.extend(place(object.model));
  const SE3 T(Eigen::Translation3d(-extent.center()));
  for (MapObject& object : map.objects) object.model = transformed(T, object.model);
  return map;
}

Region box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

bool same(const ObjectMap& a, const ObjectMap& b) {
  return to_json(a, kTable) == to_json(b, kTable);
}

MapRead read_of(const std::string& bytes, const Region& region = kEverywhere) {
  std::istringstream in(bytes);
  return SmapReader(in, "m.smap").read(kTable, region);
}

std::string message(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Smap, GeometryTakesNineBytesAnObjectAtMostAndIsWithinItsErrors) {
  const ObjectMap map = centred_map(20000);
  const std::string bytes = to_smap(map, kTable, SmapContent::geometry);
  EXPECT_LE(static_cast<double>(bytes.size()), 9.0 * static_cast<double>(map.objects.size()));
  const made::MapError worst = made::largest_error(map, from_smap(bytes, kTable, "m.smap"));
  EXPECT_LE(worst.position, 0.018);
  EXPECT_LE(worst.size, 0.0151);
  EXPECT_LE(worst.radius, 0.0051);
  EXPECT_LE(worst.heading, std::numbers::pi / 180);
  EXPECT_LE(worst.tilt, std::numbers::pi / 180);
  EXPECT_LE(worst.probability, 0.0251);
}

TEST(Smap, EverythingComesBackAsTheJsonSaysIt) {
  ObjectMap map = with_details(centred_map(3000));
  const ObjectMap by_json = from_json(to_json(map, kTable), kTable, "m.json");
  const ObjectMap back = from_smap(to_smap(map, kTable), kTable, "m.smap");
  EXPECT_TRUE(same(back, by_json));
  for (std::size_t i = 0; i < map.objects.size(); i += 50) {
    EXPECT_EQ(back.objects[i].covariance, by_json.objects[i].covariance);
    EXPECT_EQ(back.objects[i].class_probability, by_json.objects[i].class_probability);
  }
}

TEST(Smap, AnyOrientationComesBack) {
  core::Rng rng(5);
  ObjectMap map;
  for (int i = 0; i < 500; ++i) {
    MapObject object;
    object.id = i;
    object.class_id = static_cast<ClassId>(1 + i % 2);
    const Eigen::Vector3d turn(rng.normal(), rng.normal(), rng.normal());
    const Eigen::Matrix3d R = core::so3_exp(2 * turn);
    SE3 pose = SE3::Identity();
    pose.translation() << 5 * i, 0, -3;
    pose.linear() = i % 50 == 0 ? core::so3_exp({std::numbers::pi, 0, 0}) : R;
    if (object.class_id == 1) object.model = Cuboid{pose, {4, 2, 1}};
    if (object.class_id == 2) object.model = Cylinder{pose.translation(), R.col(0), 0.2, 3};
    map.objects.push_back(object);
  }
  const ObjectMap back = from_smap(to_smap(map, kTable, SmapContent::geometry), kTable, "m.smap");
  EXPECT_LE(made::largest_error(map, back).tilt, std::numbers::pi / 180);
  EXPECT_LE(made::largest_error(map, back).position, 0.018);
}

TEST(Smap, ARegionIsReadWithoutTheRest) {
  const ObjectMap map = with_details(centred_map(5000));
  for (const SmapContent content : {SmapContent::geometry, SmapContent::everything}) {
    const std::string bytes = to_smap(map, kTable, content);
    const MapRead all = read_of(bytes);
    const Region region = box(-60, -10, 20, 70);
    const MapRead part = read_of(bytes, region);
    EXPECT_GT(part.map.objects.size(), 50U);
    EXPECT_TRUE(same(part.map, clipped(all.map, region)));
    EXPECT_GT(all.tiles_decoded, 30U);
    EXPECT_LE(part.tiles_decoded, 4U);
    EXPECT_EQ(read_of(bytes, box(5000, 5000, 5100, 5100)).tiles_decoded, 0U);
  }
}

TEST(Smap, BytesOutsideOfTheRegionsTilesAreNotTouched) {
  const std::string good = to_smap(centred_map(5000), kTable, SmapContent::geometry);
  std::istringstream in(good);
  const SmapReader reader(in, "m.smap");
  const Region region = box(-60, -10, 20, 70);
  std::string bad = good;
  std::size_t at = reader.head_bytes();
  for (const SmapTile& tile : reader.head().tiles) {
    const auto count = static_cast<std::size_t>(tile.bytes());
    if (!region.intersects(tile.extent(reader.head().steps))) bad.replace(at, count, count, '?');
    at += count;
  }
  const MapRead part = read_of(bad, region);
  EXPECT_TRUE(part.damage.empty());
  EXPECT_TRUE(same(part.map, read_of(good, region).map));
}

TEST(Smap, ObjectsWithoutIdentitiesAreNumberedAlikeInEveryRegion) {
  const std::string bytes = to_smap(centred_map(3000), kTable, SmapContent::geometry);
  const MapRead all = read_of(bytes);
  std::set<int> ids;
  for (const MapObject& object : all.map.objects) ids.insert(object.id);
  EXPECT_EQ(ids.size(), all.map.objects.size());
  EXPECT_EQ(*ids.begin(), 0);
  EXPECT_EQ(*ids.rbegin(), static_cast<int>(ids.size()) - 1);
  const MapRead part = read_of(bytes, box(-60, -10, 20, 70));
  for (const MapObject& object : part.map.objects) {
    const MapObject& same = all.map.objects[static_cast<std::size_t>(object.id)];
    EXPECT_EQ(place(object.model), place(same.model));
  }
}

TEST(Smap, AnEmptyMapIsAFileToo) {
  ObjectMap map;
  map.frame = "base";
  const MapRead read = read_of(to_smap(map, kTable));
  EXPECT_EQ(read.map.frame, "base");
  EXPECT_TRUE(read.map.objects.empty());
  EXPECT_TRUE(read.damage.empty());
}

TEST(Smap, ClassesAreFoundByTheirNames) {
  const ObjectMap map = centred_map(50);
  const std::string bytes = to_smap(map, kTable);
  ClassTable turned = kTable;
  std::reverse(turned.classes.begin(), turned.classes.end());
  EXPECT_TRUE(to_json(from_smap(bytes, turned, "m.smap"), turned) ==
              to_json(from_smap(bytes, kTable, "m.smap"), kTable));
  ClassTable fewer = kTable;
  std::erase_if(fewer.classes, [](const ObjectClass& c) { return c.name == "pole"; });
  const std::string refusal = message([&] { (void)from_smap(bytes, fewer, "m.smap"); });
  EXPECT_NE(refusal.find("m.smap: class \"pole\""), std::string::npos) << refusal;
  ClassTable reshaped = kTable;
  reshaped.classes[3].shape = Shape::cuboid;
  EXPECT_NE(message([&] { (void)from_smap(bytes, reshaped, "m.smap"); }).find("another shape"),
            std::string::npos);
}

TEST(Smap, WhatNoFileCanHoldIsNotWritten) {
  const auto refused = [](const std::function<void(ObjectMap&)>& spoil) {
    ObjectMap map = with_details(centred_map(20));
    spoil(map);
    return message([&] { (void)to_smap(map, kTable); }) != "no error";
  };
  EXPECT_FALSE(refused([](ObjectMap&) {}));
  const auto first_car = [](ObjectMap& map) -> Cuboid& {
    return std::get<Cuboid>(map.objects[0].model);
  };
  EXPECT_TRUE(refused([&](ObjectMap& map) { first_car(map).size.x() = NAN; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { first_car(map).size.x() = 2000; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { first_car(map).pose.translation().z() = 1e12; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { first_car(map).pose.linear()(0, 0) = NAN; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { map.objects[0].class_id = 2; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { map.ground[0].point.x() = INFINITY; }));
  EXPECT_TRUE(refused([&](ObjectMap& map) { map.ground[0].radius = NAN; }));
}

}  // namespace
}  // namespace saker::objects
