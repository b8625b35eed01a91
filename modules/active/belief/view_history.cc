#include "saker/active/belief/view_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::active {
namespace {

constexpr std::size_t kMostAwaited = 30;  // a map that is later than so many decisions has stopped

}  // namespace

void ViewHistory::add(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
                      double flown_m) {
  if (!(seconds > 0)) return;
  const Eigen::Vector2d way = (eye - target).head<2>();
  const double turn = std::atan2(way.y(), way.x()) / (2 * std::numbers::pi);
  const int direction = static_cast<int>(std::lround((turn + 1) * bearings_)) % bearings_;
  const int bin = static_cast<int>(way.norm() / range_step_m_) * bearings_ + direction;
  auto dwell = std::find_if(dwells_.begin(), dwells_.end(), [&](auto& l) { return l.bin == bin; });
  if (dwells_.empty()) first_m_ = flown_m;
  if (dwell == dwells_.end()) dwell = dwells_.insert(dwell, {eye, 0, flown_m, bin});
  dwell->seconds += seconds;
  const double share = seconds / dwell->seconds;
  dwell->eye += share * (eye - dwell->eye);
  dwell->flown_m += share * (flown_m - dwell->flown_m);
}

double ViewHistory::seconds_near(const Eigen::Vector3d& eye, double near_m) const {
  double seconds = 0;
  for (const Dwell& dwell : dwells_) {
    if ((dwell.eye - eye).norm() < near_m) seconds += dwell.seconds;
  }
  return seconds;
}

void MappedViewHistory::add(Time until, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                            double seconds, double flown_m) {
  so_far_.add(eye, target, seconds, flown_m);
  if (awaited_.size() >= kMostAwaited) map_holds(awaited_.front().until);
  awaited_.push_back({until, eye, target, seconds, flown_m});
}

void MappedViewHistory::map_holds(Time stamp) {
  const auto late = std::ranges::find_if(awaited_, [&](auto& a) { return a.until > stamp; });
  for (auto a = awaited_.begin(); a != late; ++a) {
    in_map_.add(a->eye, a->target, a->seconds, a->flown_m);
  }
  awaited_.erase(awaited_.begin(), late);
}

}  // namespace saker::active
