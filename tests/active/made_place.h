#pragma once

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "made_fence.h"
#include "made_flight.h"
#include "made_street.h"
#include "saker/active/active.h"

/// A place in which the whole stage flies.
namespace saker::active::made {

constexpr int kLong = 2000;  // decisions, in which every flight must have ended

/// A place with cars, some of which the prior map knows. One that is in range for three seconds
/// gets mapped; the occupancy block knows all.
struct PlaceFlight {
  PlaceFlight(const std::vector<objects::Cuboid>& there, const objects::ObjectMap& prior,
              ActiveConfig config = two_sided(), const motion::Geofence& fence = box_fence(50, 40))
      : cars(there), seen_s(there.size(), 0), active(config, {}, prior, fence) {
    input.grid = block_of(there);
  }

  void look() {
    objects::ObjectMap map;
    for (std::size_t i = 0; i < cars.size(); ++i) {
      const double away = (cars[i].pose.translation() - body).head<2>().norm();
      if (away < 15) seen_s[i] += 1;
      if (seen_s[i] >= 3) map.objects.push_back(vehicle(100 + static_cast<int>(i), cars[i]));
    }
    input.map = std::make_shared<const objects::ObjectMap>(std::move(map));
  }

  const ActivePlan& decide() {
    input.stamp += kNanosecondsPerSecond;
    input.T_world_body.translation() = body;
    plan = active.plan(input, kBudget);
    return plan;
  }

  int fly(int most = kLong) {
    for (int step = 0; step < most; ++step) {
      look();
      if (decide().status == ActiveStatus::finished) return step;
      const Eigen::Vector3d way = plan.goal->position - body;
      body += way * std::min(1.0, speed / std::max(way.norm(), 1e-9));
      stops += plan.goal->target_id < 0;
    }
    return most;
  }

  [[nodiscard]] const Target& target(int index) const {
    return active.targets()[static_cast<std::size_t>(index)];
  }
  /// Cars that are some target's object, and were looked at.
  [[nodiscard]] int done() const {
    return static_cast<int>(
        std::ranges::count(active.targets(), TargetStatus::done, &Target::status));
  }

  [[nodiscard]] std::string story() const {
    std::ostringstream text;
    for (const Target& it : active.targets()) {
      text << ' ' << it.id << ' ' << to_string(it.status) << " (" << it.reason << ')';
    }
    return text.str();
  }

  std::vector<objects::Cuboid> cars;
  std::vector<double> seen_s;
  Active active;
  ActiveInput input;
  ActivePlan plan;
  Eigen::Vector3d body = {0, 0, 3};
  double speed = 2;
  int stops = 0;  ///< decisions that flew to a stop of the sweep
};

const std::vector<objects::Cuboid> kPark = {car(20, 5), car(20, 11), car(-15, -12), car(-30, 20),
                                            car(38, -25)};

inline objects::ObjectMap map_given(const objects::ObjectMap& map, PlaceFlight& flight,
                                    int decisions) {
  flight.input.map = std::make_shared<const objects::ObjectMap>(map);
  for (int i = 0; i < decisions; ++i) flight.decide();
  return map;
}

}  // namespace saker::active::made
