#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/buildings.h"
#include "saker/simulation/world/furniture.h"
#include "saker/simulation/world/populate_fleet.h"

namespace saker::simulation {
namespace {

double any_turn(Site& site) { return site.rng.uniform(0, 2 * std::numbers::pi); }

bool plant_tree(Site& site, double s, double d, const TreeShape& shape) {
  if (!site.claim(s, d, shape.trunk_radius + 0.35)) return false;
  add_tree(site.world, site.palette, site.flora, shape, site.terrain.upright(s, d, any_turn(site)),
           site.rng);
  if (site.rng.chance(0.12 * site.population.greenery)) {  // shoots around its foot
    const double radius = site.rng.uniform(0.3, 0.9);
    add_bush(site.world, site.flora, site.terrain.upright(s, d), radius, site.rng.uniform(0.3, 1.3),
             site.rng);
  }
  return true;
}

void plant_bush(Site& site, double s, double d) {
  const double radius = site.rng.uniform(0.25, 1.4);
  if (!site.claim(s, d, 0.7 * radius)) return;
  add_bush(site.world, site.flora, site.terrain.upright(s, d), radius,
           radius * site.rng.uniform(0.7, 1.9), site.rng);
}

/// `per_100_m2` of something at random over the lot.
template <class Plant>
void scatter(Site& site, const Lot& lot, double per_100_m2, Plant plant) {
  const double depth = std::min(lot.strip->width, 30.0);
  const double mean = per_100_m2 * (lot.to - lot.from) * depth / 100;
  const double drawn = mean * site.rng.uniform(0.6, 1.4);
  const int count = static_cast<int>(drawn + site.rng.uniform());
  for (int i = 0; i < count; ++i) {
    const double s = site.rng.uniform(lot.from, lot.to);
    plant(s, lot.side * (lot.d + site.rng.uniform(0.05, 0.95) * depth));
  }
}

void scatter_bushes(Site& site, const Lot& lot, double per_100_m2) {
  scatter(site, lot, per_100_m2 * site.population.greenery,
          [&](double s, double d) { plant_bush(site, s, d); });
}

void scatter_trees(Site& site, const Lot& lot, double per_100_m2) {
  scatter(site, lot, per_100_m2 * site.population.greenery,
          [&](double s, double d) { plant_tree(site, s, d, random_tree(site.rng)); });
}

/// A hedge along the lot at `share` of its width, with gaps for gates.
void grow_hedge(Site& site, const Lot& lot, double share) {
  const double height = site.rng.uniform(0.6, 2.6);
  const double depth = site.rng.uniform(0.5, 1.1);
  for (double s = lot.from; s < lot.to; s += 1) {
    if (std::fmod(s + 1000, 14.0) < 2 || site.terrain.in_crossing(s, 1)) continue;
    if (!site.claim(s + 0.5, lot.at(share), 0.3)) continue;
    add_hedge_block(site.world, site.flora, site.terrain.on_ground(s, lot.at(share)), 1.05, depth,
                    height * site.rng.uniform(0.92, 1.06), site.rng);
  }
}

void build_fence(Site& site, const Lot& lot, double share, Fence kind, double height) {
  constexpr double kPiece = 2.5;
  for (double s = lot.from; s < lot.to; s += kPiece) {
    if (site.terrain.in_crossing(s + kPiece / 2, kPiece) || site.rng.chance(0.06)) continue;
    add_fence(site.world, site.palette, kind, site.terrain.on_ground(s, lot.at(share)), kPiece,
              height);
  }
}

Fence any_garden_fence(core::Rng& rng) {
  constexpr Fence kKinds[] = {Fence::wire, Fence::picket, Fence::wall, Fence::panels};
  return kKinds[rng.index(4)];
}

void border(Site& site, const Lot& lot, double share) {
  const double draw = site.rng.uniform();
  if (draw < 0.5) {
    grow_hedge(site, lot, share);
  } else if (draw < 0.82) {
    build_fence(site, lot, share, any_garden_fence(site.rng), site.rng.uniform(0.5, 1.7));
  }
}

}  // namespace

void build_verge(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  scatter_bushes(site, lot, rng.chance(0.5) ? 1.2 : 0.2);
  if (rng.chance(0.6)) scatter_trees(site, lot, 0.6);
  const bool power = rng.chance(0.35);
  if (!power && rng.chance(0.4)) return;
  const double spacing = power ? rng.uniform(25, 45) : site.population.lamp_spacing;
  for (double s = lot.from + rng.uniform(0, spacing); s < lot.to; s += spacing) {
    const double d = lot.at(rng.uniform(0.2, 0.7));
    if (!site.claim(s, d, 0.4)) continue;
    const SE3 T = site.terrain.upright(s, d, lot.side > 0 ? 0 : std::numbers::pi);
    if (power) {
      add_power_pole(site.world, site.palette, T, rng);
    } else if (rng.chance(0.5)) {
      add_lamp(site.world, site.palette, T, rng);
    } else {
      add_sign(site.world, site.palette, T, rng);
    }
  }
}

void build_island(Site& site, const Lot& lot) {
  const double spacing = site.population.tree_spacing;
  for (double s = lot.from + site.rng.uniform(0, spacing); s < lot.to; s += spacing) {
    if (site.rng.chance(0.75)) {
      plant_tree(site, s, lot.at(0.5), random_tree(site.rng));
    } else if (site.claim(s, lot.at(0.5), 0.4)) {
      add_lamp(site.world, site.palette, site.terrain.upright(s, lot.at(0.5), any_turn(site)),
               site.rng);
    }
  }
  scatter_bushes(site, lot, 4);
}

void build_garden(Site& site, const Lot& lot) {
  border(site, lot, 0.06);
  if (lot.strip->width > 4.5) {
    for (double s = lot.from; s < lot.to; s += 16) {  // drives with a car in front of the house
      if (!site.rng.chance(0.35 * site.population.parked)) continue;
      if (site.population.fleet != FleetTheme::none) {
        park_in_drive(site, lot, s);
        continue;
      }
      const VehicleShape shape = random_shape(site.next_kind(), site.rng);
      const double yaw = lot.side * (site.rng.chance(0.7) ? 1 : -1) * std::numbers::pi / 2;
      if (shape.length > 6 ||
          !site.claim(s, lot.at(0.55), yaw, shape.length / 2, shape.width / 2 + 0.2))
        continue;
      add_vehicle(site.world, site.palette, shape, site.terrain.on_ground(s, lot.at(0.55), yaw),
                  false, site.rng);
    }
  }
  scatter_trees(site, lot, 1.2);
  scatter_bushes(site, lot, site.rng.uniform(2, 12));
}

void build_lawn(Site& site, const Lot& lot) {
  scatter_trees(site, lot, site.rng.uniform(0.2, 1.1));
  scatter_bushes(site, lot, site.rng.uniform(0.1, 1.0));
  const auto place = [&](auto add, double radius) {
    return [&site, add, radius](double s, double d) {
      if (site.claim(s, d, radius))
        add(site.world, site.palette, site.terrain.upright(s, d, any_turn(site)), site.rng);
    };
  };
  scatter(site, lot, 0.08 * site.population.clutter, place(add_bench, 1.0));
  scatter(site, lot, 0.1 * site.population.clutter, place(add_lamp, 0.4));
  scatter(site, lot, 0.1 * site.population.clutter, place(add_person, 0.4));
}

void build_tree_row(Site& site, const Lot& lot) {
  const double spacing = site.population.tree_spacing * site.rng.uniform(0.5, 1);
  TreeShape alike = random_tree(site.rng);
  const bool planted = site.rng.chance(0.5);
  for (double s = lot.from; s < lot.to; s += spacing * site.rng.uniform(0.8, 1.2)) {
    TreeShape shape = planted ? alike : random_tree(site.rng);
    shape.trunk_radius *= site.rng.uniform(0.85, 1.15);
    plant_tree(site, s, lot.at(site.rng.uniform(0.3, 0.7)), shape);
  }
  scatter_bushes(site, lot, site.rng.chance(0.5) ? 4 : 0.5);
}

void build_forest(Site& site, const Lot& lot) {
  scatter_trees(site, lot, site.rng.uniform(2, 5));
  scatter_bushes(site, lot, site.rng.uniform(1, 6));
}

void build_thicket(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const double tall = rng.uniform(0.8, 4.5);
  const double spacing = rng.uniform(0.5, 0.9);
  const double depth = std::min(lot.strip->width, 12.0);
  for (double s = lot.from; s < lot.to; s += spacing * std::min(tall, 2.0)) {
    if (site.terrain.in_crossing(s, 1) || rng.chance(0.04)) continue;
    for (double out = 0.6; out < depth; out += 1.6 * std::min(tall, 2.0)) {
      const double height = tall * rng.uniform(0.6, 1.3);
      const double radius = std::max(0.5, 0.55 * height) * rng.uniform(0.7, 1.2);
      const double d = lot.side * (lot.d + out + rng.uniform(-0.4, 0.4));
      add_bush(site.world, site.flora, site.terrain.upright(s, d), radius, height, rng);
    }
  }
  scatter_trees(site, lot, 1.5);
}

void build_barrier(Site& site, const Lot& lot) {
  const double draw = site.rng.uniform();
  if (draw < 0.5) {
    build_fence(site, lot, 0.5, Fence::rail, 0.75);
  } else if (draw < 0.7) {
    build_fence(site, lot, 0.5, Fence::wire, site.rng.uniform(1, 2));
  } else if (draw < 0.85) {
    build_fence(site, lot, 0.5, Fence::wall, site.rng.uniform(0.4, 2.5));
  } else {
    grow_hedge(site, lot, 0.5);
  }
}

}  // namespace saker::simulation
