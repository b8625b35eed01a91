#include <algorithm>
#include <cmath>

#include "saker/simulation/world/fleet.h"
#include "saker/simulation/world/truck_bodies.h"
#include "saker/simulation/world/vehicle_cab.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

CabShape cab_over(const FleetShape& shape, double top, core::Rng& rng) {
  CabShape cab;
  cab.front = shape.length / 2;
  cab.length = rng.chance(0.4) && top > 2.9 ? rng.uniform(2.1, 2.3) : rng.uniform(1.65, 1.9);
  cab.half_width = shape.width / 2 - rng.uniform(0.02, 0.12);
  cab.nose_half_width = cab.half_width;
  cab.rake = rng.uniform(0.08, 0.25);
  cab.window = rng.uniform(0.75, 0.95);
  cab.low = rng.uniform(0.3, 0.5);
  cab.belt = std::clamp(0.53 * top, 1.3, 1.9) + rng.uniform(-0.05, 0.05);
  cab.bonnet = cab.belt - 0.1;
  cab.lintel = std::min(cab.belt + rng.uniform(0.75, 0.9), top - 0.15);
  cab.height = top;
  return cab;
}

CabShape van_cab(const FleetShape& shape, core::Rng& rng) {
  CabShape cab;
  cab.front = shape.length / 2;
  cab.nose = rng.uniform(0.6, 1.0);
  cab.rake = rng.uniform(0.5, 0.8);
  cab.window = rng.uniform(0.6, 0.8);
  cab.length = cab.nose + cab.rake + cab.window + 0.15;
  cab.half_width = std::min(1.02, shape.width / 2 - 0.05);
  cab.nose_half_width = cab.half_width - 0.08;
  cab.low = 0.25;
  cab.bonnet = rng.uniform(0.95, 1.1);
  cab.belt = cab.bonnet + 0.2;
  cab.lintel = rng.uniform(1.95, 2.1);
  cab.height = cab.lintel + rng.uniform(0.1, 0.25);
  return cab;
}

CabShape long_nose_cab(const FleetShape& shape, core::Rng& rng) {
  CabShape cab;
  cab.front = shape.length / 2;
  cab.nose = rng.uniform(1.5, 1.9);
  cab.rake = rng.uniform(0.25, 0.5);
  cab.window = rng.uniform(0.75, 0.9);
  cab.length = cab.nose + cab.rake + cab.window + (rng.chance(0.6) ? rng.uniform(1.2, 1.8) : 0.2);
  cab.half_width = shape.width / 2 - 0.08;
  cab.nose_half_width = cab.half_width - rng.uniform(0.1, 0.25);
  cab.bonnet = rng.uniform(1.35, 1.5);
  cab.belt = cab.bonnet + 0.3;
  cab.lintel = cab.belt + 0.7;
  cab.height = rng.uniform(3.0, 3.7);
  return cab;
}

/// Chassis and wheels under cab and body. \return where the body begins.
struct Chassis {
  double body_front, rear, top, half_width;
};

Chassis draw_chassis(const FleetShape& shape, const CabShape& cab, double gap, const Parts& parts,
                     const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const bool light = shape.length < 7.4 && shape.kind <= box_van;
  const double r = light ? rng.uniform(0.34, 0.38) : shape.length < 8 ? 0.43 : 0.5;
  const double rear = -shape.length / 2;
  const double top = 2 * r + (light ? 0.05 : -0.04);
  const Chassis chassis{cab.front - cab.length - gap, rear, top, shape.width / 2};
  draw_ladder_frame(pen, rear + 0.1, cab.front - 0.6, top, parts);
  const double front_axle =
      cab.nose > 0.3 ? cab.front - 0.5 * cab.nose - 0.45 : cab.front - rng.uniform(1.2, 1.4);
  const double track = cab.half_width + 0.015;  // the tyres stand out from the cab's sides
  draw_axle(pen, {front_axle, track, r, light ? 0.22 : 0.3, false}, parts);
  const double last = rear + rng.uniform(0.2, 0.27) * shape.length;
  const bool tandem = shape.length > 8 && (shape.kind != box_truck || rng.chance(0.3));
  for (int k = 0; k < (tandem ? 2 : 1); ++k) {
    draw_axle(pen,
              {last + k * (2 * r + 0.25), chassis.half_width - 0.04, r, light ? 0.2 : 0.27, true},
              parts);
  }
  const double tank = front_axle - r - 0.3;
  if (!light) {  // fuel and air tanks
    draw.tube({{tank, 0.9, 0.75}, {tank - rng.uniform(0.6, 1.2), 0.9, 0.75}}, {0.28, 0.28}, 12,
              rng.chance(0.5) ? parts.chrome : parts.dark);
    draw.box({tank - 0.8, -1.1, 0.5}, {tank, -0.65, 0.95}, parts.dark);
  }
  draw_guards(pen, rear, last + 2.2 * r + (tandem ? 2 * r + 0.2 : 0), tank - 1.3,
              chassis.half_width, parts);
  return chassis;
}

void draw_step_van(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  CabShape cab;
  cab.front = shape.length / 2;
  cab.length = shape.length - 0.05;
  cab.half_width = shape.width / 2;
  cab.nose = rng.uniform(0.4, 0.8);
  cab.nose_half_width = cab.half_width - 0.15;
  cab.rake = rng.uniform(0.2, 0.45);
  cab.window = rng.uniform(0.6, 0.9);
  cab.low = 0.5;
  cab.bonnet = rng.uniform(1.0, 1.2);
  cab.belt = cab.bonnet + 0.15;
  cab.lintel = cab.belt + 0.95;
  cab.height = shape.height;
  draw_cab(pen, cab, parts);
  const double wall = cab.front - cab.nose - cab.rake - cab.window - 0.4;  // to the parcels
  draw.quad({wall, -cab.half_width, 0.6}, {wall, cab.half_width, 0.6},
            {wall, cab.half_width, shape.height}, {wall, -cab.half_width, shape.height},
            parts.interior);
  const double rear = -shape.length / 2;
  const double r = 0.4;
  draw_axle(pen, {cab.front - 0.95, cab.half_width + 0.012, r, 0.22, false}, parts);
  draw_axle(pen, {rear + 0.27 * shape.length, cab.half_width + 0.012, r, 0.22, true}, parts);
  draw_ladder_frame(pen, rear + 0.1, cab.front - 0.4, 0.75, parts);
  draw.box({rear, -0.9 * cab.half_width, 0.45}, {rear + 0.06, 0.9 * cab.half_width, 0.65},
           parts.dark);
}

struct Tractor {
  double back, length;  ///< x of the cab's back wall and how far its frame goes behind the front
};

Tractor draw_tractor(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const bool nose = shape.kind == long_nose_semi;
  const CabShape cab =
      nose ? long_nose_cab(shape, rng) : cab_over(shape, rng.uniform(3.2, shape.height - 0.1), rng);
  draw_cab(pen, cab, parts);
  const double length = nose ? cab.length + 3.0 : rng.uniform(5.8, 6.1);
  draw_ladder_frame(pen, cab.front - length, cab.front - 0.6, 0.95, parts);
  draw_axle(pen, {cab.front - (nose ? 1.2 : 1.4), cab.half_width + 0.015, 0.5, 0.32, false}, parts);
  for (int k = 0; k < (nose ? 2 : 1); ++k) {
    draw_axle(pen, {cab.front - length + 0.75 + 1.3 * k, shape.width / 2 - 0.03, 0.5, 0.27, true},
              parts);
  }
  Pen draw = pen;
  for (const double side : {-1.0, 1.0}) {
    const double x = cab.front - cab.length;
    const double y = side * (cab.half_width - 0.3);
    draw.tube({{x + 0.3, y, 0.75}, {x + 1.4, y, 0.75}}, {0.3, 0.3}, 12, parts.chrome);
    if (nose)
      draw.tube({{x - 0.15, y, 1.0}, {x - 0.15, y, cab.height}}, {0.09, 0.09}, 8, parts.chrome);
  }
  if (!nose && rng.chance(0.6)) {  // what leads the wind over the trailer
    draw_prism(pen,
               {{cab.front - 0.7, cab.height},
                {cab.front - cab.length, cab.height},
                {cab.front - cab.length, shape.height - 0.02}},
               -0.9 * cab.half_width, 0.9 * cab.half_width, parts.paint);
  }
  return {cab.front - cab.length, length};
}

void draw_semi(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const Tractor tractor = draw_tractor(shape, parts, pen, rng);
  const double rear = -shape.length / 2;
  const double front = tractor.back - rng.uniform(0.5, 0.9);
  const double w = shape.width / 2;
  draw_ladder_frame(pen, rear + 0.1, front - 0.1, 1.2, parts);
  for (const double side : {-1.0, 1.0}) {  // landing legs
    const double x = front - 3.6;
    draw.box({x - 0.08, side * 0.75 - 0.07, 0.25}, {x + 0.08, side * 0.75 + 0.07, 1.1}, parts.dark);
  }
  const bool nose = shape.kind == long_nose_semi;
  for (int k = 0; k < (nose ? 2 : 3); ++k) {
    draw_axle(pen, {rear + (nose ? 1.3 : 2.3) + 1.31 * k, w - 0.03, 0.5, nose ? 0.27 : 0.38, nose},
              parts);
  }
  draw_guards(pen, rear, rear + 6, front - 4.2, w, parts);
  const BodyRoom room{rear, front, w, 1.2, shape.height};
  draw_semi_body(pen, room, parts, rng);
}

/// A lorry with one of the bodies.
template <class DrawBody>
void draw_rigid(const FleetShape& shape, double cab_top, const Parts& parts, const Pen& pen,
                core::Rng& rng, DrawBody draw_body) {
  const CabShape cab = cab_over(shape, cab_top, rng);
  draw_cab(pen, cab, parts);
  const double gap = rng.uniform(0.14, 0.4);
  const Chassis c = draw_chassis(shape, cab, gap, parts, pen, rng);
  draw_body(pen, BodyRoom{c.rear, c.body_front, c.half_width, c.top + 0.06, shape.height}, parts,
            rng);
}

void draw_box_van(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const CabShape cab = van_cab(shape, rng);
  draw_cab(pen, cab, parts);
  const Chassis c = draw_chassis(shape, cab, rng.uniform(0.05, 0.12), parts, pen, rng);
  draw_box_body(pen, {c.rear, c.body_front, c.half_width, c.top + 0.06, shape.height}, parts, rng);
  if (!rng.chance(0.4)) return;  // a part of the box above the cab
  Pen(pen).box({c.body_front, -c.half_width, cab.height + 0.05},
               {c.body_front + 0.8, c.half_width, shape.height}, parts.second);
}

}  // namespace

void draw_truck(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  const double h = shape.height;
  switch (shape.kind) {
    case step_van:
      return draw_step_van(shape, parts, pen, rng);
    case box_van:
      return draw_box_van(shape, parts, pen, rng);
    case flatbed_truck:
      return draw_rigid(shape, h, parts, pen, rng, draw_flat_body);
    case tipper_truck:
      return draw_rigid(shape, h - 0.12, parts, pen, rng, draw_tipper_body);
    case refuse_truck:
      return draw_rigid(shape, rng.uniform(2.7, h - 0.3), parts, pen, rng, draw_refuse_body);
    case mixer_truck:
      return draw_rigid(shape, rng.uniform(2.8, 3.1), parts, pen, rng, draw_mixer_body);
    case semi_trailer:
    case long_nose_semi:
      return draw_semi(shape, parts, pen, rng);
    default:
      return draw_rigid(shape, rng.uniform(2.3, 2.9), parts, pen, rng, draw_box_body);
  }
}

}  // namespace saker::simulation
