#include "saker/autonomy/standstill.h"

#include <algorithm>

namespace saker::autonomy {

Standstill::Standstill(const StandstillConfig& config)
    : config_(core::checked(config, "standstill")) {}

void Standstill::add(std::span<const lidar::ImuSample> samples) {
  for (const lidar::ImuSample& sample : samples) {
    const bool finite = sample.acceleration.allFinite() && sample.angular_velocity.allFinite();
    if (finite && samples_.size() < kMost) samples_.push_back(sample);
  }
  if (samples_.empty()) return;
  // One sample older than the window stays: it shows that the window is full.
  const Time oldest = samples_.back().stamp - from_seconds(config_.window_s);
  const auto first = std::find_if(samples_.begin(), samples_.end(),
                                  [oldest](const auto& s) { return s.stamp > oldest; });
  if (first - samples_.begin() > 1) samples_.erase(samples_.begin(), first - 1);
}

bool Standstill::reached() const {
  if (samples_.size() < 3) return false;
  const Time covered = samples_.back().stamp - samples_.front().stamp;
  if (covered < from_seconds(config_.window_s)) return false;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), rate = Eigen::Vector3d::Zero();
  for (const lidar::ImuSample& sample : samples_) {
    force += sample.acceleration;
    rate += sample.angular_velocity;
  }
  const double share = 1.0 / static_cast<double>(samples_.size());
  return std::all_of(samples_.begin(), samples_.end(), [&](const lidar::ImuSample& sample) {
    return (sample.acceleration - share * force).norm() < config_.acceleration_mps2 &&
           (sample.angular_velocity - share * rate).norm() < config_.rate_rps;
  });
}

}  // namespace saker::autonomy
