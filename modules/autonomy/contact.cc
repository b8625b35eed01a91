#include "saker/autonomy/contact.h"

#include <algorithm>

namespace saker::autonomy {

Contact::Contact(const ContactConfig& config) : config_(core::checked(config, "contact")) {}

bool Contact::add(const lidar::ImuSample& sample) {
  if (!sample.acceleration.allFinite() || sample.stamp <= stamp_) return false;
  const double dt = to_seconds(sample.stamp - stamp_);
  const bool first = stamp_ == 0 || dt > config_.mean_s;  // after a gap the mean is of another time
  stamp_ = sample.stamp;
  if (first) {
    mean_ = sample.acceleration;
    return false;
  }
  const double off = (sample.acceleration - mean_).norm();
  const bool bump = off > std::max(config_.least_mps2, config_.margin * usual_mps2());
  most_mps2_ = std::max(most_mps2_, off);
  mean_ += std::min(1.0, dt / config_.mean_s) * (sample.acceleration - mean_);
  if (bump) {
    last_ = sample.stamp;
    last_mps2_ = off;
  } else {  // what is no bump is usual
    square_ += std::min(1.0, dt / config_.usual_s) * (off * off - square_);
  }
  return bump;
}

}  // namespace saker::autonomy
