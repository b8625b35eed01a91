#include "saker/simulation/mission/prior_errors.h"

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"

namespace saker::simulation {
namespace {

constexpr double kAway = 8.0;  ///< m from an invented vehicle to any true one: no gate bridges it
constexpr int kPlaceTries = 1000;

using objects::MapObject;

/// To be written to.
auto place_of(MapObject& entry) {
  return std::get<objects::Cuboid>(entry.model).pose.translation();
}

void blur(MapObject& entry, double sd, core::Rng& rng) {
  place_of(entry).x() += rng.normal(0, sd);
  place_of(entry).y() += rng.normal(0, sd);
}

/// So many of 0 … n − 1, without repetition.
std::vector<std::size_t> drawn(std::size_t n, std::size_t count, core::Rng& rng) {
  std::vector<std::size_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = i;
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(all[i], all[i + static_cast<std::size_t>(rng.index(static_cast<int>(n - i)))]);
  }
  all.resize(count);
  return all;
}

std::vector<Eigen::Vector3d> places(const World& world, const SE3& T_world_sim, bool vehicles) {
  std::vector<Eigen::Vector3d> found;
  for (const TrueObject& object : world.objects) {
    if ((object.class_name == "vehicle") != vehicles || object.moving) continue;
    found.emplace_back(T_world_sim * objects::place(object.model));
  }
  return found;
}

/// The fence's box without its edge.
Eigen::AlignedBox2d inner_box(const MissionFence& fence) {
  constexpr double kEdge = 4;  // m
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i + 1 < fence.polygon_m.size(); i += 2) {
    box.extend(Eigen::Vector2d(fence.polygon_m[i], fence.polygon_m[i + 1]));
  }
  return {box.min().array() + kEdge, box.max().array() - kEdge};
}

Eigen::Vector2d empty_place(const Eigen::AlignedBox2d& box,
                            const std::vector<Eigen::Vector3d>& vehicles, core::Rng& rng) {
  for (int attempt = 0; attempt < kPlaceTries; ++attempt) {
    const double x = rng.uniform(box.min().x(), box.max().x());
    const Eigen::Vector2d p(x, rng.uniform(box.min().y(), box.max().y()));
    const bool empty = std::ranges::none_of(
        vehicles, [&](const Eigen::Vector3d& v) { return (v.head<2>() - p).norm() < kAway; });
    if (empty) return p;
  }
  throw Error("mission.site.prior_errors.invented: no place in the fence is far from all vehicles");
}

/// A prior map that grows entries of its own.
struct Draft {
  objects::ObjectMap map;
  int next_id;

  MapObject& add(MapObject like) {
    like.id = next_id++;
    return map.objects.emplace_back(std::move(like));
  }
};

void add_mistaken(Draft& draft, std::vector<Eigen::Vector3d> things, const MissionSiteConfig& site,
                  core::Rng& rng) {
  const auto count = static_cast<std::size_t>(site.prior_errors.mistaken);
  if (count > things.size()) {
    throw Error("mission.site.prior_errors.mistaken: " + std::to_string(count) + ", but only " +
                std::to_string(things.size()) + " trees and poles stand in the fence");
  }
  for (const std::size_t i : drawn(things.size(), count, rng)) {
    MapObject& entry = draft.add(draft.map.objects.front());
    place_of(entry).head<2>() = things[i].head<2>();
    blur(entry, site.prior_sd_m, rng);
  }
}

/// Leaves some of the first `targets` entries out.
void leave_out(Draft& draft, std::size_t targets, double share, core::Rng& rng) {
  const auto count = static_cast<std::size_t>(std::lround(share * static_cast<double>(targets)));
  std::vector<std::size_t> left_out = drawn(targets, count, rng);
  std::ranges::sort(left_out, std::greater{});
  for (const std::size_t i : left_out) {
    draft.map.objects.erase(draft.map.objects.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

objects::ObjectMap with_errors(const objects::ObjectMap& prior, const World& world,
                               const SE3& T_world_sim, const MissionFence& fence,
                               const MissionSiteConfig& site, core::Rng& rng) {
  const PriorErrorsConfig& errors = site.prior_errors;
  const std::size_t targets = prior.objects.size();
  const Eigen::AlignedBox2d box = inner_box(fence);
  Draft draft{prior, static_cast<int>(world.objects.size()) + 1};
  for (int i = 0; i < errors.duplicates; ++i) {
    blur(draft.add(prior.objects[static_cast<std::size_t>(i) % targets]), site.prior_sd_m, rng);
  }
  std::vector<Eigen::Vector3d> things = places(world, T_world_sim, false);
  std::erase_if(things, [&](const Eigen::Vector3d& p) {
    return !box.contains(Eigen::Vector2d(p.head<2>()));
  });
  add_mistaken(draft, std::move(things), site, rng);
  const std::vector<Eigen::Vector3d> vehicles = places(world, T_world_sim, true);
  for (int i = 0; i < errors.invented; ++i) {
    const Eigen::Vector2d place = empty_place(box, vehicles, rng);
    place_of(draft.add(prior.objects.front())).head<2>() = place;
  }
  leave_out(draft, targets, errors.missing_share, rng);
  return draft.map;
}

}  // namespace saker::simulation
