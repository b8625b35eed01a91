#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/fleet.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

/// A cabin with four posts and glass all around.
void draw_cabin(const Pen& pen, double rear, double front, double right, double left, double low,
                double high, const Parts& parts) {
  Pen draw = pen;
  const WallHeights walls{low, low + 0.35 * (high - low), high - 0.12, high};
  for (const double y : {right, left}) {
    draw_glazed_side(pen, rear, front, y, walls, {{rear + 0.08, front - 0.08}}, parts);
  }
  const Pen middle = pen.at(0, (right + left) / 2, 0);
  const double w = (left - right) / 2;
  draw_glazed_end(middle, {front, front, front - 0.05, front - 0.05}, w, walls, parts);
  draw_glazed_end(middle, {rear, rear, rear, rear}, w, walls, parts);
  draw.box({rear, right, high - 0.06}, {front, left, high}, parts.paint);
  draw_seat(middle.at((rear + front) / 2 - 0.1, 0, low), 0.5, 1.2, parts.interior);
}

/// Tracks below an excavator, turned against its house.
void draw_tracks(const Pen& pen, double length, double half_width, double height,
                 const Parts& parts) {
  const double tread = std::min(0.6, 0.4 * half_width);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half_width - tread / 2);
    const double a = length / 2, h = height;
    draw_prism(
        pen,
        {{-a, 0.45 * h}, {-a + 0.3, 0}, {a - 0.3, 0}, {a, 0.45 * h}, {a - 0.2, h}, {-a + 0.2, h}},
        y - tread / 2, y + tread / 2, parts.dark);
  }
  Pen(pen).box({-0.25 * length, -half_width + tread, 0.4 * height},
               {0.25 * length, half_width - tread, height}, parts.dark);
}

void draw_excavator(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const double size = shape.width / 3.0;  // of a 20 t machine
  const double w = shape.width / 2;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double deck = 1.05 * size, turn = rear + 2.5 * size;
  const double track = std::min(4.0 * size, 2 * (turn - rear));
  const double angle = rng.chance(0.6) ? 0 : rng.uniform(-0.4, 0.4);
  draw_tracks(pen.at(turn, 0, 0, angle), angle == 0 ? track : 0.85 * track,
              angle == 0 ? w : 0.75 * w, 0.9 * size, parts);
  draw.box({rear, -w + 0.05, deck}, {rear + 1.2 * size, w - 0.05, deck + 1.1 * size}, parts.second);
  draw.box({rear + 1.2 * size, -w + 0.05, deck}, {turn + 1.2 * size, -0.1, deck + 0.9 * size},
           parts.paint);
  const double roof = std::max(deck + 1.2, std::min(shape.height, 3.05));
  draw_cabin(pen, turn - 0.6 * size, turn + 1.2 * size, std::max(0.1, w - 1.1), w - 0.05, deck,
             std::min(roof, shape.height), parts);
  const Eigen::Vector3d foot(turn + 0.4 * size, -0.15, deck + 0.7 * size);
  const Eigen::Vector3d elbow(turn + 0.55 * (tip - turn), -0.15, shape.height - 0.2);
  const Eigen::Vector3d wrist(tip - 0.42 * size, -0.15, rng.uniform(0.7, 1.2) * size);
  const Eigen::Vector3d knee = 0.5 * (foot + elbow) + Eigen::Vector3d(-0.1, 0, 0.2 * size);
  draw.tube({foot, knee, elbow}, {0.2 * size, 0.25 * size, 0.16 * size}, 4, parts.paint);
  draw.tube({elbow, wrist}, {0.2 * size, 0.13 * size}, 4, parts.paint);
  draw_bar(pen, foot + Eigen::Vector3d(0.5, 0, -0.1), knee, 0.12 * size + 0.04, parts.chrome);
  draw_prism(pen,
             {{wrist.x() - 0.4 * size, 0.02},
              {wrist.x() + 0.3 * size, 0.15},
              {wrist.x() + 0.4 * size, wrist.z()},
              {wrist.x() - 0.2 * size, wrist.z()}},
             -0.15 - 0.5 * size, -0.15 + 0.5 * size, parts.dark);
}

void draw_wheel_loader(const FleetShape& shape, const Parts& parts, const Pen& pen,
                       core::Rng& rng) {
  Pen draw = pen;
  const double w = shape.width / 2;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double size = shape.width / 2.9;
  const double r = 0.75 * size + 0.03;
  const double back_axle = rear + 0.24 * shape.length, front_axle = back_axle + 0.4 * shape.length;
  for (const double x : {back_axle, front_axle}) {
    draw_axle(pen, {x, w - 0.1, r, 0.55 * size, false}, parts);
  }
  const double deck = 1.3 * r, hood = deck + 0.95 * size;
  draw_prism(pen,
             {{rear, deck - 0.4 * size},
              {rear + 0.15, hood},
              {back_axle + 0.5 * size, hood},
              {back_axle + 0.9 * size, deck - 0.4 * size}},
             -0.5 * w, 0.5 * w, parts.paint);
  draw.box({back_axle - 0.5 * size, -0.4 * w, 0.8 * r}, {front_axle + 0.6 * size, 0.4 * w, deck},
           parts.paint);
  for (const double side : {-1.0, 1.0}) {  // mudguards
    draw.box({back_axle - r, side * (w - 0.35 * size) - 0.2 * size, 2 * r},
             {back_axle + r, side * (w - 0.35 * size) + 0.2 * size, 2 * r + 0.06}, parts.paint);
  }
  const double cabin = back_axle + 0.6 * size;
  draw_cabin(pen, cabin, cabin + 1.4 * size, -0.5 * w, 0.5 * w, deck, shape.height, parts);
  const double lift = rng.uniform(0.1, 0.8) * size;
  for (const double side : {-0.3, 0.3}) {
    draw.tube({{front_axle - 0.2, side * w, 1.9 * r},
               {front_axle + 0.9 * size, side * w, 1.5 * r + lift},
               {tip - 1.0 * size, side * w, 0.4 + lift}},
              {0.15 * size, 0.17 * size, 0.12 * size}, 4, parts.paint);
  }
  draw_prism(pen,
             {{tip - 1.1 * size, 0.1 + lift},
              {tip, 0.05 + lift},
              {tip - 0.7 * size, 0.9 * size + lift},
              {tip - 1.0 * size, 0.9 * size + lift}},
             -w, w, parts.dark);
}

void draw_roller(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng&) {
  Pen draw = pen;
  const double w = shape.width / 2;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double r = 0.75;
  draw.tube({{tip - r, -w + 0.1, r}, {tip - r, w - 0.1, r}}, {r, r}, 22, parts.chrome);
  for (const double side : {-1.0, 1.0}) {
    draw.box({tip - 2.1 * r, side * (w - 0.05) - 0.05, 0.5},
             {tip - 0.5, side * (w - 0.05) + 0.05, 1.0}, parts.paint);
  }
  draw.box({tip - 2.3 * r, -w, 0.6}, {tip - 2.05 * r, w, 1.1}, parts.paint);
  draw_axle(pen, {rear + 1.3, w - 0.08, r, 0.5, false}, parts);
  draw_prism(pen, {{rear, 0.7}, {rear + 0.1, 1.6}, {rear + 1.6, 1.75}, {rear + 1.8, 0.6}},
             -0.45 * w, 0.45 * w, parts.paint);
  draw.box({rear + 1.6, -0.4 * w, 0.6}, {tip - 2.2 * r, 0.4 * w, 1.2}, parts.paint);
  draw_cabin(pen, rear + 1.65, rear + 2.95, -0.6 * w, 0.6 * w, 1.2, shape.height, parts);
}

void draw_forklift(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const double w = shape.width / 2;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double mast = tip - 1.15;
  draw_prism(pen,
             {{rear, 0.2}, {rear, 1.0}, {rear + 0.4, 1.1}, {rear + 1.0, 1.1}, {rear + 1.1, 0.2}},
             -w, w, parts.paint);
  draw.box({rear + 1.1, -w + 0.05, 0.25}, {mast - 0.15, w - 0.05, 0.6}, parts.paint);
  draw.box({mast - 0.45, -w + 0.1, 0.6}, {mast - 0.25, w - 0.1, 1.15}, parts.paint);
  draw_axle(pen, {mast - 0.35, w, 0.32, 0.22, false}, parts);
  draw_axle(pen, {rear + 0.5, w - 0.02, 0.26, 0.18, false}, parts);
  draw_seat(pen.at(rear + 0.85, 0, 0.75), 0.5, 1.0, parts.interior);
  if (rng.chance(0.6)) draw.ellipsoid({rear + 0.9, 0, 1.5}, {0.16, 0.24, 0.4}, parts.interior);
  const double roof = shape.height - 0.02;
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (w - 0.06);
    draw_bar(pen, {rear + 0.3, y, 1.05}, {rear + 0.5, y, roof}, 0.07, parts.dark);
    draw_bar(pen, {mast - 0.25, y, 0.6}, {mast - 0.6, y, roof}, 0.07, parts.dark);
    draw.box({mast - 0.1, side * 0.3 - 0.05, 0.1}, {mast, side * 0.3 + 0.05, roof}, parts.dark);
    draw.box({mast, side * 0.25 - 0.06, 0.12}, {tip, side * 0.25 + 0.06, 0.17}, parts.dark);
  }
  for (double x = rear + 0.5; x < mast - 0.6; x += 0.18) {
    draw.box({x, -w + 0.06, roof - 0.02}, {x + 0.05, w - 0.06, roof + 0.02}, parts.dark);
  }
  draw.box({mast, -0.45, 0.2}, {mast + 0.05, 0.45, 0.7}, parts.dark);
  if (rng.chance(0.4)) {
    draw.box({mast + 0.1, -0.4, 0.18}, {tip, 0.4, rng.uniform(0.4, 1.5)}, parts.second);
  }
}

/// A bar to the towing car, with a wheel under it.
void draw_drawbar(const Pen& pen, double body, double tip, double z, const Parts& parts) {
  for (const double y : {-0.5, 0.5}) {
    draw_bar(pen, {body, y, z}, {tip, 0, z}, 0.08, parts.dark);
  }
  draw_bar(pen, {tip - 0.2, 0.1, z}, {tip - 0.2, 0.1, 0.02}, 0.06, parts.dark);
}

void draw_small_trailer(const FleetShape& shape, const Parts& parts, const Pen& pen,
                        core::Rng& rng) {
  Pen draw = pen;
  const double w = shape.width / 2;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double body = tip - 0.28 * shape.length;
  const double r = rng.uniform(0.26, 0.33);
  const bool tandem = shape.length > 3.8;
  const double axle = (rear + body) / 2;
  for (int k = 0; k < (tandem ? 2 : 1); ++k) {
    draw_axle(pen, {axle + (tandem ? (k - 0.5) * 0.7 : 0), w, r, 0.17, false}, parts);
  }
  const double inner = w - 0.22, floor = 2 * r - 0.05;
  draw_drawbar(pen, body, tip, floor - 0.1, parts);
  draw.box({rear, -inner, floor - 0.05}, {body, inner, floor}, parts.second);
  if (shape.height > 1.4) {
    draw.box({rear, -inner, floor}, {body, inner, shape.height}, parts.second);
  } else {
    for (const double y : {-inner, inner - 0.03}) {
      draw.box({rear, y, floor}, {body, y + 0.03, shape.height}, parts.second);
    }
    draw.box({rear, -inner, floor}, {rear + 0.03, inner, shape.height}, parts.second);
    draw.box({body - 0.03, -inner, floor}, {body, inner, shape.height}, parts.second);
    if (rng.chance(0.4)) {
      draw.box({rear + 0.2, -0.6 * inner, floor}, {body - 0.4, 0.5 * inner, shape.height - 0.05},
               parts.dark);
    }
  }
}

void draw_caravan(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng&) {
  Pen draw = pen;
  const double w = shape.width / 2, h = shape.height;
  const double rear = -shape.length / 2, tip = shape.length / 2;
  const double body = tip - 1.25;
  const WallHeights walls{0.4, 1.2, 1.85, h - 0.25};
  const double mid = (rear + body) / 2;
  for (const double side : {-1.0, 1.0}) {
    draw_glazed_side(pen, rear + 0.1, body - 0.2, side * w, walls,
                     {{rear + 0.5, rear + 1.5}, {mid, mid + 0.7}, {body - 1.5, body - 0.5}}, parts);
  }
  const auto across = [&](double xa, double za, double xb, double zb, MaterialId m) {
    draw.quad({xa, -w, za}, {xa, w, za}, {xb, w, zb}, {xb, -w, zb}, m);
  };
  across(rear + 0.1, walls.top, rear + 0.25, h, parts.paint);
  across(rear + 0.25, h, body - 0.5, h, parts.paint);
  across(body - 0.5, h, body - 0.2, walls.top, parts.paint);
  draw_glazed_end(pen, {rear, rear, rear + 0.05, rear + 0.1}, w, walls, parts);
  draw_glazed_end(pen, {body, body, body - 0.12, body - 0.2}, w, walls, parts);
  draw.box({rear + 0.1, -w, 0.38}, {body - 0.1, w, 0.42}, parts.dark);
  draw.box({rear + 0.4, -w + 0.1, 0.42}, {rear + 1.9, w - 0.8, 0.85}, parts.interior);
  draw.box({mid, -w + 0.05, 0.42}, {mid + 0.9, -w + 0.65, 1.3}, parts.interior);
  draw.box({body + 0.0, -0.6, 0.4}, {body + 0.45, 0.6, 0.85}, parts.paint);
  draw_drawbar(pen, body, tip, 0.42, parts);
  draw_axle(pen, {mid, w - 0.08, 0.32, 0.18, false}, parts);
}

}  // namespace

void draw_machine(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  if (shape.kind == excavator) return draw_excavator(shape, parts, pen, rng);
  if (shape.kind == wheel_loader) return draw_wheel_loader(shape, parts, pen, rng);
  if (shape.kind == roller) return draw_roller(shape, parts, pen, rng);
  draw_forklift(shape, parts, pen, rng);
}

void draw_trailer(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng) {
  if (shape.kind == caravan) return draw_caravan(shape, parts, pen, rng);
  draw_small_trailer(shape, parts, pen, rng);
}

}  // namespace saker::simulation
