#include "saker/objects/map_kml.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

ObjectMap with(const Model& model, ClassId id, int class_count = 5) {
  MapObject object;
  object.id = 7;
  object.class_id = id;
  object.class_probability.assign(static_cast<std::size_t>(class_count), 0.05);
  object.class_probability[id] = 0.8;
  object.observations = 4;
  object.model = model;
  ObjectMap map;
  map.objects = {object};
  return map;
}

const Cylinder kPole{{10, 20, 0.5}, Eigen::Vector3d::UnitZ(), 0.1, 5};

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  const std::size_t first = from + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

std::string coordinates(const std::string& kml) {
  return between(kml, "<coordinates>", "</coordinates>");
}

// On the equator a degree of longitude is a π / 180 = 111319.4908 m, one of latitude
// a (1 − e²) π / 180 = 110574.2758 m.
TEST(MapKml, AtTheEquatorXIsEastWithHeading90) {
  const std::string kml = to_kml(with(kPole, 3), {}, {0, 0, 90});
  EXPECT_EQ(coordinates(kml), "0.00008983,0.00018087,5.000");  // 10 m east, 20 m north
}

TEST(MapKml, AtTheEquatorXIsNorthAndYWestWithHeading0) {
  const std::string kml = to_kml(with(kPole, 3), {}, {0, 0, 0});
  EXPECT_EQ(coordinates(kml), "-0.00017966,0.00009044,5.000");  // 10 m north, 20 m west
}

// At 60° the parallel's radius is a cos φ / √(1 − e² sin² φ) = 3197104.587 m, the meridian's
// a (1 − e²) / (1 − e² sin² φ)^1.5 = 6383453.857 m.
TEST(MapKml, AtSixtyDegreesADegreeOfLongitudeIsHalfAsLong) {
  const std::string kml = to_kml(with(kPole, 3), {}, {60, 20, 90});
  EXPECT_EQ(coordinates(kml), "20.00017921,60.00017951,5.000");
}

TEST(MapKml, ACuboidIsItsFootprintClosedAndAsHighAsIt) {
  Cuboid car;
  car.size << 4, 2, 1.5;
  const std::string ring = coordinates(to_kml(with(car, 1), {}, {0, 0, 90}));
  // Corners 2 m east or west and 1 m north or south: 0.00001797° and 0.00000904°.
  EXPECT_EQ(ring,
            "0.00001797,0.00000904,1.500 -0.00001797,0.00000904,1.500 "
            "-0.00001797,-0.00000904,1.500 0.00001797,-0.00000904,1.500 "
            "0.00001797,0.00000904,1.500");
}

TEST(MapKml, SizesAndTheHeadingFromNorthAreData) {
  Cuboid car;
  car.size << 4, 2, 1.5;
  car.pose.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const std::string kml = to_kml(with(car, 1), {}, {0, 0, 30});
  const auto datum = [&](const std::string& name) {
    return between(kml, "<Data name=\"" + name + "\"><value>", "</value>");
  };
  EXPECT_EQ(datum("length_m"), "4.000");
  EXPECT_EQ(datum("heading_deg"), "300.00");  // a quarter to the left of 30°
  EXPECT_EQ(datum("observations"), "4");
  EXPECT_EQ(datum("class"), "vehicle");
}

TEST(MapKml, NamesOfClassesAreEscaped) {
  ClassTable table;
  table.classes[3].name = "a<b & \"c\">\n";
  const std::string kml = to_kml(with(kPole, 3), table, {0, 0});
  EXPECT_EQ(between(kml, "<Folder><name>", "</name>"), "a&lt;b &amp; &quot;c&quot;&gt;");
}

TEST(MapKml, AnEmptyMapHasNoPlacemark) {
  const std::string kml = to_kml({}, {}, {0, 0});
  EXPECT_NE(kml.find("<Document>"), std::string::npos);
  EXPECT_EQ(kml.find("<Placemark"), std::string::npos);
}

TEST(MapKml, WhatIsNoPlaceIsRefused) { EXPECT_THROW(to_kml({}, {}, {91, 0}), Error); }

}  // namespace
}  // namespace saker::objects
