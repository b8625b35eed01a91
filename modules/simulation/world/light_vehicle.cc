#include <algorithm>

#include "saker/simulation/world/fleet.h"
#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

/// How a body is cut, as shares of its length (from the front end) and height.
struct Style {
  FleetKind kind;
  double bonnet, belt, tail;       ///< of the height
  double screen_base, roof_front;  ///< of the length
  double rear_run, boot;           ///< m: rear window along x, and what is behind it
  double clearance, wheel_radius;  ///< m
  double front_axle, rear_axle;    ///< of the length, from their ends
  double tumblehome, roundness;
};

constexpr Style kStyles[] = {
    {city_car, 0.56, 0.64, 0.66, 0.21, 0.4, 0.35, 0.06, 0.15, 0.29, 0.17, 0.15, 0.25, 0.2},
    {hatchback, 0.52, 0.64, 0.67, 0.25, 0.42, 0.45, 0.08, 0.15, 0.31, 0.2, 0.18, 0.3, 0.18},
    {estate, 0.5, 0.63, 0.66, 0.26, 0.41, 0.4, 0.06, 0.15, 0.32, 0.2, 0.21, 0.3, 0.17},
    {sedan, 0.5, 0.64, 0.69, 0.28, 0.42, 0.75, 0.6, 0.15, 0.33, 0.19, 0.21, 0.32, 0.17},
    {coupe, 0.53, 0.66, 0.7, 0.3, 0.44, 0.95, 0.3, 0.13, 0.33, 0.2, 0.2, 0.38, 0.18},
    {compact_suv, 0.56, 0.65, 0.66, 0.24, 0.4, 0.4, 0.07, 0.19, 0.34, 0.19, 0.19, 0.27, 0.16},
    {suv, 0.56, 0.65, 0.66, 0.25, 0.38, 0.36, 0.07, 0.2, 0.37, 0.18, 0.2, 0.24, 0.13},
    {large_suv, 0.58, 0.66, 0.66, 0.24, 0.34, 0.2, 0.05, 0.24, 0.39, 0.18, 0.22, 0.2, 0.1},
    {mpv, 0.52, 0.61, 0.63, 0.19, 0.37, 0.32, 0.06, 0.16, 0.33, 0.19, 0.2, 0.22, 0.16},
    {pickup_midsize, 0.57, 0.65, 0.73, 0.24, 0.35, 0.12, 1.55, 0.25, 0.38, 0.17, 0.23, 0.26, 0.1},
    {pickup_fullsize, 0.6, 0.67, 0.72, 0.24, 0.34, 0.12, 1.75, 0.27, 0.4, 0.16, 0.22, 0.2, 0.08},
    {small_van, 0.52, 0.6, 0.61, 0.2, 0.37, 0.14, 0.03, 0.16, 0.32, 0.19, 0.18, 0.14, 0.14},
    {van, 0.5, 0.58, 0.58, 0.17, 0.33, 0.12, 0.03, 0.18, 0.34, 0.18, 0.2, 0.1, 0.11},
    {large_van, 0.45, 0.53, 0.53, 0.15, 0.31, 0.08, 0.02, 0.2, 0.35, 0.17, 0.2, 0.06, 0.09},
};

VehicleShape body_of(const FleetShape& fleet, const Style& style, core::Rng& rng) {
  const auto about = [&](double value, double share) {
    return value * (1 + share * rng.uniform(-1, 1));
  };
  VehicleShape s;
  s.length = fleet.length;
  s.width = fleet.width;
  s.height = fleet.height;
  s.bonnet = about(style.bonnet, 0.07) * std::min(fleet.height, 2.35);
  s.belt = about(style.belt, 0.03) * std::min(fleet.height, 2.35);
  s.tail = std::max(s.belt, about(style.tail, 0.04) * std::min(fleet.height, 2.35));
  s.screen_base = about(style.screen_base, 0.08) * fleet.length;
  s.roof_front = s.screen_base + about(style.roof_front - style.screen_base, 0.15) * fleet.length;
  s.rear_base = fleet.length - about(style.boot, 0.15);
  s.roof_rear = s.rear_base - about(style.rear_run, 0.2);
  s.clearance = about(style.clearance, 0.15);
  s.wheel_radius = about(style.wheel_radius, 0.05);
  s.front_axle = about(style.front_axle, 0.06) * fleet.length;
  s.rear_axle = about(style.rear_axle, 0.08) * fleet.length;
  s.tumblehome = about(style.tumblehome, 0.2);
  s.roundness = about(style.roundness, 0.2);
  return s;
}

/// Boxes, planks or a machine in a bed: from its floor to above its walls.
void draw_load(const VehicleShape& s, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const double rear = -s.length / 2 + 0.15;
  const double front = s.length / 2 - s.rear_base - 0.1;
  const int pieces = 1 + rng.index(5);
  for (int i = 0; i < pieces; ++i) {
    const double x = rng.uniform(rear, std::max(rear + 0.1, front - 0.5));
    const double y = rng.uniform(-0.65, 0.2);
    draw.box({x, y, s.tail - 0.48},
             {std::min(x + rng.uniform(0.3, 1.2), front), y + rng.uniform(0.2, 0.5),
              std::min(s.tail + rng.uniform(-0.2, 0.35), s.height - 0.05)},
             parts.second);
  }
}

/// A bed is open and empty, loaded, covered flat, or under a canopy as high as the cabin.
void finish_bed(const VehicleShape& s, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const double rear = -s.length / 2 + 0.07;
  const double front = s.length / 2 - s.rear_base;
  const double w = 0.45 * s.width;
  const double fate = rng.uniform();
  if (fate < 0.25) {
    draw_load(s, parts, pen, rng);
  } else if (fate < 0.45) {
    draw.box({rear, -w, s.tail - 0.02}, {front, w, s.tail + 0.03}, parts.dark);
  } else if (fate < 0.6) {
    const WallHeights heights{s.tail, s.tail + 0.1, s.height - 0.15, s.height - 0.03};
    for (const double side : {-1.0, 1.0}) {
      draw_glazed_side(pen, rear, front, side * w, heights, {{rear + 0.12, front - 0.12}}, parts);
    }
    draw_glazed_end(pen, {rear, rear, rear + 0.08, rear + 0.1}, w, heights, parts);
    draw.box({rear + 0.1, -w, s.height - 0.05}, {front, w, s.height - 0.03}, parts.paint);
  } else if (fate < 0.7) {  // a rack of bars
    for (const double y : {-w, w}) {
      draw_bar(pen, {front - 0.1, y, s.tail}, {front - 0.1, y, s.height - 0.04}, 0.06, parts.dark);
      draw_bar(pen, {rear + 0.1, y, s.tail}, {front - 0.1, y, s.height - 0.04}, 0.06, parts.dark);
    }
    draw_bar(pen, {front - 0.1, -w, s.height - 0.04}, {front - 0.1, w, s.height - 0.04}, 0.06,
             parts.dark);
  }
}

}  // namespace

void draw_light(const FleetShape& shape, const Palette& palette, const Parts& parts, const Pen& pen,
                core::Rng& rng) {
  const Style& style = kStyles[static_cast<std::size_t>(shape.kind)];
  VehicleShape s = body_of(shape, style, rng);
  const bool pickup = shape.kind == pickup_midsize || shape.kind == pickup_fullsize;
  s.open_bed = pickup;
  const bool cargo = shape.kind >= small_van;
  s.panel_sides = cargo && rng.chance(shape.kind == large_van ? 0.8 : 0.55);
  if (pickup && rng.chance(0.35)) {  // a short cab and a long bed
    s.rear_base -= 0.4;
    s.roof_rear -= 0.4;
  }
  draw_vehicle(s, with_parts(palette, parts), parts.paint, parts.glass, pen);
  if (pickup) finish_bed(s, parts, pen, rng);
}

}  // namespace saker::simulation
