#include <algorithm>
#include <cmath>

#include "saker/simulation/world/fleet.h"
#include "saker/simulation/world/vehicle_cab.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr double kDoor = 1.25;  // m

/// A room for passengers with windows all around.
struct Shell {
  double rear, front, half_width;
  WallHeights heights;
  double pane = 1.4;                     ///< m, with its pillar
  double radius = 0.48;                  ///< of its wheels
  std::vector<double> axles{}, doors{};  ///< x of their middles; doors are on the right
  bool open_front = false;               ///< a cab is before it
  bool open_rear = false;                ///< another room is behind it
};

Panes panes_between(double from, double to, double pane) {
  Panes panes;
  const int count = std::max(1, static_cast<int>((to - from) / pane));
  const double step = (to - from) / count;
  for (int i = 0; i < count; ++i) {
    panes.emplace_back(from + i * step + 0.05, from + (i + 1) * step - 0.05);
  }
  return panes;
}

/// The skirt below the windows, open around the wheels.
void draw_skirt(const Pen& pen, const Shell& s, double y, double arch_top, const Parts& parts) {
  Pen draw = pen;
  const double reach = s.radius + 0.1;
  const auto piece = [&](double from, double to) {
    if (to < from) return;
    draw.quad({from, y, s.heights.low}, {to, y, s.heights.low}, {to, y, arch_top},
              {from, y, arch_top}, parts.paint);
  };
  std::vector<double> axles = s.axles;
  std::sort(axles.begin(), axles.end());
  double from = s.rear;
  for (const double x : axles) {
    piece(from, x - reach);
    from = x + reach;
  }
  piece(from, s.front);
}

void draw_side(const Pen& pen, const Shell& s, double side, const Parts& parts) {
  const double y = side * s.half_width;
  const double arch_top = std::min(2 * s.radius + 0.08, s.heights.sill);
  WallHeights wall = s.heights;
  wall.low = arch_top;
  draw_skirt(pen, s, y, arch_top, parts);
  std::vector<double> doors = side < 0 ? s.doors : std::vector<double>{};
  std::sort(doors.begin(), doors.end());
  double from = s.rear;
  const auto windows = [&](double to) {
    if (to - from > 0.3)
      draw_glazed_side(pen, from, to, y, wall, panes_between(from, to, s.pane), parts);
  };
  for (const double door : doors) {
    windows(door - kDoor / 2);
    WallHeights tall = wall;
    tall.sill = std::max(arch_top + 0.02, s.heights.low + 0.1);
    const Panes leaves = panes_between(door - kDoor / 2, door + kDoor / 2, kDoor / 2);
    draw_glazed_side(pen, door - kDoor / 2, door + kDoor / 2, y, tall, leaves, parts);
    from = door + kDoor / 2;
  }
  windows(s.front);
}

void draw_inside(const Pen& pen, const Shell& s, double floor, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double w = s.half_width;
  draw.box({s.rear, -w, floor - 0.05}, {s.front, w, floor}, parts.interior);
  const double spacing = rng.uniform(0.72, 0.95);
  for (double x = s.rear + 0.5; x < s.front - 1.5; x += spacing) {
    for (const double y : {-0.72 * w, -0.38 * w, 0.38 * w, 0.72 * w}) {
      if (rng.chance(0.15)) continue;
      draw_seat(pen.at(x, y, floor), 0.42, 1.15, parts.interior);
      if (rng.chance(0.2)) draw.ellipsoid({x, y, floor + 0.85}, {0.15, 0.2, 0.42}, parts.interior);
    }
  }
  for (const double x : s.axles) {
    draw.box({x - 0.55, -w + 0.4, s.heights.low},
             {x + 0.55, w - 0.4, std::max(floor, 2 * s.radius + 0.1)}, parts.dark);
  }
}

void draw_shell(const Pen& pen, const Shell& s, double floor, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double w = s.half_width;
  const WallHeights& h = s.heights;
  for (const double side : {-1.0, 1.0}) draw_side(pen, s, side, parts);
  draw.quad({s.rear, -w, h.top}, {s.front, -w, h.top}, {s.front, w, h.top}, {s.rear, w, h.top},
            parts.paint);
  draw.quad({s.rear, -w, h.low}, {s.front, -w, h.low}, {s.front, w, h.low}, {s.rear, w, h.low},
            parts.dark);
  if (!s.open_front) {
    WallHeights front = h;
    front.sill = std::min(h.sill, 1.25);
    draw_glazed_end(pen, {s.front, s.front, s.front - 0.04, s.front - 0.06}, w, front, parts);
  }
  if (!s.open_rear) {
    WallHeights rear = h;
    rear.sill = std::max(h.sill, 1.7);
    draw_glazed_end(pen, {s.rear, s.rear, s.rear, s.rear}, w, rear, parts);
    draw.box({s.rear, -0.9 * w, 0.45}, {s.rear + 0.03, 0.9 * w, 0.65}, parts.plate);
  }
  draw_inside(pen, s, floor, parts, rng);
  for (const double x : s.axles) {
    draw_axle(pen, {x, w - 0.02, s.radius, 0.28, x < s.front - 4 && !s.open_front}, parts);
  }
}

/// What stands on the roof: cooler, batteries, gas bottles.
void draw_roof(const Pen& pen, double from, double to, double half_width, double low, double high,
               const Parts& parts, core::Rng& rng) {
  if (high - low < 0.05) return;
  double x = from + rng.uniform(0.3, 2);
  while (x < to - 1) {
    const double end = std::min(to - 0.3, x + rng.uniform(1.2, 3.5));
    Pen(pen).box({x, -0.75 * half_width, low}, {end, 0.75 * half_width, high}, parts.second);
    x = end + rng.uniform(0.3, 3);
  }
}

void draw_city_bus(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const double top = shape.height - rng.uniform(0, 0.3);
  const double front = shape.length / 2;
  const bool joint = shape.kind == articulated_bus;
  Shell s{joint ? front - rng.uniform(9.6, 10.4) : -front,
          front,
          shape.width / 2,
          {0.28, rng.uniform(1.06, 1.15), top - rng.uniform(0.4, 0.55), top}};
  s.pane = rng.uniform(1.2, 1.8);
  s.axles = {front - 2.7, joint ? s.rear + 2.0 : s.rear + 3.3};
  s.doors = {front - 1.1, front - 6.1};
  s.open_rear = joint;
  draw_shell(pen, s, 0.38, parts, rng);
  draw_mirrors(pen, front - 0.05, s.half_width, 1.7, 2.2, parts);
  draw_roof(pen, s.rear, s.front, s.half_width, top, shape.height, parts, rng);
  if (!joint) return;
  Pen draw = pen;
  const double back = s.rear - 1.3;
  for (double x = back; x < s.rear - 0.05; x += 0.13) {  // bellows
    draw.box({x, -s.half_width + 0.05, 0.4}, {x + 0.06, s.half_width - 0.05, top - 0.08},
             parts.dark);
  }
  Shell second = s;
  second.front = back;
  second.rear = -front;
  second.axles = {-front + 3.3};
  second.doors = {back - 1.2};
  second.open_front = true;
  second.open_rear = false;
  draw_shell(pen, second, 0.38, parts, rng);
  draw_roof(pen, second.rear, second.front, s.half_width, top, shape.height, parts, rng);
}

void draw_coach(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const double front = shape.length / 2;
  Shell s{-front,
          front,
          shape.width / 2,
          {0.32, rng.uniform(1.75, 2.0), shape.height - rng.uniform(0.45, 0.65), shape.height}};
  s.pane = rng.uniform(1.5, 2.0);
  s.axles = {front - 2.8, -front + 3.2, -front + 1.85};
  s.doors = {front - 0.9};
  draw_shell(pen, s, 1.4, parts, rng);
  Pen draw = pen;
  for (double x = -front + 4.2; x < front - 4; x += 1.5) {  // flaps of the hold
    for (const double side : {-1.0, 1.0}) {
      const double y = side * s.half_width;
      draw.box({x, y - 0.006, 0.45}, {x + 1.42, y + 0.006, 1.3}, parts.second);
    }
  }
  draw_mirrors(pen, front + 0.0, s.half_width - 0.1, 1.9, 2.6, parts);
}

/// A cab like a van's or a lorry's and a room behind it.
void draw_nosed_bus(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const bool school = shape.kind == school_bus;
  CabShape cab;
  cab.front = shape.length / 2;
  cab.nose = school ? rng.uniform(1.2, 1.6) : rng.uniform(0.5, 0.9);
  cab.rake = school ? rng.uniform(0.1, 0.25) : rng.uniform(0.4, 0.7);
  cab.window = 0.75;
  cab.half_width = shape.width / 2 - (school ? 0 : 0.03);
  cab.nose_half_width = cab.half_width - (school ? 0.15 : 0.08);
  cab.low = school ? 0.5 : 0.3;
  cab.bonnet = school ? 1.35 : 1.0;
  cab.belt = school ? 1.6 : 1.2;
  cab.lintel = school ? 2.4 : std::min(2.05, shape.height - 0.4);
  cab.height = shape.height;
  cab.length = cab.nose + cab.rake + cab.window + 0.1;
  cab.back_wall = false;
  draw_cab(pen, cab, parts);
  const double floor = school ? 1.0 : 0.65;
  Shell s{-cab.front,
          cab.front - cab.length,
          shape.width / 2,
          {school ? 0.62 : 0.35, school ? 1.65 : rng.uniform(1.15, 1.3),
           school ? 2.35 : shape.height - rng.uniform(0.4, 0.8), shape.height}};
  s.pane = school ? 0.72 : rng.uniform(1.0, 1.5);
  s.radius = school ? 0.48 : 0.36;
  s.axles = {-cab.front + 0.26 * shape.length};
  s.doors = {s.front - 0.7};
  s.open_front = true;
  draw_shell(pen, s, floor, parts, rng);
  draw_axle(pen, {cab.front - (school ? 1.1 : 0.95), cab.half_width + 0.012, s.radius, 0.25, false},
            parts);
  if (!school) return;
  Pen draw = pen;
  for (const double side : {-1.0, 1.0}) {  // rub rails
    for (const double z : {0.95, 1.35, 1.62}) {
      const double y = side * s.half_width;
      draw.box({s.rear, y - 0.02, z}, {s.front, y + 0.02, z + 0.08}, parts.dark);
    }
  }
}

}  // namespace

void draw_bus(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  if (shape.kind == coach) return draw_coach(shape, parts, pen, rng);
  if (shape.kind == school_bus || shape.kind == minibus) {
    return draw_nosed_bus(shape, parts, pen, rng);
  }
  draw_city_bus(shape, parts, pen, rng);
}

}  // namespace saker::simulation
