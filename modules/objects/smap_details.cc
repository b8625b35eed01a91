#include "saker/objects/smap_details.h"

#include <fmt/format.h>

#include <cmath>

#include "saker/core/error.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_numbers.h"
#include "saker/objects/rice.h"

namespace saker::objects {
namespace {

constexpr double kPerUnit = 1e6;  ///< six decimals
constexpr int kPlaneNumbers = 7;
constexpr double kMostWhole = 2e9;

using Column = std::vector<std::int64_t>;

std::int64_t fixed(double value) {
  if (!(std::abs(value) <= kFarthest_m)) {
    throw Error(fmt::format("object map: {}, expected {} … {}", value, -kFarthest_m, kFarthest_m));
  }
  return std::llround(rounded(value) * kPerUnit);
}

double checked(double value, double low, double high) {
  if (value >= low && value <= high) return value;
  throw Error(fmt::format("{}, expected {} … {}", value, low, high));
}

double number(std::int64_t fixed, double low = -kFarthest_m, double high = kFarthest_m) {
  return checked(static_cast<double>(fixed) / kPerUnit, low, high);
}

int whole(std::int64_t value) {
  return static_cast<int>(checked(static_cast<double>(value), -1, kMostWhole));
}

template <class Values>
void check_all(const Values& values, double low, double high) {
  for (const double value : values) (void)checked(value, low, high);
}

template <class Values>
void check_unit(const Values& values) {
  if (!(std::abs(values.norm() - 1) < 1e-3)) throw Error("a vector that is not of length 1");
}

/// Up to 15 numbers, none of them on the heap.
using Numbers = CovarianceNumbers;

/// Vectors of the same length as columns, and back.
void write_vectors(BitWriter& out, const std::vector<Numbers>& vectors) {
  Column column(vectors.size());
  for (Eigen::Index row = 0; !vectors.empty() && row < vectors.front().size(); ++row) {
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = fixed(vectors[i][row]);
    write_column(out, column);
  }
}

std::vector<Numbers> read_vectors(BitReader& in, std::size_t count, Eigen::Index length) {
  if (count > in.bits_left()) throw Error("its content ends too early");
  std::vector<Numbers> vectors(count, Numbers(length));
  for (Eigen::Index row = 0; row < length; ++row) {
    const Column column = read_column(in, count);
    for (std::size_t i = 0; i < count; ++i) vectors[i][row] = number(column[i]);
  }
  return vectors;
}

void set_model(MapObject& object, const Numbers& values) {
  if (std::holds_alternative<Cuboid>(object.model)) {
    check_unit(values.segment<4>(3));
    check_all(values.tail<3>(), 0, kLargestObject_m);
    object.model = cuboid_of(values);
  } else {
    check_unit(values.segment<3>(3));
    check_all(values.tail<2>(), 0, kLargestObject_m);
    object.model = cylinder_of(values);
  }
}

void set_covariance(MapObject& object, const Numbers& values) {
  check_all(values.head(deviations(object.model)), 0, kFarthest_m);
  check_all(values.tail(correlations(object.model)), -1, 1);
  object.covariance = covariance_of(object.model, values);
}

/// Objects of one shape.
void write_alike(BitWriter& out, const std::vector<const MapObject*>& objects) {
  std::vector<Numbers> models, covariances;
  for (const MapObject* object : objects) {
    models.push_back(
        std::visit([](const auto& model) { return Numbers(numbers(model)); }, object->model));
    if (has_covariance(*object)) covariances.push_back(covariance_numbers(*object));
  }
  write_vectors(out, models);
  write_vectors(out, covariances);
}

void read_alike(BitReader& in, const std::vector<MapObject*>& objects,
                const std::vector<MapObject*>& with_covariance) {
  if (objects.empty()) return;
  const Model& model = objects.front()->model;
  const bool cuboids = std::holds_alternative<Cuboid>(model);
  const auto models = read_vectors(in, objects.size(), cuboids ? kCuboidNumbers : kCylinderNumbers);
  const auto covariances =
      read_vectors(in, with_covariance.size(), deviations(model) + correlations(model));
  for (std::size_t i = 0; i < objects.size(); ++i) set_model(*objects[i], models[i]);
  for (std::size_t i = 0; i < with_covariance.size(); ++i) {
    set_covariance(*with_covariance[i], covariances[i]);
  }
}

template <class Member>
void write_whole(BitWriter& out, std::span<const Listed<const MapObject*>> objects, Member member) {
  Column column;
  column.reserve(objects.size());
  for (const auto& object : objects) column.push_back(member(object));
  write_column(out, column);
}

/// Places in the list ascend; identities mostly go with them.
void read_identities(BitReader& in, const ClassTable& table, std::span<Listed<MapObject>> objects) {
  const Column places = read_column(in, objects.size()), ids = read_column(in, objects.size());
  const Column observations = read_column(in, objects.size());
  const Column points = read_column(in, objects.size());
  const Column probabilities = read_column(in, objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    MapObject& object = objects[i].value;
    objects[i].place = whole(places[i]);
    object.id = whole(static_cast<std::int64_t>(
                          checked(static_cast<double>(ids[i]), -2 * kMostWhole, kMostWhole)) +
                      objects[i].place);
    object.observations = whole(observations[i]);
    object.points = whole(points[i]);
    object.class_probability = spread(number(probabilities[i], 0, 1), object.class_id, table);
  }
}

}  // namespace

std::string pack_ground(std::span<const Listed<GroundPlane>> planes) {
  BitWriter out;
  Column places;
  std::vector<Numbers> vectors;
  for (const auto& [place, plane] : planes) {
    places.push_back(place);
    vectors.emplace_back(kPlaneNumbers) << plane.normal, plane.point, plane.radius;
  }
  write_column(out, places);
  write_vectors(out, vectors);
  return out.finish();
}

std::vector<Listed<GroundPlane>> unpack_ground(std::string bytes, std::size_t count) {
  BitReader in(std::move(bytes));
  const Column places = read_column(in, count);
  const auto vectors = read_vectors(in, count, kPlaneNumbers);
  std::vector<Listed<GroundPlane>> planes;
  for (std::size_t i = 0; i < count; ++i) {
    const Numbers& values = vectors[i];
    check_unit(values.head<3>());
    planes.push_back({whole(places[i]),
                      {values.head<3>().normalized(), values.segment<3>(3),
                       checked(values[6], 0, kLargestObject_m)}});
  }
  return planes;
}

std::string pack_details(std::span<const Listed<const MapObject*>> objects) {
  using Entry = Listed<const MapObject*>;
  BitWriter out;
  write_whole(out, objects, [](const Entry& e) { return e.place; });
  write_whole(out, objects, [](const Entry& e) { return e.value->id - e.place; });
  write_whole(out, objects, [](const Entry& e) { return std::int64_t{e.value->observations}; });
  write_whole(out, objects, [](const Entry& e) { return std::int64_t{e.value->points}; });
  write_whole(out, objects, [](const Entry& e) { return fixed(probability_of(*e.value)); });
  write_whole(out, objects, [](const Entry& e) { return std::int64_t{has_covariance(*e.value)}; });
  std::vector<const MapObject*> cuboids, cylinders;
  for (const Entry& entry : objects) {
    const bool cuboid = std::holds_alternative<Cuboid>(entry.value->model);
    (cuboid ? cuboids : cylinders).push_back(entry.value);
  }
  write_alike(out, cuboids);
  write_alike(out, cylinders);
  return out.finish();
}

void unpack_details(std::string bytes, const ClassTable& table,
                    std::span<Listed<MapObject>> objects) {
  BitReader in(std::move(bytes));
  read_identities(in, table, objects);
  const Column with_covariance = read_column(in, objects.size());
  std::vector<MapObject*> cuboids, cylinders, known_cuboids, known_cylinders;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    MapObject& object = objects[i].value;
    const bool cuboid = std::holds_alternative<Cuboid>(object.model);
    (cuboid ? cuboids : cylinders).push_back(&object);
    if (with_covariance[i] != 0) (cuboid ? known_cuboids : known_cylinders).push_back(&object);
  }
  read_alike(in, cuboids, known_cuboids);
  read_alike(in, cylinders, known_cylinders);
}

}  // namespace saker::objects
