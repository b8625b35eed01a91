#include <algorithm>

#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

/// A normal draw within two standard deviations.
double draw(core::Rng& rng, double mean, double sd) {
  return mean + sd * std::clamp(rng.normal(), -2.0, 2.0);
}

void common(VehicleShape& s, core::Rng& rng) {
  s.clearance = draw(rng, 0.17, 0.02);
  s.wheel_radius = std::clamp(0.215 * s.height, 0.29, 0.39);
  s.front_axle = draw(rng, 0.19, 0.012) * s.length;
  s.rear_axle = draw(rng, 0.2, 0.018) * s.length;
  s.tumblehome = draw(rng, 0.3, 0.06);
  s.roundness = draw(rng, 0.17, 0.035);
}

void sedan(VehicleShape& s, core::Rng& rng) {
  s.length = draw(rng, 4.65, 0.2);
  s.width = draw(rng, 1.81, 0.05);
  s.height = draw(rng, 1.45, 0.03);
  common(s, rng);
  s.bonnet = draw(rng, 0.72, 0.04);
  s.belt = draw(rng, 0.93, 0.03);
  s.tail = draw(rng, 1.0, 0.05);
  s.screen_base = draw(rng, 0.28, 0.015) * s.length;
  s.roof_front = s.screen_base + draw(rng, 0.65, 0.06);
  s.rear_base = s.length - draw(rng, 0.6, 0.1);
  s.roof_rear = s.rear_base - draw(rng, 0.75, 0.12);
}

void hatchback(VehicleShape& s, core::Rng& rng) {
  s.length = draw(rng, 4.05, 0.22);
  s.width = draw(rng, 1.74, 0.05);
  s.height = draw(rng, 1.48, 0.04);
  common(s, rng);
  s.bonnet = draw(rng, 0.76, 0.04);
  s.belt = draw(rng, 0.95, 0.03);
  s.tail = draw(rng, 1.0, 0.04);
  s.screen_base = draw(rng, 0.25, 0.015) * s.length;
  s.roof_front = s.screen_base + draw(rng, 0.7, 0.06);
  s.rear_base = s.length - draw(rng, 0.08, 0.04);
  s.roof_rear = s.rear_base - draw(rng, 0.42, 0.1);
  if (!rng.chance(0.25)) return;
  s.length += 0.35;  // an estate: a longer roof
  s.rear_base += 0.35;
  s.roof_rear += 0.33;
}

void suv(VehicleShape& s, core::Rng& rng) {
  s.length = draw(rng, 4.6, 0.18);
  s.width = draw(rng, 1.88, 0.05);
  s.height = draw(rng, 1.71, 0.06);
  common(s, rng);
  s.clearance += 0.05;
  s.bonnet = draw(rng, 0.93, 0.05);
  s.belt = draw(rng, 1.12, 0.04);
  s.tail = draw(rng, 1.15, 0.04);
  s.screen_base = draw(rng, 0.26, 0.015) * s.length;
  s.roof_front = s.screen_base + draw(rng, 0.6, 0.06);
  s.rear_base = s.length - draw(rng, 0.08, 0.04);
  s.roof_rear = s.rear_base - draw(rng, 0.33, 0.08);
}

void van(VehicleShape& s, core::Rng& rng) {
  s.length = draw(rng, 4.95, 0.25);
  s.width = draw(rng, 1.92, 0.05);
  s.height = draw(rng, 1.93, 0.05);
  common(s, rng);
  s.bonnet = draw(rng, 0.98, 0.05);
  s.belt = draw(rng, 1.16, 0.04);
  s.tail = draw(rng, 1.2, 0.04);
  s.screen_base = draw(rng, 0.17, 0.02) * s.length;
  s.roof_front = s.screen_base + draw(rng, 0.75, 0.08);
  s.rear_base = s.length - 0.03;
  s.roof_rear = s.rear_base - draw(rng, 0.12, 0.03);
  s.tumblehome = draw(rng, 0.12, 0.03);
  s.roundness = draw(rng, 0.1, 0.02);
  s.panel_sides = rng.chance(0.5);
}

void pickup(VehicleShape& s, core::Rng& rng) {
  s.length = draw(rng, 5.3, 0.15);
  s.width = draw(rng, 1.9, 0.05);
  s.height = draw(rng, 1.79, 0.05);
  common(s, rng);
  s.clearance += 0.08;
  s.bonnet = draw(rng, 1.0, 0.04);
  s.belt = draw(rng, 1.15, 0.03);
  s.tail = draw(rng, 1.32, 0.03);  // the bed's floor 0.77 to 0.89 m above the ground
  s.screen_base = draw(rng, 0.25, 0.01) * s.length;
  s.roof_front = s.screen_base + draw(rng, 0.55, 0.05);
  s.rear_base = s.length - draw(rng, 1.55, 0.1);
  s.roof_rear = s.rear_base - draw(rng, 0.12, 0.03);
  s.open_bed = true;
  s.roundness = draw(rng, 0.1, 0.02);
}

void heavy(VehicleShape& s, core::Rng& rng) {
  const bool bus = s.kind == VehicleKind::bus;
  const bool trailer = s.kind == VehicleKind::trailer;
  s.length = bus ? rng.uniform(9, 12.5) : trailer ? rng.uniform(2.2, 5) : rng.uniform(6, 9.5);
  s.width = trailer ? rng.uniform(1.4, 2.2) : rng.uniform(2.2, 2.55);
  s.height = bus ? rng.uniform(2.8, 3.2) : trailer ? rng.uniform(1, 2.6) : rng.uniform(2.6, 3.6);
  s.clearance = bus ? 0.3 : trailer ? 0.45 : 0.6;
  s.wheel_radius = trailer ? 0.3 : 0.48;
  s.front_axle = bus ? 2.6 : 1.2;
  s.rear_axle = trailer ? s.length / 2 : 0.25 * s.length;
}

}  // namespace

std::string name_of(VehicleKind kind) {
  constexpr const char* kNames[] = {"sedan",  "hatchback", "suv", "van",
                                    "pickup", "truck",     "bus", "trailer"};
  return kNames[static_cast<int>(kind)];
}

VehicleShape random_shape(VehicleKind kind, core::Rng& rng) {
  VehicleShape s;
  s.kind = kind;
  switch (kind) {
    case VehicleKind::sedan:
      sedan(s, rng);
      break;
    case VehicleKind::hatchback:
      hatchback(s, rng);
      break;
    case VehicleKind::suv:
      suv(s, rng);
      break;
    case VehicleKind::van:
      van(s, rng);
      break;
    case VehicleKind::pickup:
      pickup(s, rng);
      break;
    default:
      heavy(s, rng);
  }
  return s;
}

}  // namespace saker::simulation
