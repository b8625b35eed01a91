#include "flight/viewers/robot_state.h"

#include <cmath>

#include "flight/bus/object_messages.h"
#include "saker/active/views/viewpoint.h"

namespace saker::flight::viewers {
namespace {

Eigen::Matrix2d planar_axes(const objects::Model& model) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model))
    return cuboid->pose.linear().topLeftCorner<2, 2>();
  return Eigen::Matrix2d::Identity();  // a root's deviations are those of the map's frame
}

}  // namespace

core::Colour colour_of(const objects::ObjectClass& object_class) {
  if (object_class.shape == objects::Shape::cuboid) return core::colours::kBlue;
  return object_class.name == "pole" ? core::colours::kOrange : core::colours::kGreen;
}

core::Colour colour_of_robot(std::size_t robot) {
  using namespace core::colours;
  constexpr core::Colour kRobots[] = {kPurple, kOrange, kSky, kYellow, kGreen, kInk};
  return kRobots[robot % std::size(kRobots)];
}

Eigen::Vector3d ShownObject::place_covariance() const {
  const Eigen::Matrix2d axes = planar_axes(object.model);
  const Eigen::Matrix2d covariance = axes * position_sd.cwiseAbs2().asDiagonal() * axes.transpose();
  return {covariance(0, 0), covariance(0, 1), covariance(1, 1)};
}

std::optional<ShownObject> shown(const map_object_t& message, int classes, double t) {
  auto object = from_lcm(message, classes);
  if (!object) return std::nullopt;
  return ShownObject{
      .object = std::move(*object),
      .position_sd = Eigen::Map<const Eigen::Vector2f>(message.position_sd).cast<double>(),
      .size_sd = Eigen::Map<const Eigen::Vector2f>(message.size_sd).cast<double>(),
      .t = t};
}

ShownObject shown(const objects::MapObject& object, double t) {
  const map_object_t message = to_lcm(object);  // which says the deviations, and which they are
  return ShownObject{
      .object = object,
      .position_sd = Eigen::Map<const Eigen::Vector2f>(message.position_sd).cast<double>(),
      .size_sd = Eigen::Map<const Eigen::Vector2f>(message.size_sd).cast<double>(),
      .t = t};
}

void FlownPath::add(const Eigen::Vector3d& p, double t) {
  if (!p.allFinite()) return;
  const double step = points_.empty() ? 0 : (p - last_).norm();
  if (!points_.empty() && step < spacing_m_) return;
  length_m_ += step;
  last_ = p;
  points_.push_back(p);
  times_.push_back(t);
  if (points_.size() < kMost) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) {
    points_[i] = points_[2 * i];
    times_[i] = times_[2 * i];
  }
  points_.resize(points_.size() / 2);
  times_.resize(points_.size());
  spacing_m_ *= 2;
}

std::map<int, int> targets_by_object(const RobotState& state, const Site& site) {
  constexpr double kGate_m = 3;  // a prior is some metres off, parked cars are as far apart
  std::map<int, int> found;
  for (const objects::MapObject& target : site.prior.objects) {
    const Eigen::Vector2d place = objects::place(target.model).head<2>();
    int nearest = -1;
    double least = kGate_m;
    for (const auto& [id, shown] : state.objects) {
      if (shown.object.class_id != target.class_id) continue;
      const double distance = (objects::place(shown.object.model).head<2>() - place).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = id;
    }
    if (nearest >= 0) found.emplace(nearest, target.id);
  }
  return found;
}

std::string refusal_words(const candidate_t& candidate) {
  constexpr float kLast = static_cast<float>(active::Refusal::region);
  if (!(candidate.gain < 0)) return "";
  if (candidate.gain < -kLast) return "refused";  // for a reason that a newer robot has
  return to_string(static_cast<active::Refusal>(std::lround(-candidate.gain)));
}

}  // namespace saker::flight::viewers
