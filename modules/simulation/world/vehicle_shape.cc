#include <algorithm>

#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

/// A normal draw within two standard deviations; without any, the mean, and nothing is drawn.
double draw(core::Rng& rng, double mean, double sd) {
  if (sd == 0) return mean;
  return mean + sd * std::clamp(rng.normal(), -2.0, 2.0);
}

/// How the bodies of a kind of car are cut: m, but `screen_base` is a share of the length.
struct Cut {
  double length, width, height;
  double bonnet, belt, tail;       ///< heights
  double screen_base, screen_run;  ///< where the windscreen begins, and its run along x
  double boot, window_run;         ///< behind the rear window, and its run
};

// Sedan, hatchback, SUV, van, pickup: means and standard deviations. A pickup's tail puts its bed's
// floor 0.77 to 0.89 m above the ground.
constexpr Cut kMeans[] = {{4.65, 1.81, 1.45, 0.72, 0.93, 1.0, 0.28, 0.65, 0.6, 0.75},
                          {4.05, 1.74, 1.48, 0.76, 0.95, 1.0, 0.25, 0.7, 0.08, 0.42},
                          {4.6, 1.88, 1.71, 0.93, 1.12, 1.15, 0.26, 0.6, 0.08, 0.33},
                          {4.95, 1.92, 1.93, 0.98, 1.16, 1.2, 0.17, 0.75, 0.03, 0.12},
                          {5.3, 1.9, 1.79, 1.0, 1.15, 1.32, 0.25, 0.55, 1.55, 0.12}};
constexpr Cut kSpreads[] = {{0.2, 0.05, 0.03, 0.04, 0.03, 0.05, 0.015, 0.06, 0.1, 0.12},
                            {0.22, 0.05, 0.04, 0.04, 0.03, 0.04, 0.015, 0.06, 0.04, 0.1},
                            {0.18, 0.05, 0.06, 0.05, 0.04, 0.04, 0.015, 0.06, 0.04, 0.08},
                            {0.25, 0.05, 0.05, 0.05, 0.04, 0.04, 0.02, 0.08, 0, 0.03},
                            {0.15, 0.05, 0.05, 0.04, 0.03, 0.03, 0.01, 0.05, 0.1, 0.03}};
constexpr double kLift[] = {0, 0, 0.05, 0, 0.08};  ///< m, of the underbody over a sedan's

void draw_car(VehicleShape& s, core::Rng& rng) {
  const auto kind = static_cast<std::size_t>(s.kind);
  const auto drawn = [&](double Cut::*what) {
    return draw(rng, kMeans[kind].*what, kSpreads[kind].*what);
  };
  s.length = drawn(&Cut::length);
  s.width = drawn(&Cut::width);
  s.height = drawn(&Cut::height);
  s.clearance = draw(rng, 0.17, 0.02) + kLift[kind];
  s.wheel_radius = std::clamp(0.215 * s.height, 0.29, 0.39);
  s.front_axle = draw(rng, 0.19, 0.012) * s.length;
  s.rear_axle = draw(rng, 0.2, 0.018) * s.length;
  s.tumblehome = draw(rng, 0.3, 0.06);
  s.roundness = draw(rng, 0.17, 0.035);
  s.bonnet = drawn(&Cut::bonnet);
  s.belt = drawn(&Cut::belt);
  s.tail = drawn(&Cut::tail);
  s.screen_base = drawn(&Cut::screen_base) * s.length;
  s.roof_front = s.screen_base + drawn(&Cut::screen_run);
  s.rear_base = s.length - drawn(&Cut::boot);
  s.roof_rear = s.rear_base - drawn(&Cut::window_run);
}

/// A quarter of the hatchbacks are estates: a longer roof.
void stretch(VehicleShape& s, core::Rng& rng) {
  if (!rng.chance(0.25)) return;
  s.length += 0.35;
  s.rear_base += 0.35;
  s.roof_rear += 0.33;
}

/// Upright sides, full ends.
void square_up(VehicleShape& s, core::Rng& rng) {
  s.tumblehome = draw(rng, 0.12, 0.03);
  s.roundness = draw(rng, 0.1, 0.02);
  s.panel_sides = rng.chance(0.5);
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
  if (kind >= VehicleKind::truck) {
    heavy(s, rng);
    return s;
  }
  draw_car(s, rng);
  if (kind == VehicleKind::hatchback) stretch(s, rng);
  if (kind == VehicleKind::van) square_up(s, rng);
  s.open_bed = kind == VehicleKind::pickup;
  if (s.open_bed) s.roundness = draw(rng, 0.1, 0.02);
  return s;
}

}  // namespace saker::simulation
