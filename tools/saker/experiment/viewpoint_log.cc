#include "tools/saker/experiment/viewpoint_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/comparison.h"

namespace saker::tools {
namespace {

constexpr const char* kHeader =
    "t_s,target,viewpoint,predicted_length_sd_m,predicted_width_sd_m,mapped_length_m,"
    "mapped_width_m,true_length_m,true_width_m\n";
constexpr std::size_t kMostRows = 10'000;  // a mission has some tens
constexpr int kColumns = 9;

const objects::Cuboid* cuboid_of(const objects::ObjectMap& map, int id) {
  const auto found = std::ranges::find(map.objects, id, &objects::MapObject::id);
  return found == map.objects.end() ? nullptr : std::get_if<objects::Cuboid>(&found->model);
}

double apart(const objects::Cuboid& a, const objects::Cuboid& b) {
  return (a.pose.translation() - b.pose.translation()).head<2>().norm();
}

const objects::Cuboid* nearest(const objects::ObjectMap& map, const objects::Cuboid& to) {
  const objects::Cuboid* best = nullptr;
  for (const objects::MapObject& object : map.objects) {
    const auto* cuboid = std::get_if<objects::Cuboid>(&object.model);
    if (cuboid == nullptr || apart(*cuboid, to) > objects::ComparisonOptions{}.cuboid_gate_m)
      continue;
    if (best == nullptr || apart(*cuboid, to) < apart(*best, to)) best = cuboid;
  }
  return best;
}

/// The numbers of a line; none where it has not as many as there are columns.
std::optional<std::vector<double>> numbers_of(const std::string& line) {
  std::vector<double> values;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    char* end = nullptr;
    values.push_back(std::strtod(cell.c_str(), &end));
    if (cell.empty() || *end != '\0') return std::nullopt;
  }
  if (values.size() != kColumns) return std::nullopt;
  return values;
}

}  // namespace

void ViewpointLog::add(Time stamp, int target_id, int viewpoint_id,
                       const Eigen::Vector2d& predicted_sd) {
  if (rows_.size() >= kMostRows) return;
  rows_.push_back({.stamp = stamp,
                   .target_id = target_id,
                   .viewpoint_id = viewpoint_id,
                   .predicted_sd = predicted_sd});
}

void ViewpointLog::take(Time stamp, const objects::ObjectMap& map,
                        const objects::ObjectMap& truth) {
  for (; taken_ < rows_.size() && rows_[taken_].stamp <= stamp; ++taken_) {
    Row& row = rows_[taken_];
    const objects::Cuboid* real = cuboid_of(truth, row.target_id);
    if (real == nullptr) continue;
    row.real = real->size.head<2>();
    if (const objects::Cuboid* mapped = nearest(map, *real)) row.mapped = mapped->size.head<2>();
  }
}

std::string ViewpointLog::csv() const {
  std::string text = kHeader;
  for (const Row& r : rows_) {
    text += fmt::format("{:.3f},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n",
                        to_seconds(r.stamp), r.target_id, r.viewpoint_id, r.predicted_sd.x(),
                        r.predicted_sd.y(), r.mapped.x(), r.mapped.y(), r.real.x(), r.real.y());
  }
  return text;
}

std::vector<Outcome> read_outcomes(const std::filesystem::path& file) {
  std::istringstream lines(core::read_file(file));
  std::string line;
  std::vector<Outcome> outcomes;
  std::getline(lines, line);
  if (line + "\n" != kHeader) throw Error(file.string() + ": line 1: not the header of viewpoints");
  for (int number = 2; std::getline(lines, line); ++number) {
    const auto values = numbers_of(line);
    if (!values) {
      throw Error(fmt::format("{}: line {}: expected {} numbers", file.string(), number, kColumns));
    }
    const std::vector<double>& v = *values;
    outcomes.push_back({v[3], v[5] - v[7]});
    outcomes.push_back({v[4], v[6] - v[8]});
  }
  return outcomes;
}

}  // namespace saker::tools
