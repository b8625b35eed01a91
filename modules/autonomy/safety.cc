#include "saker/autonomy/safety.h"

#include <algorithm>
#include <cmath>

namespace saker::autonomy {
namespace {

constexpr double kNeverSaidAfter_s = 1e6;  // a stamp of 0 is older than that
constexpr double kContactHolds_s = 1;      // longer than safety is ever late
constexpr double kDescent_mps = 0.5;       // slower than autopilots land
constexpr double kGuidance_s = 0.5;  // 25 runs; setpoints expire before, and the vehicle holds
/// Flight controllers give up after 0.5 s; sooner, a silent lidar would be taken for this.
constexpr double kPose_s = 0.45;

/// "no scan for 0.7 s" or "no scan yet".
core::Text silence_text(const char* what, Time last, Time now, double limit_s) {
  if (last == 0) return core::text("no {} yet", what);
  return core::text("no {} for {:.2f} s, expected one within {:g} s", what, to_seconds(now - last),
                    limit_s);
}

double age_s(Time last, Time now) { return last == 0 ? kNeverSaidAfter_s : to_seconds(now - last); }

}  // namespace

const char* to_string(SafetyAction action) {
  constexpr const char* kNames[] = {"none", "return", "hold", "land", "silence"};
  return kNames[static_cast<int>(action)];
}

Safety::Safety(const SafetyConfig& config, const motion::Geofence& geofence)
    : config_(core::checked(config, "safety")),
      geofence_(geofence),
      battery_(config_.battery_flight_s) {
  found_.reserve(32);  // more than there are
}

void Safety::find_silence(const SafetyInput& in, std::vector<Finding>& found) const {
  const auto listen = [&](Cause cause, const char* what, Time last, double limit_s) {
    if (age_s(last, in.now) <= limit_s) return;
    found.push_back({cause, SafetyAction::hold, silence_text(what, last, in.now, limit_s)});
  };
  listen(Cause::vehicle_silent, "state of the vehicle", in.heard.vehicle, config_.vehicle_s);
  listen(Cause::lidar_silent, "scan", in.heard.lidar, config_.lidar_s);
  listen(Cause::odometry_stale, "registered scan", in.heard.odometry, config_.odometry_s);
  listen(Cause::checker_silent, "verdict", in.heard.verdict, config_.verdict_s);
  listen(Cause::occupancy_stale, "occupancy block", in.heard.occupancy, config_.occupancy_s);
  listen(Cause::mapping_stale, "map", in.heard.mapping, config_.mapping_s);
  if (in.planning_due) {
    listen(Cause::planning_stale, "plan", in.heard.planning, config_.planning_s);
  }
  listen(Cause::guidance_silent, "run of guidance", in.heard.guidance, kGuidance_s);
  listen(Cause::odometry_stale, "pose", in.odometry.stamp, std::min(kPose_s, config_.odometry_s));
}

/// Of the charge: there in a straight line, and down.
double Safety::way_home_share(const SafetyInput& in) const {
  const double down_s = std::abs(in.place.z()) / kDescent_mps;
  return battery_.drain_per_s() * (in.place.head<2>().norm() / config_.way_home_mps + down_s);
}

void Safety::find_battery(const SafetyInput& in, std::vector<Finding>& found) const {
  const double said = in.vehicle.battery_share;
  const bool known = BatteryWatch::is_known(said);
  const double unknown_s = battery_.unknown_s(in.now);
  if (!known && !in.flying) {
    found.push_back({Cause::battery_unknown, SafetyAction::return_home,
                     "the charge of the battery is not known"});
  } else if (!known && unknown_s > config_.battery_unknown_s) {
    found.push_back({Cause::battery_unknown, SafetyAction::return_home,
                     core::text("no charge of the battery for {:.0f} s", unknown_s)});
  }
  const double charge = known ? said : battery_.share(in.now);
  if (!BatteryWatch::is_known(charge)) return;
  const double way_home = way_home_share(in);
  const double reserve = config_.battery_land_share;
  const bool enough = charge > way_home + reserve;  // not where the way is not a number
  const core::Text text = core::text("battery at {:.0f} %", 100 * charge);
  if (charge < reserve) {
    found.push_back({Cause::battery_empty, SafetyAction::land, text});
  } else if (charge <= way_home) {
    found.push_back({Cause::battery_empty, SafetyAction::land,
                     text + core::text(", the way home takes {:.0f} %", 100 * way_home)});
  } else if (charge < config_.battery_return_share) {
    found.push_back({Cause::battery_low, SafetyAction::return_home, text});
  } else if (!enough) {
    found.push_back({Cause::battery_low, SafetyAction::return_home,
                     text + core::text(", the way home takes {:.0f} % and the reserve {:.0f} %",
                                       100 * way_home, 100 * reserve)});
  }
}

/// By the accelerometer in flight, where the flight controller flies: who comes down meets the
/// ground. A flight controller may have felt one, too.
void Safety::find_contact(const SafetyInput& in, std::vector<Finding>& found) const {
  const VehicleMode mode = in.vehicle.mode;
  const bool lands = mode == VehicleMode::land || mode == VehicleMode::descend;
  if ((in.vehicle.faults & kCollision) != 0) {
    found.push_back(
        {Cause::collision, SafetyAction::land, "the flight controller has felt a contact"});
  } else if (in.flying && !lands && age_s(in.contact.stamp, in.now) <= kContactHolds_s) {
    found.push_back({Cause::collision, SafetyAction::land,
                     core::text("felt a contact, {:.0f} m/s²", in.contact.force_mps2)});
  }
}

void Safety::find_vehicle(const SafetyInput& in, std::vector<Finding>& found) const {
  find_battery(in, found);
  find_contact(in, found);
  if (in.vehicle.mode == VehicleMode::descend) {
    const bool rejected = (in.vehicle.faults & kOdometryRejected) != 0;
    found.push_back({Cause::vehicle_descends, SafetyAction::land,
                     rejected ? "the flight controller rejects the odometry"
                              : "the flight controller has no odometry"});
  }
}

void Safety::find_place(const SafetyInput& in, std::vector<Finding>& found) const {
  const VehicleOdometry& odometry = in.odometry;
  const double lost_s = config_.odometry_lost_s;
  const bool known =
      odometry.status != VehicleOdometryStatus::lost && age_s(odometry.stamp, in.now) <= lost_s;
  // BodyPose says lost when its covariance grows; one that is not a number says nothing.
  const bool coasts =
      odometry.status == VehicleOdometryStatus::predicted && odometry.covariance.allFinite();
  if (!known || (age_s(in.heard.odometry, in.now) > lost_s && !coasts)) {
    found.push_back(
        {Cause::odometry_lost, SafetyAction::silence,
         silence_text("registered scan", in.heard.odometry, in.now, config_.odometry_lost_s)});
    return;
  }
  if (!geofence_.contains(in.place)) {
    found.push_back({Cause::outside_geofence, SafetyAction::hold,
                     core::text("({:.1f}, {:.1f}, {:.1f}) is outside the geofence", in.place.x(),
                                in.place.y(), in.place.z())});
  }
  if (in.flying && in.setpoint) {
    const double off = (in.setpoint->position - in.odometry.T_odom_body.translation()).norm();
    if (!(off <= config_.off_course_m)) {
      found.push_back(
          {Cause::off_course, SafetyAction::hold, core::text("{:.1f} m off the setpoint", off)});
    }
  }
}

void Safety::find(const SafetyInput& input, std::vector<Finding>& found) const {
  find_silence(input, found);
  find_vehicle(input, found);
  find_place(input, found);
}

std::vector<Finding> Safety::findings(const SafetyInput& input) const {
  std::vector<Finding> found;
  find(input, found);
  return found;
}

SafetyDecision Safety::worst(std::span<const Finding> findings) {
  SafetyDecision decision;
  for (const Finding& finding : findings) {
    if (finding.action <= decision.action) continue;
    decision = {finding.action, finding.cause, finding.text};
  }
  return decision;
}

SafetyDecision Safety::update(const SafetyInput& input) {
  battery_.update(input.now, input.vehicle.battery_share, input.flying);
  if (!input.flying) {
    held_for_ = {};
    return {};
  }
  found_.clear();
  find(input, found_);
  const SafetyDecision now = worst(found_);
  if (now.action == SafetyAction::hold) {
    if (held_for_.action == SafetyAction::none) held_since_ = input.now;
    held_for_ = now;
    last_cause_ = input.now;
  }
  if (now.action > SafetyAction::hold || held_for_.action == SafetyAction::none) return now;
  if (now.action != SafetyAction::hold &&
      input.now - last_cause_ >= from_seconds(config_.recover_s)) {
    held_for_ = {};
    return now;
  }
  if (input.now - held_since_ < from_seconds(config_.land_after_s)) return held_for_;
  return {SafetyAction::land, held_for_.cause,
          core::text("{}; held for {:g} s", held_for_.text, config_.land_after_s)};
}

}  // namespace saker::autonomy
