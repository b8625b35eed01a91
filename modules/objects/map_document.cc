#include "saker/objects/map_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_numbers.h"

namespace saker::objects {
namespace {

template <class Vector>
Document array(const Vector& values) {
  Document list = Document::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) list.push_back(rounded(values[i]));
  return list;
}

Document named(const CovarianceNumbers& sd, const Model& model) {
  if (std::holds_alternative<Cuboid>(model)) {
    return {{"rotation", array(sd.segment<3>(0))},
            {"position", array(sd.segment<3>(3))},
            {"size", array(sd.segment<3>(6))}};
  }
  return {{"root", array(sd.segment<3>(0))},
          {"axis", array(sd.segment<2>(3))},
          {"radius", rounded(sd[5])}};
}

void add_model(Document& entry, const Cuboid& cuboid) {
  const CuboidNumbers values = numbers(cuboid);
  entry["position"] = array(values.segment<3>(0));
  entry["rotation"] = array(values.segment<4>(3));
  entry["size"] = array(values.segment<3>(7));
}

void add_model(Document& entry, const Cylinder& cylinder) {
  entry["root"] = array(cylinder.root);
  entry["axis"] = array(cylinder.axis);
  entry["radius"] = rounded(cylinder.radius);
  entry["height"] = rounded(cylinder.height);
}

Document object_document(const MapObject& object, const ClassTable& table) {
  Document entry = {{"id", object.id},
                    {"class", table[object.class_id].name},
                    {"probability", rounded(probability_of(object))},
                    {"observations", object.observations}};
  std::visit([&](const auto& model) { add_model(entry, model); }, object.model);
  if (has_covariance(object)) {
    const CovarianceNumbers values = covariance_numbers(object);
    entry["sd"] = named(values, object.model);
    entry["correlation"] = array(values.tail(correlations(object.model)));
  }
  if (object.points >= 0) entry["points"] = object.points;
  return entry;
}

/// One value of a file and the way to it, for messages.
class Node {
 public:
  Node(const Document& value, std::string path) : value_(value), path_(std::move(path)) {}

  [[nodiscard]] bool has(const char* key) const { return value_.contains(key); }

  [[nodiscard]] Node at(const char* key) const {
    if (!value_.is_object()) fail("an object with fields");
    const auto found = value_.find(key);
    const std::string path = path_ + (path_.ends_with(' ') ? "" : ".") + key;
    if (found == value_.end()) throw Error(path + ": missing");
    return {*found, path};
  }

  [[nodiscard]] std::vector<Node> elements() const {
    if (!value_.is_array()) fail("a list");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      nodes.emplace_back(value_[i], fmt::format("{}[{}]", path_, i));
    }
    return nodes;
  }

  [[nodiscard]] double number(double low = -kFarthest_m, double high = kFarthest_m) const {
    if (!value_.is_number()) fail("a number");
    const double number = value_.get<double>();
    if (!(number >= low && number <= high)) fail(fmt::format("{} … {}", low, high));
    return number;
  }

  [[nodiscard]] int integer() const {
    if (!value_.is_number_integer()) fail("a whole number");
    return static_cast<int>(number(-1, 2e9));
  }

  [[nodiscard]] std::string text() const {
    if (!value_.is_string()) fail("a text");
    return value_.get<std::string>();
  }

  [[nodiscard]] Eigen::VectorXd vector(Eigen::Index size, double low, double high) const {
    const std::vector<Node> nodes = elements();
    if (static_cast<Eigen::Index>(nodes.size()) != size) fail(fmt::format("{} numbers", size));
    Eigen::VectorXd values(size);
    for (Eigen::Index i = 0; i < size; ++i)
      values[i] = nodes[static_cast<std::size_t>(i)].number(low, high);
    return values;
  }

  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector(double low = -kFarthest_m,
                                                   double high = kFarthest_m) const {
    return vector(N, low, high);
  }

  /// A vector of length 1, up to what rounding leaves.
  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> unit() const {
    const Eigen::Matrix<double, N, 1> values = vector<N>();
    if (std::abs(values.norm() - 1) > 1e-3) fail("a vector of length 1");
    return values;
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(fmt::format("{}: {}, expected {}", path_, value_.dump().substr(0, 60), expected));
  }

 private:
  const Document& value_;
  std::string path_;
};

// A comma initialiser that an exception leaves half done is an assertion in Eigen: numbers first.
Cuboid read_cuboid(const Node& entry) {
  const Eigen::Vector3d position = entry.at("position").vector<3>();
  const Eigen::Vector4d rotation = entry.at("rotation").unit<4>();
  const Eigen::Vector3d size = entry.at("size").vector<3>(0, kLargestObject_m);
  return cuboid_of((CuboidNumbers() << position, rotation, size).finished());
}

Cylinder read_cylinder(const Node& entry) {
  const Eigen::Vector3d root = entry.at("root").vector<3>();
  const Eigen::Vector3d axis = entry.at("axis").unit<3>();
  const double radius = entry.at("radius").number(0, kLargestObject_m);
  const double height = entry.at("height").number(0, kLargestObject_m);
  return cylinder_of((CylinderNumbers() << root, axis, radius, height).finished());
}

/// Correlations that are not there are 0.
CovarianceNumbers read_covariance(const Node& entry, const Model& model) {
  CovarianceNumbers values = CovarianceNumbers::Zero(deviations(model) + correlations(model));
  const Node sd = entry.at("sd");
  if (std::holds_alternative<Cuboid>(model)) {
    values.head<3>() = sd.at("rotation").vector<3>(0);
    values.segment<3>(3) = sd.at("position").vector<3>(0);
    values.segment<3>(6) = sd.at("size").vector<3>(0);
  } else {
    values.head<3>() = sd.at("root").vector<3>(0);
    values.segment<2>(3) = sd.at("axis").vector<2>(0);
    values[5] = sd.at("radius").number(0);
  }
  if (entry.has("correlation")) {
    values.tail(correlations(model)) = entry.at("correlation").vector(correlations(model), -1, 1);
  }
  return values;
}

MapObject object_of(const Node& entry, const ClassTable& table) {
  MapObject object;
  const Node name = entry.at("class");
  try {
    object.class_id = table.find(name.text());
  } catch (const Error& error) {
    name.fail("a class of the table with a shape: " + std::string(error.what()));
  }
  const Shape shape = table[object.class_id].shape;
  if (shape != Shape::cuboid && shape != Shape::cylinder)
    name.fail("a class of cuboids or cylinders");
  object.id = entry.at("id").integer();
  object.observations = entry.at("observations").integer();
  object.class_probability = spread(entry.at("probability").number(0, 1), object.class_id, table);
  if (shape == Shape::cuboid) {
    object.model = read_cuboid(entry);
  } else {
    object.model = read_cylinder(entry);
  }
  if (entry.has("sd")) {
    object.covariance = covariance_of(object.model, read_covariance(entry, object.model));
  }
  if (entry.has("points")) object.points = entry.at("points").integer();
  return object;
}

}  // namespace

Document to_document(const ObjectMap& map, const ClassTable& table) {
  Document document = {
      {"frame", map.frame}, {"objects", Document::array()}, {"ground", Document::array()}};
  for (const MapObject& object : map.objects) {
    document["objects"].push_back(object_document(object, table));
  }
  for (const GroundPlane& plane : map.ground) {
    document["ground"].push_back(Document{{"normal", array(plane.normal)},
                                          {"point", array(plane.point)},
                                          {"radius", rounded(plane.radius)}});
  }
  return document;
}

ObjectMap from_document(const Document& document, const ClassTable& table,
                        const std::string& file) {
  const Node root(document, file + ": ");
  ObjectMap map;
  map.frame = root.at("frame").text();
  for (const Node& entry : root.at("objects").elements()) {
    map.objects.push_back(object_of(entry, table));
  }
  for (const Node& entry : root.at("ground").elements()) {
    map.ground.push_back({entry.at("normal").unit<3>().normalized(), entry.at("point").vector<3>(),
                          entry.at("radius").number(0, kLargestObject_m)});
  }
  return map;
}

}  // namespace saker::objects
