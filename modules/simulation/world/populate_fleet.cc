#include "saker/simulation/world/populate_fleet.h"

#include <cmath>
#include <numbers>

#include "saker/simulation/world/person.h"
#include "saker/simulation/world/two_wheeler.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr double kHalfTurn = std::numbers::pi;

bool place(Site& site, double s, double d, double yaw, const FleetShape& shape, bool moving) {
  if (!site.claim(s, d, yaw, shape.length / 2 + 0.12, shape.width / 2 + 0.16)) return false;
  add_fleet_vehicle(site.world, site.palette, shape, site.terrain.on_ground(s, d, yaw), moving,
                    site.rng);
  return true;
}

FleetShape next_member(Site& site) {
  return random_shape(random_kind(site.population.fleet, site.rng), site.rng);
}

/// A member that is no longer than `longest`; cars are, whatever the theme.
FleetShape next_member(Site& site, double longest) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const FleetShape shape = next_member(site);
    if (shape.length <= longest) return shape;
  }
  return random_shape(hatchback, site.rng);
}

/// Traffic keeps to the right: the right side drives along +s.
double driving_yaw(const Lot& lot) { return lot.side < 0 ? 0 : kHalfTurn; }

TwoWheeler any_two_wheeler(core::Rng& rng, double motor_share) {
  if (rng.chance(motor_share)) {
    return rng.chance(0.5) ? TwoWheeler::motorcycle : TwoWheeler::scooter;
  }
  return rng.chance(0.12) ? TwoWheeler::cargo_bicycle : TwoWheeler::bicycle;
}

bool place_two_wheeler(Site& site, TwoWheeler kind, double s, double d, double yaw, bool ridden,
                       double half_width = 0.4) {
  if (!site.claim(s, d, yaw, 1.0, half_width)) return false;
  add_two_wheeler(site.world, site.palette, kind, site.terrain.on_ground(s, d, yaw), ridden,
                  site.rng);
  return true;
}

/// Side by side from s on, at the same angle. \return where the row ends.
double park_row(Site& site, double s, double d, double yaw, TwoWheeler kind, bool mixed) {
  core::Rng& rng = site.rng;
  const bool motor = kind == TwoWheeler::motorcycle || kind == TwoWheeler::scooter;
  const double spacing = motor ? rng.uniform(0.72, 1.1) : rng.uniform(0.5, 0.8);
  const int count = 3 + rng.index(12);
  const bool stands = !motor && rng.chance(0.6);
  for (int i = 0; i < count; ++i, s += spacing) {
    const double turned = yaw + rng.normal(0, 0.08);
    if (rng.chance(0.15)) continue;
    const TwoWheeler next = mixed ? any_two_wheeler(rng, motor ? 1 : 0) : kind;
    const bool stood =
        place_two_wheeler(site, next, s, d + rng.normal(0, 0.06), turned, false, 0.45 * spacing);
    if (stood && stands) {
      add_bicycle_stand(site.world, site.palette, site.terrain.on_ground(s + spacing / 2, d, yaw),
                        rng);
    }
  }
  return s;
}

/// Bumper to bumper up to a stop line.
void build_queue(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const double along = lot.side < 0 ? 1 : -1;
  const double reach = site.terrain.shape().crossing_half_width + rng.uniform(1.5, 4);
  double s = site.terrain.shape().crossing - along * reach;
  const int count = 1 + rng.index(7);
  for (int i = 0; i < count; ++i) {
    const FleetShape shape = next_member(site);
    s -= along * shape.length / 2;
    if (s < lot.from || s > lot.to) return;
    place(site, s, lot.at(0.5) + rng.normal(0, 0.1), driving_yaw(lot) + rng.normal(0, 0.02), shape,
          true);
    s -= along * (shape.length / 2 + rng.uniform(0.6, 3));
  }
}

/// Vans, lorries and buses that stand in the lane beside the kerb to unload.
void double_park(Site& site, const Lot& lot) {
  constexpr FleetKind kKinds[] = {van,       large_van, step_van, box_van,
                                  box_truck, city_bus,  coach,    minibus};
  core::Rng& rng = site.rng;
  const int count = rng.index(4);
  for (int i = 0; i < count; ++i) {
    const FleetShape shape = random_shape(kKinds[rng.index(std::size(kKinds))], rng);
    const double s = rng.uniform(lot.from, lot.to);
    const double d =
        lot.side * (lot.d + lot.strip->width - shape.width / 2 + rng.uniform(-0.4, 0.5));
    place(site, s, d, driving_yaw(lot) + rng.normal(0, 0.04), shape, false);
  }
}

/// A row of lorries, buses or machines, nose in.
void park_heavy_across(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  for (double s = lot.from + 2; s < lot.to - 3; s += rng.uniform(3.3, 4.2)) {
    if (!rng.chance(site.population.parked)) continue;
    FleetShape shape = next_member(site, 12.6);
    if (shape.kind < large_van && rng.chance(0.7)) shape = random_shape(box_truck, rng);
    const double yaw = lot.side * (rng.chance(0.6) ? 1 : -1) * kHalfTurn / 2 + rng.normal(0, 0.03);
    place(site, s, lot.at(0.5) + rng.normal(0, 0.3), yaw, shape, false);
  }
}

/// People that stand or walk together.
void add_group(Site& site, double s, double d, int count) {
  core::Rng& rng = site.rng;
  const double yaw =
      rng.chance(0.7) ? (rng.chance(0.5) ? 0 : kHalfTurn) : rng.uniform(-kHalfTurn, kHalfTurn);
  for (int i = 0; i < count; ++i) {
    const double ps = s + (i == 0 ? 0 : rng.normal(0, 0.7));
    const double pd = d + (i == 0 ? 0 : rng.normal(0, 0.4));
    if (!site.claim(ps, pd, 0.28)) continue;
    add_passer_by(site.world, site.terrain.upright(ps, pd, yaw + rng.normal(0, 0.5)), rng);
  }
}

int count_of(Site& site, const Lot& lot, double per_100_m) {
  const double mean = per_100_m * site.population.clutter * (lot.to - lot.from) / 100;
  return static_cast<int>(mean * site.rng.uniform(0.3, 1.7) + site.rng.uniform());
}

void add_sidewalk_life(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const double turn = kHalfTurn / 2;
  for (int i = count_of(site, lot, 3); i > 0; --i) {
    add_group(site, rng.uniform(lot.from, lot.to), lot.at(rng.uniform(0.2, 0.85)),
              1 + rng.index(4));
  }
  for (int i = count_of(site, lot, 0.4); i > 0; --i) {  // facing the street
    const double s = rng.uniform(lot.from, lot.to), d = lot.at(0.85);
    if (!site.claim(s, d, 0.9)) continue;
    add_sitters(site.world, site.palette, site.terrain.upright(s, d, -lot.side * turn), rng);
  }
  for (int i = count_of(site, lot, 1); i > 0; --i) {
    const double yaw = rng.chance(0.6) ? turn + rng.normal(0, 0.2) : rng.uniform(0.5, 1.1);
    const TwoWheeler kind = any_two_wheeler(rng, 0.45);
    park_row(site, rng.uniform(lot.from, lot.to), lot.at(rng.chance(0.6) ? 0.2 : 0.8), yaw, kind,
             rng.chance(0.5));
  }
  for (int i = count_of(site, lot, 1); i > 0; --i) {
    place_two_wheeler(site, any_two_wheeler(rng, 0.3), rng.uniform(lot.from, lot.to),
                      lot.at(rng.uniform(0.15, 0.9)), rng.uniform(-0.3, 0.3), rng.chance(0.35));
  }
}

/// Vehicles off the road: machines at work, stored trailers and caravans, lorries in a yard.
void add_stored(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const FleetTheme theme = site.population.fleet;
  const bool busy = theme == FleetTheme::construction || theme == FleetTheme::industrial;
  if (!rng.chance(busy ? 0.7 : 0.2)) return;
  const double depth = std::min(lot.strip->width, 18.0);
  constexpr FleetKind kStored[] = {excavator, wheel_loader, roller,  forklift,
                                   trailer,   trailer,      caravan, tipper_truck};
  const int count = busy ? 1 + rng.index(5) : 1 + rng.index(2);
  for (int i = 0; i < count; ++i) {
    const FleetShape shape = rng.chance(busy ? 0.6 : 0.9) ? random_shape(kStored[rng.index(8)], rng)
                                                          : next_member(site, 13);
    const double d = lot.side * (lot.d + rng.uniform(0.2, 0.8) * depth);
    const double s = rng.uniform(0.6 * lot.from, 0.6 * lot.to);
    const double yaw = rng.chance(0.5) ? rng.uniform(-kHalfTurn, kHalfTurn)
                                       : kHalfTurn / 2 * rng.index(4) + rng.normal(0, 0.05);
    if (!place(site, s, d, yaw, shape, false)) continue;
    if (theme == FleetTheme::construction) add_group(site, s + 2.5, d + 2.5, rng.index(4));
  }
}

}  // namespace

FleetTheme any_theme(WorldKind kind, core::Rng& rng) {
  using enum FleetTheme;
  const double draw = rng.uniform();
  if (kind == WorldKind::country || kind == WorldKind::campus) {
    return draw < 0.45 ? european : draw < 0.8 ? american : draw < 0.9 ? construction : industrial;
  }
  if (draw < 0.34) return european;
  if (draw < 0.64) return american;
  return draw < 0.78 ? industrial : draw < 0.9 ? bus_road : construction;
}

void drive_fleet(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const bool crossing = std::abs(site.terrain.shape().crossing) < lot.to;
  if (crossing && rng.chance(0.6)) build_queue(site, lot);
  if (rng.chance(0.5)) double_park(site, lot);
  const double spacing = 12 / std::max(0.02, site.population.traffic);
  double s = lot.from + rng.uniform(0, 20);
  while (s < lot.to) {
    const double yaw = driving_yaw(lot) + rng.normal(0, 0.03);
    const double d = lot.at(0.5) + rng.normal(0, 0.2);
    if (rng.chance(0.12)) {
      place_two_wheeler(site, any_two_wheeler(rng, 0.5), s, lot.at(rng.uniform(0.3, 0.85)), yaw,
                        true);
      s += 3;
    } else {
      const FleetShape shape = next_member(site);
      place(site, s + shape.length / 2, d, yaw, shape, true);
      s += shape.length;
    }
    s += rng.chance(0.3) ? rng.uniform(1, 6) : -spacing * std::log(1 - 0.999 * rng.uniform());
  }
}

void park_fleet_along(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const double against = rng.uniform(0, 0.3);  // share that is parked against the traffic
  const double on_kerb = rng.chance(0.25) ? rng.uniform(0.4, 1.1) : 0;
  const double tight = rng.uniform(0.35, 1.2);
  double s = lot.from;
  while (s < lot.to - 6) {
    if (rng.chance(0.06)) {
      const double yaw = lot.side * (rng.chance(0.6) ? kHalfTurn / 2 : rng.uniform(0.7, 1.2));
      const TwoWheeler kind = any_two_wheeler(rng, 0.75);
      s = 1 + park_row(site, s + 0.5, lot.at(0.5), yaw, kind, rng.chance(0.4));
      continue;
    }
    const FleetShape shape = next_member(site);
    if (rng.chance(site.population.parked)) {
      const double yaw =
          driving_yaw(lot) + (rng.chance(against) ? kHalfTurn : 0) + rng.normal(0, 0.025);
      const double d = lot.at(0.5) + lot.side * on_kerb + rng.normal(0, 0.08);
      place(site, s + shape.length / 2, d, yaw, shape, false);
    }
    s += shape.length + tight * rng.uniform(0.7, 1.8);
  }
}

void park_fleet_across(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const FleetTheme theme = site.population.fleet;
  const bool yard = theme == FleetTheme::industrial || theme == FleetTheme::bus_road;
  if (rng.chance(yard ? 0.4 : 0.03)) return park_heavy_across(site, lot);
  const double slot = theme == FleetTheme::american ? rng.uniform(2.6, 3) : rng.uniform(2.4, 2.75);
  const double skew = rng.chance(0.3) ? rng.uniform(-0.7, 0.7) : 0;
  const double nose_in = rng.chance(0.2) ? 0.1 : 0.75;
  for (double s = lot.from; s < lot.to - 3; s += slot / std::cos(skew)) {
    if (!rng.chance(site.population.parked)) continue;
    const double ahead = rng.chance(nose_in) ? 1 : -1;
    const double yaw = lot.side * ahead * (kHalfTurn / 2 - skew) + rng.normal(0, 0.03);
    if (rng.chance(0.04)) {
      s += std::max(
          0.0, park_row(site, s, lot.at(0.5), yaw, any_two_wheeler(rng, 0.8), true) - s - slot);
      continue;
    }
    const FleetShape shape = next_member(site, 6.5);
    place(site, s, lot.at(0.5) + rng.normal(0, 0.15), yaw, shape, false);
  }
}

void park_in_drive(Site& site, const Lot& lot, double s) {
  const FleetShape shape = next_member(site, 6.5);
  const double yaw = lot.side * (site.rng.chance(0.7) ? 1 : -1) * kHalfTurn / 2;
  place(site, s, lot.at(0.55), yaw, shape, false);
}

void add_street_life(Site& site, const Lot& lot) {
  switch (lot.strip->use) {
    case Use::sidewalk:
      return add_sidewalk_life(site, lot);
    case Use::lawn:
    case Use::verge:
      return add_stored(site, lot);
    case Use::perpendicular_parking:
      for (int i = count_of(site, lot, 1.5); i > 0; --i) {
        add_group(site, site.rng.uniform(lot.from, lot.to), lot.at(site.rng.uniform(0, 1)),
                  1 + site.rng.index(3));
      }
      return;
    default:
      return;
  }
}

}  // namespace saker::simulation
