#include "saker/autonomy/battery_watch.h"

#include <algorithm>

namespace saker::autonomy {

void BatteryWatch::update(Time now, double said_share, bool flying) {
  if (!flying) {
    count_ = 0;
    flying_since_ = 0;
    known_ = {};
  } else if (flying_since_ == 0) {
    flying_since_ = now;
  }
  if (!is_known(said_share)) return;
  known_ = {now, said_share};
  if (flying) keep(known_);
}

void BatteryWatch::keep(const Sample& sample) {
  const bool first = count_ == 0;
  if (!first && to_seconds(sample.stamp - samples_[(count_ - 1) % kSamples].stamp) < kEvery_s) {
    return;
  }
  samples_[count_ % kSamples] = sample;
  ++count_;
}

double BatteryWatch::drain_per_s() const {
  double fell = 0, over_s = 0;
  if (count_ > 0) {
    const Sample& oldest = samples_[count_ <= kSamples ? 0 : count_ % kSamples];
    fell = std::max(0.0, oldest.share - known_.share);
    over_s = to_seconds(known_.stamp - oldest.stamp);
  }
  const double measured = (kNominal_s * nominal_per_s_ + fell) / (kNominal_s + over_s);
  return std::min(measured, kMostTimes * nominal_per_s_);
}

double BatteryWatch::share(Time now) const {
  if (!is_known(known_.share)) return NAN;
  return std::max(0.0, known_.share - drain_per_s() * to_seconds(now - known_.stamp));
}

double BatteryWatch::unknown_s(Time now) const {
  if (flying_since_ == 0) return 0;
  return to_seconds(now - std::max(known_.stamp, flying_since_));
}

}  // namespace saker::autonomy
