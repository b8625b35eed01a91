#include "saker/simulation/mission/takeoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "saker/core/error.h"
#include "saker/simulation/mission/truth.h"
#include "saker/simulation/vehicle/collision.h"

namespace saker::simulation {
namespace {

constexpr double kRoom = 2.0;    ///< m around the take-off column to anything
constexpr double kHeight = 8.0;  ///< m of it
constexpr int kTries = 200;
constexpr double kStep = 0.5;   ///< m between the places that are tried
constexpr double kReach = 100;  ///< m up and down, where the ground is looked for
constexpr double kTurn = 2 * std::numbers::pi;

/// What stands about at a site.
class Room {
 public:
  explicit Room(const MissionSite& site)
      : caster_(site.flight.built.world),
        ground_(ground_materials(site.flight.built.world)),
        // What stands under a ceiling stands on the floor: the ceiling itself is nearer than that.
        height_(std::min(kHeight, site.ceiling_m - kRoom)) {}

  [[nodiscard]] bool is_free_over(const Eigen::Vector3d& foot) const {
    for (double z = 0; z <= height_; z += kRoom / 2) {
      const Eigen::Vector3f p = (foot + Eigen::Vector3d(0, 0, z)).cast<float>();
      if (caster_.nearest(p, static_cast<float>(kRoom), ground_)) return false;
    }
    return true;
  }

  /// What is uppermost under `from`; nothing where there is nothing.
  [[nodiscard]] std::optional<Eigen::Vector3d> below(const Eigen::Vector3d& from) const {
    Shot shot;
    shot.origin = from.cast<float>();
    shot.direction = -Eigen::Vector3f::UnitZ();
    caster_.cast({&shot, 1}, static_cast<float>(kReach));
    if (!shot.hit) return std::nullopt;
    return from - Eigen::Vector3d(0, 0, shot.distance);
  }

  [[nodiscard]] double height() const { return height_; }

 private:
  RayCaster caster_;
  std::vector<bool> ground_;
  double height_;
};

/// Points about the origin, the nearest first.
std::vector<Eigen::Vector2d> rings(double within_m) {
  std::vector<Eigen::Vector2d> points = {Eigen::Vector2d::Zero()};
  for (double radius = kStep; radius <= within_m; radius += kStep) {
    const int count = static_cast<int>(std::ceil(kTurn * radius / kStep));
    for (int i = 0; i < count; ++i) {
      const double angle = kTurn * i / count;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  return points;
}

}  // namespace

SE3 find_takeoff(const MissionSite& site, const AirframeConfig& airframe, core::Rng& rng) {
  const Terrain& terrain = site.flight.built.terrain;
  const Room room(site);
  const double reach = 0.5 * (terrain.shape().half_length - kBeyondSite);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const double s = rng.uniform(-reach, reach);
    const double d = site.aisle_d + rng.uniform(-1, 1);
    SE3 T = terrain.upright(s, d, rng.uniform(-std::numbers::pi, std::numbers::pi));
    if (!room.is_free_over(T.translation())) continue;
    T.translation().z() += airframe.leg_m;
    return levelled(T);
  }
  throw Error("mission.site: no free place to take off");
}

SE3 takeoff_near(const MissionSite& site, const SE3& T_sim_base, const TakeoffPlace& place,
                 const AirframeConfig& airframe) {
  const Room room(site);
  for (const Eigen::Vector2d& off : rings(place.within_m)) {
    const Eigen::Vector3d over(place.x_m + off.x(), place.y_m + off.y(), room.height());
    const auto foot = room.below(T_sim_base * over);
    if (!foot || !room.is_free_over(*foot)) continue;
    SE3 T = T_sim_base;
    T.rotate(Eigen::AngleAxisd(place.yaw_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
    T.translation() = *foot + Eigen::Vector3d(0, 0, airframe.leg_m);
    return T;
  }
  throw Error(fmt::format("take-off at ({:g}, {:g}): no free place within {:g} m", place.x_m,
                          place.y_m, place.within_m));
}

SE3 team_base(const MissionSite& site) {
  return levelled(site.flight.built.terrain.upright(0, site.aisle_d));
}

}  // namespace saker::simulation
