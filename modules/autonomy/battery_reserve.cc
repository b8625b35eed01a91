#include "saker/autonomy/battery_reserve.h"

#include <algorithm>

namespace saker::autonomy {
namespace {

constexpr double kCrumb_m = 2;             // between two places that are kept
constexpr double kLink_m = 4;              // two trails that are nearer have free space between
constexpr std::size_t kMostCrumbs = 8192;  // 16 km; then the way grows by straight lines
constexpr double kSample_s = 5;

}  // namespace

BatteryReserve::BatteryReserve(const BatteryReserveConfig& config)
    : config_(core::checked(config, "safety.battery")) {
  crumbs_.reserve(kMostCrumbs);
}

void BatteryReserve::begin(Time now, double share, const Eigen::Vector3d& place) {
  flying_ = true;
  begun_ = now;
  begin_share_ = known(share) ? share : known_;
  samples_.fill({});
  crumbs_.clear();
  if (place.allFinite()) crumbs_.push_back({place, 0});
}

void BatteryReserve::update(Time now, double share, const Eigen::Vector3d& place, bool flying) {
  if (!flying) {
    flying_ = false;
    flown_s_ = way_home_m_ = height_m_ = 0;
    samples_.fill({});
  } else if (!flying_) {
    begin(now, share, place);
  }
  if (flying) flown_s_ = to_seconds(now - begun_);
  believe(now, share);
  if (!flying) return;
  remember(now);
  if (place.allFinite()) walk(place);
}

void BatteryReserve::believe(Time now, double share) {
  if (known(share)) {
    const double least = config_.least_use / config_.endurance_s * flown_s_;
    const double most = std::isnan(begin_share_) || !flying_ ? 1 : begin_share_ - least;
    known_ = left_ = std::max(0.0, std::min(share, most));
    known_at_ = now;
    unknown_s_ = 0;
    return;
  }
  if (known_at_ == 0) return;
  unknown_s_ = to_seconds(now - known_at_);
  left_ = std::max(0.0, known_ - use_per_s() * (flying_ ? unknown_s_ : 0));
}

void BatteryReserve::remember(Time now) {
  const Sample& last = samples_[newest_];
  if (unknown_s_ > 0 || (last.stamp != 0 && to_seconds(now - last.stamp) < kSample_s)) return;
  newest_ = (newest_ + 1) % kSamples;
  samples_[newest_] = {now, left_};
}

double BatteryReserve::use_per_s() const {
  const double prior = 1 / config_.endurance_s;
  if (!flying_ || std::isnan(begin_share_) || std::isnan(known_)) return prior;
  const double flown = flown_s_ - unknown_s_;  // up to where the charge was known
  const double whole =
      (prior * config_.prior_s + begin_share_ - known_) / (config_.prior_s + flown);
  const Sample& from = samples_[(newest_ + 1) % kSamples];  // the oldest
  const Sample& to = samples_[newest_];
  const double recent =
      from.stamp == 0 ? 0 : (from.left - to.left) / to_seconds(to.stamp - from.stamp);
  return std::max({whole, recent, config_.least_use * prior});
}

void BatteryReserve::walk(const Eigen::Vector3d& place) {
  if (crumbs_.empty()) crumbs_.push_back({place, 0});
  height_m_ = place.z() - crumbs_.front().place.z();
  const Crumb& last = crumbs_.back();
  way_home_m_ = last.way_m + (place - last.place).norm();
  if ((place - last.place).norm() < kCrumb_m || crumbs_.size() == kMostCrumbs) return;
  for (const Crumb& crumb : crumbs_) {
    const double away = (place - crumb.place).norm();
    if (away <= kLink_m) way_home_m_ = std::min(way_home_m_, crumb.way_m + away);
  }
  crumbs_.push_back({place, way_home_m_});
}

double BatteryReserve::landing_s() const {
  return std::max(height_m_, 0.0) / config_.landing_speed_mps + config_.touchdown_s;
}

double BatteryReserve::home_share() const {
  return config_.margin * use_per_s() * (way_home_m_ / config_.home_speed_mps + landing_s());
}

double BatteryReserve::landing_share() const { return config_.margin * use_per_s() * landing_s(); }

}  // namespace saker::autonomy
