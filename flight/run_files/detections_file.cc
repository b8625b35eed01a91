#include "flight/run_files/detections_file.h"

#include <fmt/format.h>

#include <sstream>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight {
namespace {

using Json = nlohmann::json;

Json numbers(const Eigen::Ref<const Eigen::VectorXd>& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

Json model_json(const objects::Model& model) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    const Eigen::Quaterniond q(cuboid->pose.linear());
    return {{"position", numbers(cuboid->pose.translation())},
            {"rotation", numbers(q.coeffs())},
            {"size", numbers(cuboid->size)}};
  }
  const auto& cylinder = std::get<objects::Cylinder>(model);
  return {{"root", numbers(cylinder.root)},
          {"axis", numbers(cylinder.axis)},
          {"radius", cylinder.radius},
          {"height", cylinder.height}};
}

double number(const Json& entry, double low, double high) {
  const double value = entry.get<double>();
  if (!(value >= low && value <= high)) {
    throw Error(fmt::format("{}, expected {:g} ... {:g}", value, low, high));
  }
  return value;
}

template <int N>
Eigen::Matrix<double, N, 1> vector(const Json& entry, double low, double high) {
  if (!entry.is_array() || entry.size() != N) {
    throw Error(fmt::format("{}, expected {} numbers", entry.dump(), N));
  }
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i) v[i] = number(entry[static_cast<std::size_t>(i)], low, high);
  return v;
}

constexpr double kFarthest = 1e3;  ///< m from the sensor, of anything measured

objects::Cuboid read_cuboid(const Json& model) {
  objects::Cuboid cuboid;
  const Eigen::Quaterniond q(vector<4>(model.at("rotation"), -1.001, 1.001));
  cuboid.pose.linear() = q.normalized().toRotationMatrix();
  cuboid.pose.translation() = vector<3>(model.at("position"), -kFarthest, kFarthest);
  cuboid.size = vector<3>(model.at("size"), 0, kFarthest);
  return cuboid;
}

objects::Cylinder read_cylinder(const Json& model) {
  return {vector<3>(model.at("root"), -kFarthest, kFarthest),
          vector<3>(model.at("axis"), -1.001, 1.001).normalized(),
          number(model.at("radius"), 0, kFarthest), number(model.at("height"), 0, kFarthest)};
}

std::vector<double> read_probability(const Json& entry, const objects::ClassTable& table) {
  std::vector<double> probability;
  for (const Json& p : entry) probability.push_back(number(p, 0, 1));
  if (static_cast<int>(probability.size()) == table.size()) return probability;
  throw Error(
      fmt::format("class_probability: {} numbers, expected {}", probability.size(), table.size()));
}

objects::Measurement read_measurement(const Json& row, const objects::ClassTable& table) {
  objects::Measurement m;
  m.stamp = from_seconds(number(row.at("time"), -1e10, 1e10));
  m.class_id = table.find(row.at("class").get<std::string>());
  m.class_probability = read_probability(row.at("class_probability"), table);
  const Json& model = row.at("model");  // what was fitted may look more like something else
  if (model.contains("root")) {
    m.model = read_cylinder(model);
  } else {
    m.model = read_cuboid(model);
  }
  m.points = row.at("points").get<int>();
  m.moving = row.at("moving").get<bool>();
  if (row.contains("reflectivity")) m.reflectivity = number(row["reflectivity"], 0, 1);
  return m;
}

}  // namespace

Json measurement_json(const objects::Measurement& m, const objects::ClassTable& table) {
  Json row = {{"time", to_seconds(m.stamp)},
              {"class", table[m.class_id].name},
              {"class_probability", m.class_probability},
              {"model", model_json(m.model)},
              {"points", m.points},
              {"moving", m.moving}};
  if (std::isfinite(m.reflectivity)) row["reflectivity"] = m.reflectivity;
  if (m.front_log_odds != 0) row["front_log_odds"] = m.front_log_odds;
  for (Eigen::Index i = 0; i < m.covariance.rows(); ++i) {
    row["covariance"].push_back(numbers(m.covariance.row(i).transpose()));
  }
  return row;
}

std::vector<objects::Measurement> read_detections(const std::filesystem::path& file,
                                                  const objects::ClassTable& table) {
  std::istringstream stream(core::read_file(file));
  std::vector<objects::Measurement> measurements;
  std::string line;
  while (std::getline(stream, line)) {
    const auto fail = [&](const char* why) {
      throw Error(fmt::format("{}:{}: {}, expected a measurement as saker replay writes it",
                              file.string(), measurements.size() + 1, why));
    };
    try {
      measurements.push_back(read_measurement(Json::parse(line), table));
    } catch (const Json::exception& error) {
      fail(error.what());
    } catch (const Error& error) {
      fail(error.what());
    }
  }
  return measurements;
}

DetectionsWriter::DetectionsWriter(const std::filesystem::path& out,
                                   const objects::ClassTable& table)
    : file_(out / "detections.jsonl"), table_(table), part_(out / "detections.jsonl.part") {
  if (!part_) throw Error(fmt::format("cannot write {}", file_.string()));
}

void DetectionsWriter::add(const objects::Detections& detections) {
  for (const objects::Measurement& m : detections.measurements) {
    part_ << measurement_json(m, table_).dump() << '\n';
  }
}

void DetectionsWriter::finish() {
  part_.close();
  if (!part_) throw Error(fmt::format("cannot write {}", file_.string()));
  std::filesystem::rename(file_.string() + ".part", file_);
}

}  // namespace saker::flight
