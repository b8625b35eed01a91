#include "objects/map_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "objects/measurement.h"

namespace saker::objects {
namespace {

/// Six decimals: a micrometre, and the same value in both forms of a file.
double rounded(double value) {
  if (!std::isfinite(value)) throw Error("object map: a number is not finite");
  return std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0: no negative zero
}

template <class Vector>
Document array(const Vector& values) {
  Document list = Document::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) list.push_back(rounded(values[i]));
  return list;
}

Document standard_deviations(const MapObject& object) {
  const Eigen::VectorXd sd = object.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  if (sd.size() == 9) {
    return {{"rotation", array(sd.segment<3>(0))},
            {"position", array(sd.segment<3>(3))},
            {"size", array(sd.segment<3>(6))}};
  }
  return {{"root", array(sd.segment<3>(0))},
          {"axis", array(sd.segment<2>(3))},
          {"radius", rounded(sd[5])}};
}

/// Upper triangle of the planar part, row by row.
Document correlations(const MapObject& object) {
  const std::vector<int> rows = planar_rows(object.model);
  const Eigen::MatrixXd P = object.covariance(rows, rows);
  Document list = Document::array();
  for (Eigen::Index i = 0; i < P.rows(); ++i) {
    for (Eigen::Index j = i + 1; j < P.cols(); ++j) {
      const double scale = std::sqrt(P(i, i) * P(j, j));
      list.push_back(rounded(scale > 0 ? std::clamp(P(i, j) / scale, -1.0, 1.0) : 0));
    }
  }
  return list;
}

void add_model(Document& entry, const Cuboid& cuboid) {
  Eigen::Quaterniond q(cuboid.pose.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  entry["position"] = array(cuboid.pose.translation());
  entry["rotation"] = array(q.coeffs());
  entry["size"] = array(cuboid.size);
}

void add_model(Document& entry, const Cylinder& cylinder) {
  entry["root"] = array(cylinder.root);
  entry["axis"] = array(cylinder.axis);
  entry["radius"] = rounded(cylinder.radius);
  entry["height"] = rounded(cylinder.height);
}

double probability_of(const MapObject& object) {
  if (object.class_id >= object.class_probability.size()) return 1;
  return object.class_probability[object.class_id];
}

Document object_document(const MapObject& object, const ClassTable& table) {
  Document entry = {{"id", object.id},
                    {"class", table[object.class_id].name},
                    {"probability", rounded(probability_of(object))},
                    {"observations", object.observations}};
  std::visit([&](const auto& model) { add_model(entry, model); }, object.model);
  if (object.covariance.size() > 0 && object.covariance.allFinite()) {
    entry["sd"] = standard_deviations(object);
    entry["correlation"] = correlations(object);
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

  [[nodiscard]] double number(double low = -1e9, double high = 1e9) const {
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

  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector(double low = -1e9, double high = 1e9) const {
    const std::vector<Node> nodes = elements();
    if (nodes.size() != N) fail(fmt::format("{} numbers", N));
    Eigen::Matrix<double, N, 1> values;
    for (int i = 0; i < N; ++i) values[i] = nodes[static_cast<std::size_t>(i)].number(low, high);
    return values;
  }

  /// A vector of length 1, up to what rounding leaves.
  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> unit() const {
    const Eigen::Matrix<double, N, 1> values = vector<N>();
    if (std::abs(values.norm() - 1) > 1e-3) fail("a vector of length 1");
    return values.normalized();
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(fmt::format("{}: {}, expected {}", path_, value_.dump().substr(0, 60), expected));
  }

 private:
  const Document& value_;
  std::string path_;
};

constexpr double kLargestObject = 1000;  // m: what is larger is a wrong unit

Cuboid cuboid_of(const Node& entry) {
  Cuboid cuboid;
  const Eigen::Vector4d q = entry.at("rotation").unit<4>();
  cuboid.pose.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  cuboid.pose.translation() = entry.at("position").vector<3>();
  cuboid.size = entry.at("size").vector<3>(0, kLargestObject);
  return cuboid;
}

Cylinder cylinder_of(const Node& entry) {
  return {entry.at("root").vector<3>(), entry.at("axis").unit<3>(),
          entry.at("radius").number(0, kLargestObject),
          entry.at("height").number(0, kLargestObject)};
}

Eigen::MatrixXd covariance_of(const Node& sd, Shape shape) {
  if (shape == Shape::cuboid) {
    Vector9d values;
    values.segment<3>(0) = sd.at("rotation").vector<3>(0);
    values.segment<3>(3) = sd.at("position").vector<3>(0);
    values.segment<3>(6) = sd.at("size").vector<3>(0);
    return values.cwiseAbs2().asDiagonal();
  }
  Vector6d values;
  values.segment<3>(0) = sd.at("root").vector<3>(0);
  values.segment<2>(3) = sd.at("axis").vector<2>(0);
  values[5] = sd.at("radius").number(0);
  return values.cwiseAbs2().asDiagonal();
}

void add_correlations(const Node& list, const Model& model, Eigen::MatrixXd& covariance) {
  const std::vector<int> rows = planar_rows(model);
  const std::vector<Node> values = list.elements();
  const std::size_t pairs = rows.size() * (rows.size() - 1) / 2;
  if (values.size() != pairs) list.fail(fmt::format("{} numbers", pairs));
  std::size_t next = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const double sd_sd = std::sqrt(covariance(rows[i], rows[i]) * covariance(rows[j], rows[j]));
      covariance(rows[i], rows[j]) = values[next++].number(-1, 1) * sd_sd;
      covariance(rows[j], rows[i]) = covariance(rows[i], rows[j]);
    }
  }
}

/// What the file does not say is spread evenly over the other classes.
std::vector<double> spread(double probability, ClassId id, const ClassTable& table) {
  const auto count = static_cast<std::size_t>(table.size());
  std::vector<double> all(
      count, (1 - probability) / static_cast<double>(std::max<std::size_t>(count - 1, 1)));
  all[id] = probability;
  return all;
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
    object.model = cuboid_of(entry);
  } else {
    object.model = cylinder_of(entry);
  }
  if (entry.has("sd")) object.covariance = covariance_of(entry.at("sd"), shape);
  if (entry.has("sd") && entry.has("correlation"))
    add_correlations(entry.at("correlation"), object.model, object.covariance);
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
    map.ground.push_back({entry.at("normal").unit<3>(), entry.at("point").vector<3>(),
                          entry.at("radius").number(0, kLargestObject)});
  }
  return map;
}

}  // namespace saker::objects
