#include "active/looks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::active {

void Looks::add(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
                double flown_m) {
  if (!(seconds > 0)) return;
  const Eigen::Vector2d way = (eye - target).head<2>();
  const double turn = std::atan2(way.y(), way.x()) / (2 * std::numbers::pi);
  const int direction = static_cast<int>(std::lround((turn + 1) * bearings_)) % bearings_;
  const int bin = static_cast<int>(way.norm() / range_step_m_) * bearings_ + direction;
  auto look = std::find_if(looks_.begin(), looks_.end(), [&](auto& l) { return l.bin == bin; });
  if (looks_.empty()) first_m_ = flown_m;
  if (look == looks_.end()) look = looks_.insert(look, {eye, 0, flown_m, bin});
  look->seconds += seconds;
  const double share = seconds / look->seconds;
  look->eye += share * (eye - look->eye);
  look->flown_m += share * (flown_m - look->flown_m);
}

}  // namespace saker::active
