#include "saker/objects/map_export.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace saker::objects {
namespace {

/// A car that points along y, a pole of 5 m.
ObjectMap some_map() {
  ObjectMap map;
  MapObject car;
  car.id = 3;
  car.class_id = 1;
  car.class_probability = {0.025, 0.9, 0.025, 0.025, 0.025};
  car.observations = 12;
  car.model = Cuboid{core::se3_exp((Vector6d() << 0, 0, std::numbers::pi / 2, 0, 0, 0).finished()),
                     {4, 2, 1.5}};
  std::get<Cuboid>(car.model).pose.translation() << 10, 20, 0.75;
  car.covariance = Matrix9d(0.01 * Matrix9d::Identity());
  MapObject pole;
  pole.id = 8;
  pole.class_id = 3;
  pole.class_probability = {0.1, 0.1, 0.1, 0.6, 0.1};
  pole.model = Cylinder{{-3, 2, 0.5}, Eigen::Vector3d::UnitZ(), 0.1, 5};
  map.objects = {car, pole};
  return map;
}

std::vector<std::vector<std::string>> cells(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> row(1);
    for (const char c : line) {
      if (c == ',') {
        row.emplace_back();
      } else {
        row.back().push_back(c);
      }
    }
    rows.push_back(row);
  }
  return rows;
}

TEST(MapExport, CsvHasACellForEachColumnOfItsHeader) {
  const auto rows = cells(to_csv(some_map(), {}));
  ASSERT_EQ(rows.size(), 3U);
  const auto value = [&](std::size_t row, const std::string& column) {
    const auto at = std::find(rows[0].begin(), rows[0].end(), column) - rows[0].begin();
    return rows[row].at(static_cast<std::size_t>(at));
  };
  EXPECT_EQ(rows[1].size(), rows[0].size());
  EXPECT_EQ(rows[2].size(), rows[0].size());
  EXPECT_EQ(value(1, "class"), "vehicle");
  EXPECT_EQ(std::stod(value(1, "heading_deg")), 90);
  EXPECT_EQ(std::stod(value(1, "width_m")), 2);
  EXPECT_EQ(std::stod(value(1, "sd_length_m")), 0.1);
  EXPECT_EQ(value(1, "radius_m"), "");
  EXPECT_EQ(std::stod(value(2, "radius_m")), 0.1);
  EXPECT_EQ(std::stod(value(2, "height_m")), 5);
  EXPECT_EQ(value(2, "length_m"), "");
  EXPECT_EQ(value(2, "sd_x_m"), "");
}

TEST(MapExport, GeoJsonHasFootprintsWhereTheOriginSays) {
  const auto document = nlohmann::json::parse(to_geojson(some_map(), {}, {48, 11}));
  EXPECT_EQ(document["type"], "FeatureCollection");
  ASSERT_EQ(document["features"].size(), 2U);
  const auto& car = document["features"][0];
  EXPECT_EQ(car["geometry"]["type"], "Polygon");
  const auto& ring = car["geometry"]["coordinates"][0];
  ASSERT_EQ(ring.size(), 5U);
  EXPECT_EQ(ring[0], ring[4]);
  // Its front left corner: 9 m east, 22 m north.
  const GeoPoint corner = TangentPlane({48, 11}).geodetic({9, 22, 0.75});
  EXPECT_NEAR(ring[0][0].get<double>(), corner.longitude_deg, 1e-8);
  EXPECT_NEAR(ring[0][1].get<double>(), corner.latitude_deg, 1e-8);
  EXPECT_EQ(car["properties"]["heading_deg"], 0);
  EXPECT_EQ(car["properties"]["length_m"], 4);
  const auto& pole = document["features"][1];
  EXPECT_EQ(pole["geometry"]["type"], "Point");
  EXPECT_EQ(pole["properties"]["class"], "pole");
  EXPECT_EQ(pole["properties"]["radius_m"], 0.1);
}

TEST(MapExport, GeoJsonsRingsRunCounterclockwise) {
  const auto document = nlohmann::json::parse(to_geojson(some_map(), {}, {-33, 151, 200}));
  const auto& ring = document["features"][0]["geometry"]["coordinates"][0];
  double twice_the_area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = ring[i][0].get<double>() - 151, y = ring[i][1].get<double>() + 33;
    const double next_x = ring[i + 1][0].get<double>() - 151;
    twice_the_area += x * (ring[i + 1][1].get<double>() + 33) - next_x * y;
  }
  EXPECT_GT(twice_the_area, 0);
}

TEST(MapExport, AMapWithoutObjectsIsStillGeoJson) {
  EXPECT_EQ(nlohmann::json::parse(to_geojson({}, {}, {0, 0}))["features"].size(), 0U);
}

struct Ply {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::vector<int>> faces;
};

int count_of(const std::string& bytes, const std::string& element) {
  return std::stoi(bytes.substr(bytes.find("element " + element) + 9 + element.size()));
}

Ply parsed(const std::string& bytes) {
  Ply ply;
  std::size_t at = bytes.find("end_header\n") + 11;
  for (int i = count_of(bytes, "vertex"); i > 0; --i, at += 15) {
    std::memcpy(ply.vertices.emplace_back().data(), bytes.data() + at, 12);
  }
  for (int i = count_of(bytes, "face"); i > 0; --i) {
    auto& face = ply.faces.emplace_back(static_cast<std::uint8_t>(bytes.at(at++)));
    std::memcpy(face.data(), bytes.data() + at, 4 * face.size());
    at += 4 * face.size();
  }
  EXPECT_EQ(at, bytes.size());
  return ply;
}

/// Of a closed mesh whose faces run counterclockwise seen from outside (divergence theorem).
double volume(const Ply& ply, std::size_t first, std::size_t last) {
  double six_times = 0;
  for (std::size_t f = first; f < last; ++f) {
    const auto corner = [&](std::size_t i) {
      return Eigen::Vector3d(
          ply.vertices.at(static_cast<std::size_t>(ply.faces[f][i])).cast<double>());
    };
    for (std::size_t i = 1; i + 1 < ply.faces[f].size(); ++i) {
      six_times += corner(0).dot(corner(i).cross(corner(i + 1)));
    }
  }
  return six_times / 6;
}

TEST(MapExport, PlyHoldsClosedMeshesOfTheRightVolume) {
  const Ply ply = parsed(to_ply(some_map(), {}));
  ASSERT_EQ(ply.faces.size(), 6U + 18U);
  EXPECT_NEAR(volume(ply, 0, 6), 4 * 2 * 1.5, 1e-3);
  const double sixteen_sides = 8 * std::sin(std::numbers::pi / 8) * 0.1 * 0.1;
  EXPECT_NEAR(volume(ply, 6, 24), sixteen_sides * 5, 1e-4);
}

TEST(MapExport, PlyPutsObjectsWhereTheyAre) {
  const Ply ply = parsed(to_ply(some_map(), {}));
  Eigen::AlignedBox3f car;
  for (std::size_t i = 0; i < 8; ++i) car.extend(ply.vertices[i]);
  EXPECT_TRUE(car.min().isApprox(Eigen::Vector3f(9, 18, 0), 1e-5F));
  EXPECT_TRUE(car.max().isApprox(Eigen::Vector3f(11, 22, 1.5), 1e-5F));
}

}  // namespace
}  // namespace saker::objects
