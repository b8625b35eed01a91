#include "tools/saker/evaluate/box_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace saker::tools {
namespace {

using Kind = std::pair<std::string_view, std::string_view>;

constexpr std::array<std::string_view, 10> kNoVehicle = {"motor",   "bicycl", "pedestr", "person",
                                                         "rider",   "cone",   "sign",    "barrier",
                                                         "cyclist", "scooter"};
constexpr std::array<Kind, 13> kNames = {{{"car", "car"},
                                          {"pickup", "car"},
                                          {"van", "van"},
                                          {"suv", "car"},
                                          {"regular_vehicle", "car"},
                                          {"truck", "truck"},
                                          {"bus", "bus"},
                                          {"semi", "truck"},
                                          {"trailer", "truck"},
                                          {"construction", "other"},
                                          {"vehicle", "other"},
                                          {"towed", "other"},
                                          {"large_vehicle", "truck"}}};
/// In the order in which they are looked for in a longer name.
constexpr std::array<Kind, 9> kWords = {{{"bus", "bus"},
                                         {"semi", "truck"},
                                         {"truck", "truck"},
                                         {"trailer", "truck"},
                                         {"pickup", "car"},
                                         {"van", "van"},
                                         {"suv", "car"},
                                         {"car", "car"},
                                         {"vehicle", "other"}}};

std::string plain(std::string name) {
  for (char& c : name) {
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// In single precision, as the points are: a point at the limit is the same one everywhere.
bool in_view(const Eigen::Vector3f& p, float range_m, std::optional<float> half_angle_deg) {
  if (!(std::hypot(p.x(), p.y()) < range_m)) return false;
  if (!half_angle_deg) return true;
  constexpr float kDegrees = 180 / std::numbers::pi_v<float>;
  return std::abs(std::atan2(p.y(), p.x()) * kDegrees) < *half_angle_deg;
}

}  // namespace

bool LabelledBox::holds(const Eigen::Vector3d& p, double margin_m) const {
  const Eigen::Vector3d d = p - position;
  const double c = std::cos(yaw), s = std::sin(yaw);
  const Eigen::Vector3d half = size / 2 + Eigen::Vector3d::Constant(margin_m);
  return std::abs(d.x() * c + d.y() * s) < half.x() &&
         std::abs(-d.x() * s + d.y() * c) < half.y() && std::abs(d.z()) < half.z();
}

std::optional<std::string> vehicle_kind(const std::string& class_name) {
  const std::string name = plain(class_name);
  const auto has = [&name](std::string_view word) { return name.find(word) != std::string::npos; };
  if (std::ranges::any_of(kNoVehicle, [&](auto word) { return has(word); })) {
    return std::nullopt;
  }
  for (const auto& [whole, kind] : kNames) {
    if (name == whole) return std::string(kind);
  }
  if (name.starts_with("towed")) return "other";
  if (has("vehicle") && (has("construction") || has("other"))) return "other";
  for (const auto& [word, kind] : kWords) {
    if (has(word)) return std::string(word == "truck" && has("pickup") ? "car" : kind);
  }
  return std::nullopt;
}

double BoxFigures::OfKind::recall() const {
  return boxes > 0 ? static_cast<double>(recognised) / boxes : NAN;
}

double BoxFigures::OfKind::mean_share() const { return boxes > 0 ? sum_of_shares / boxes : NAN; }

int BoxFigures::OfKind::recognised_vehicles() const {
  return static_cast<int>(std::ranges::count_if(
      vehicles, [](const auto& v) { return 2 * v.second[1] >= v.second[0]; }));
}

double BoxFigures::point_precision() const {
  return called_ > 0 ? static_cast<double>(right_) / static_cast<double>(called_) : NAN;
}

BoxJudgement BoxFigures::add(const std::vector<Eigen::Vector3f>& points,
                             const std::vector<bool>& called, const std::vector<LabelledBox>& boxes,
                             std::optional<float> half_angle_deg) {
  const std::vector<bool> none(points.size(), false);
  BoxJudgement result{{}, none, none, none};
  const auto range_m = static_cast<float>(rules_.range_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.judged[i] = in_view(points[i], range_m, half_angle_deg);
  }
  for (const LabelledBox& box : boxes) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = points[i].cast<double>();
      if (!box.holds(p, rules_.margin_m)) continue;
      result.in_box[i] = true;
      if (result.judged[i] && box.holds(p, rules_.own_margin_m)) own.push_back(i);
    }
    result.boxes.push_back(BoxJudgement::Of::uncounted);
    if (static_cast<int>(own.size()) < rules_.least_points) continue;
    for (const std::size_t i : own) result.in_counted[i] = true;
    const auto hit = std::ranges::count_if(own, [&](std::size_t i) { return called[i]; });
    const double share = static_cast<double>(hit) / static_cast<double>(own.size());
    const bool recognised = share >= rules_.least_share;
    OfKind& kind = kinds_[box.kind];
    kind.boxes += 1;
    kind.recognised += recognised;
    kind.sum_of_shares += share;
    const std::string key = box.vehicle.empty() ? "box " + std::to_string(kind.boxes) : box.vehicle;
    kind.vehicles.try_emplace(key, Eigen::Vector2i::Zero()).first->second +=
        Eigen::Vector2i(1, recognised);
    result.boxes.back() = recognised ? BoxJudgement::Of::recognised : BoxJudgement::Of::missed;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!called[i] || !result.judged[i]) continue;
    ++called_;
    right_ += result.in_box[i];
  }
  return result;
}

}  // namespace saker::tools
