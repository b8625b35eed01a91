#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/time.h"

/// What the way home takes of the battery, 50 Hz — reads the charge that the vehicle says and the
/// place of the body (`odom`), makes the charge that is believed, the flight's use and what home
/// and landing take (for safety).
///
/// Use, share of the charge a second: the larger of two. (1) Since take-off, with a prior that
/// counts like `prior_s` of flight: (prior_s / endurance_s + used) / (prior_s + flown). (2) Over
/// the last minute: wind and load change. A hovering rotor's power hardly depends on its speed over
/// ground, so that a second counts, not a metre. Way: back along the places flown, where the space
/// was free, with short cuts where the flight came by its own trail. Unknown (NaN, below 0, above
/// 1): the last charge known, less the use since. A gauge that stands still is not believed: the
/// charge falls at least by `least_use` of the prior. Cost: microseconds; allocates nothing after
/// the first step.
namespace saker::autonomy {

struct BatteryReserveConfig {
  double endurance_s = 900;
  double prior_s = 120;
  double least_use = 0.25;
  double margin = 1.3;
  double home_speed_mps = 1.0;
  double landing_speed_mps = 0.6;
  double touchdown_s = 5;
  double unknown_s = 5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("endurance_s", endurance_s, {60, 86400}, "s",
              "A full battery hovers for so long by its data sheet: the first guess of what the "
              "way home takes, until the flight's own use is known.");
    v.field("prior_s", prior_s, {1, 3600}, "s", "of flight that this guess counts like");
    v.field("least_use", least_use, {0, 1}, "", "of the guess: nothing hovers on less");
    v.field("margin", margin, {1, 5}, "", "on what the way home takes: wind, detours");
    v.field("home_speed_mps", home_speed_mps, {0.1, 20}, "m/s",
            "of the way home, with planning, braking, turning");
    v.field("landing_speed_mps", landing_speed_mps, {0.1, 5}, "m/s", "downwards");
    v.field("touchdown_s", touchdown_s, {0, 60}, "s", "from the ground to standing still");
    v.field("unknown_s", unknown_s, {0, 60}, "s",
            "in flight, of an unknown charge until it returns: five messages of 1 Hz");
  }
};

class BatteryReserve {
 public:
  explicit BatteryReserve(const BatteryReserveConfig& config);  ///< throws Error

  /// At every step, in the order of time; on the ground it forgets the flight.
  /// \param share 0 … 1; all else is unknown
  /// \param place of the body, `odom`, m; one that is not finite is left out
  void update(Time now, double share, const Eigen::Vector3d& place, bool flying);

  /// What is believed to be left now, 0 … 1; NaN: was never known.
  [[nodiscard]] double left() const { return left_; }
  /// s for which the charge has been unknown; inf: always.
  [[nodiscard]] double unknown_s() const { return unknown_s_; }
  [[nodiscard]] double use_per_s() const;  ///< share of the full charge a second
  [[nodiscard]] double way_home_m() const { return way_home_m_; }
  /// Share of the charge that the way home and the landing there take, with the margin.
  [[nodiscard]] double home_share() const;
  /// The same of a landing where it is.
  [[nodiscard]] double landing_share() const;
  [[nodiscard]] const BatteryReserveConfig& config() const { return config_; }

  [[nodiscard]] static bool known(double share) { return share >= 0 && share <= 1; }

 private:
  struct Crumb {
    Eigen::Vector3d place;
    double way_m;  // from here to the first one, along crumbs
  };
  struct Sample {
    Time stamp = 0;
    double left = NAN;
  };

  void begin(Time now, double share, const Eigen::Vector3d& place);
  void believe(Time now, double share);
  void remember(Time now);
  void walk(const Eigen::Vector3d& place);
  [[nodiscard]] double landing_s() const;

  static constexpr int kSamples = 13;  // 5 s apart: a minute

  BatteryReserveConfig config_;
  bool flying_ = false;
  Time begun_ = 0;
  Time known_at_ = 0;  // 0: never
  double flown_s_ = 0;
  double begin_share_ = NAN;  // at take-off
  double known_ = NAN;        // the last one believed
  double left_ = NAN;
  double unknown_s_ = INFINITY;
  std::array<Sample, kSamples> samples_{};
  int newest_ = 0;
  std::vector<Crumb> crumbs_;
  double way_home_m_ = 0;
  double height_m_ = 0;  // over the take-off
};

}  // namespace saker::autonomy
