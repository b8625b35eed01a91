#include "saker/simulation/world/truck_bodies.h"

#include <algorithm>
#include <cmath>

namespace saker::simulation {
namespace {

/// Walls, roof and floor of a box whose rear door is rolled up.
void draw_open_box(const Pen& pen, const BodyRoom& r, const Parts& parts) {
  Pen draw = pen;
  const double w = r.half_width;
  for (const double y : {-w, w - 0.04}) {
    draw.box({r.rear, y, r.floor}, {r.front, y + 0.04, r.top}, parts.second);
  }
  draw.box({r.rear, -w, r.floor}, {r.front, w, r.floor + 0.1}, parts.second);
  draw.box({r.rear, -w, r.top - 0.06}, {r.front, w, r.top}, parts.second);
  draw.box({r.front - 0.05, -w, r.floor}, {r.front, w, r.top}, parts.second);
}

/// Edges, hinges and bars that stand out from the walls.
void draw_box_trim(const Pen& pen, const BodyRoom& r, const Parts& parts) {
  Pen draw = pen;
  const double w = r.half_width;
  for (const double side : {-1.0, 1.0}) {
    const double y = side * w;
    draw.box({r.rear, y - 0.012, r.floor}, {r.front, y + 0.012, r.floor + 0.12}, parts.chrome);
    draw.box({r.rear, y - 0.012, r.top - 0.1}, {r.front, y + 0.012, r.top}, parts.chrome);
    for (const double x : {r.rear, r.front - 0.08}) {
      draw.box({x, y - 0.015, r.floor}, {x + 0.08, y + 0.015, r.top}, parts.chrome);
    }
    for (const double share : {0.25, 0.75}) {
      draw_bar(pen, {r.rear - 0.02, side * share * w, r.floor + 0.1},
               {r.rear - 0.02, side * share * w, r.top - 0.1}, 0.04, parts.chrome);
    }
  }
}

/// Pallets, pipes or boards on a floor.
void draw_cargo(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double kind = rng.uniform();
  const double length = r.front - r.rear - 0.3;
  if (kind < 0.35) return;
  if (kind < 0.65) {
    for (double x = r.rear + 0.2; x + 1.2 < r.front; x += 1.3) {
      for (const double y : {-1.05, 0.1}) {
        if (rng.chance(0.3)) continue;
        const double top = std::min(r.floor + rng.uniform(0.3, 1.6), r.top - 0.05);
        draw.box({x, y, r.floor}, {x + 1.2, y + 0.9, top}, parts.second);
      }
    }
    return;
  }
  const double radius = kind < 0.8 ? rng.uniform(0.05, 0.25) : rng.uniform(0.1, 0.2);
  const int rows = 1 + rng.index(3);
  for (int k = 0; k < rows; ++k) {
    for (double y = -0.95 + radius; y < 0.95; y += 2.1 * radius) {
      const double z = r.floor + radius + 2 * radius * k;
      if (z + radius > r.top) return;
      draw.tube({{r.rear + 0.1, y, z}, {r.rear + 0.1 + length, y, z}}, {radius, radius}, 7,
                parts.second);
    }
  }
}

}  // namespace

void draw_box_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const BodyRoom r{room.rear + 0.05, room.front, room.half_width, room.floor, room.top};
  if (rng.chance(0.12)) {
    draw_open_box(pen, r, parts);
  } else {
    draw.box({r.rear, -r.half_width, r.floor}, {r.front, r.half_width, r.top}, parts.second);
  }
  draw_box_trim(pen, r, parts);
  if (rng.chance(0.3)) {  // a lift, folded up
    draw.box({r.rear - 0.05, -0.9 * r.half_width, r.floor},
             {r.rear - 0.02, 0.9 * r.half_width, r.floor + 1.4}, parts.chrome);
  }
  if (rng.chance(0.25) && r.top > 3.2) {  // a cooler over the cab
    draw.box({r.front, -0.8, r.top - 0.7}, {r.front + 0.4, 0.8, r.top - 0.05}, parts.chrome);
  }
}

void draw_flat_body(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double w = r.half_width;
  draw.box({r.rear, -w, r.floor}, {r.front, w, r.floor + 0.12}, parts.second);
  const double board = std::min(r.floor + rng.uniform(0.6, 1.4), r.top);
  draw.box({r.front - 0.06, -w, r.floor}, {r.front, w, board}, parts.second);
  const BodyRoom inside{r.rear, r.front, w, r.floor + 0.12, r.top};
  if (rng.chance(0.55)) {  // drop sides
    const double top = r.floor + rng.uniform(0.35, 0.65);
    for (const double y : {-w, w - 0.03}) {
      draw.box({r.rear, y, r.floor}, {r.front, y + 0.03, top}, parts.second);
    }
    draw.box({r.rear, -w, r.floor}, {r.rear + 0.03, w, top}, parts.second);
  }
  if (rng.chance(0.25)) {  // a crane, folded behind the cab
    const double top = r.top - 0.1;
    draw.box({r.front - 0.6, -0.3, r.floor}, {r.front - 0.2, 0.3, top}, parts.paint);
    draw_bar(pen, {r.front - 0.4, -0.9, top}, {r.front - 0.4, 0.9, top - 0.1}, 0.18, parts.paint);
  }
  draw_cargo(pen, inside, parts, rng);
}

void draw_tipper_body(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double w = r.half_width;
  const double rim = r.floor + rng.uniform(0.9, 1.35);
  const double inner = w - 0.25;
  draw.box({r.rear + 0.3, -inner, r.floor}, {r.front, inner, r.floor + 0.1}, parts.second);
  for (const double side : {-1.0, 1.0}) {
    draw.quad({r.rear + 0.3, side * inner, r.floor}, {r.front, side * inner, r.floor},
              {r.front, side * w, rim}, {r.rear, side * w, rim}, parts.second);
    draw.box({r.rear, side * w - 0.04, rim - 0.15}, {r.front, side * w + 0.0, rim}, parts.second);
    for (double x = r.rear + 0.8; x < r.front; x += 0.8) {
      draw_bar(pen, {x, side * (inner + 0.05), r.floor}, {x, side * (w - 0.02), rim}, 0.1,
               parts.second);
    }
  }
  draw.quad({r.rear + 0.3, -inner, r.floor}, {r.rear + 0.3, inner, r.floor}, {r.rear, w, rim},
            {r.rear, -w, rim}, parts.second);
  draw.box({r.front - 0.08, -w, r.floor}, {r.front, w, r.top - 0.02}, parts.second);
  draw.box({r.front - 0.08, -w, r.top - 0.08}, {r.front + 0.7, w, r.top}, parts.second);
  if (rng.chance(0.5)) {
    draw.ellipsoid({(r.rear + r.front) / 2, 0, r.floor + 0.5},
                   {(r.front - r.rear) / 2 - 0.4, inner, rim - r.floor - 0.3}, parts.dark);
  }
}

void draw_refuse_body(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double w = r.half_width;
  const double tail = r.rear + rng.uniform(1.4, 1.9);
  draw.box({tail, -w, r.floor}, {r.front, w, r.top}, parts.second);
  for (double x = tail + 0.5; x < r.front; x += rng.uniform(0.7, 0.9)) {
    for (const double side : {-1.0, 1.0}) {
      draw.box({x, side * w - 0.04, r.floor}, {x + 0.1, side * w + 0.0, r.top}, parts.paint);
    }
  }
  draw_prism(pen,
             {{tail, r.floor - 0.3},
              {tail, r.top - 0.1},
              {tail - 0.7, r.top - 0.15},
              {r.rear + 0.05, r.floor + 0.9}},
             -w, w, parts.second);
  for (const double side : {-1.0, 1.0}) {  // cheeks beside the mouth
    draw_prism(pen,
               {{tail, r.floor - 0.3},
                {r.rear + 0.05, r.floor + 0.9},
                {r.rear + 0.02, r.floor},
                {r.rear + 0.6, r.floor - 0.35}},
               side * w - 0.06, side * w, parts.paint);
  }
}

void draw_mixer_body(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng&) {
  Pen draw = pen;
  const double length = r.front - r.rear - 0.9;
  const double wide = std::min(1.15, (r.top - r.floor) / 2 - 0.05);
  const double rise = 0.12 * length;
  std::vector<Eigen::Vector3d> axis;
  std::vector<double> radii;
  constexpr std::array<double, 6> kAlong = {0, 0.12, 0.35, 0.6, 0.85, 1};
  constexpr std::array<double, 6> kRadius = {0.55, 0.85, 1, 0.97, 0.6, 0.4};
  for (std::size_t i = 0; i < kAlong.size(); ++i) {
    const double x = r.front - 0.15 - kAlong[i] * length;
    const double z = r.top - wide - 0.02 + rise * (kAlong[i] - 0.6);
    axis.emplace_back(x, 0, std::min(z, r.top - wide * kRadius[i] - 0.02));
    radii.push_back(wide * kRadius[i]);
  }
  draw.tube(axis, radii, 18, parts.second);
  const double end = axis.back().x();
  draw.box({r.rear, -0.5, r.floor - 0.1}, {end + 0.4, 0.5, r.floor + 0.15}, parts.dark);
  for (const double side : {-1.0, 1.0}) {
    draw_bar(pen, {end, side * 0.6, r.floor}, {end, side * 0.5, r.top - 0.1}, 0.12, parts.paint);
    draw_bar(pen, {r.front - 0.1, side * 0.6, r.floor}, {r.front - 0.1, side * 0.5, r.floor + 0.9},
             0.15, parts.paint);
  }
  draw_prism(pen,
             {{end - 0.5, r.top}, {end + 0.3, r.top}, {end, r.top - 0.6}, {end - 0.2, r.top - 0.6}},
             -0.5, 0.5, parts.second);
  draw.quad({end - 0.1, -0.25, r.top - 0.9}, {end - 0.1, 0.25, r.top - 0.9},
            {r.rear + 0.05, 0.25, r.floor + 0.1}, {r.rear + 0.05, -0.25, r.floor + 0.1},
            parts.second);
}

void draw_semi_body(const Pen& pen, const BodyRoom& r, const Parts& parts, core::Rng& rng) {
  Pen draw = pen;
  const double fate = rng.uniform();
  if (fate < 0.6) return draw_box_body(pen, r, parts, rng);
  if (fate < 0.75) {  // a container
    const double length = std::min(rng.chance(0.7) ? 12.19 : 6.06, r.front - r.rear - 0.3);
    draw.box({r.front - length, -1.22, r.floor}, {r.front, 1.22, r.top - 0.05}, parts.second);
    for (double x = r.front - length + 0.2; x < r.front; x += 0.28) {
      for (const double y : {-1.22, 1.22}) {
        draw.box({x, y - 0.02, r.floor + 0.15}, {x + 0.1, y + 0.02, r.top - 0.15}, parts.second);
      }
    }
    draw.box({r.rear, -1.2, 1.0}, {r.rear + 0.3, 1.2, 1.2}, parts.dark);
    return;
  }
  if (fate < 0.88) {  // a tank
    const double radius = std::min(1.15, (r.top - r.floor) / 2);
    const double z = r.floor + radius + 0.05;
    draw.tube({{r.rear + 0.05, 0, z}, {r.rear + 0.4, 0, z}, {r.front - 0.4, 0, z}, {r.front, 0, z}},
              {0.75 * radius, radius, radius, 0.75 * radius}, 20, parts.second);
    draw.box({r.rear + 1, -0.3, z + radius - 0.05}, {r.front - 1, 0.3, z + radius + 0.05},
             parts.chrome);
    return;
  }
  draw_flat_body(pen, r, parts, rng);
}

}  // namespace saker::simulation
