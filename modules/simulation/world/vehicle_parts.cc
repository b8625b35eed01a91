#include "saker/simulation/world/vehicle_parts.h"

#include <algorithm>
#include <cmath>

namespace saker::simulation {
namespace {

/// What boxes and tarpaulins are made of: brighter and duller than a cab's paint.
Material any_cover(std::uint16_t label, core::Rng& rng) {
  const double bright = rng.chance(0.55) ? rng.uniform(0.4, 0.85) : rng.uniform(0.05, 0.45);
  return {label, static_cast<float>(bright), 0.08F, static_cast<float>(rng.uniform(0, 0.5)), 0, 0};
}

float any(core::Rng& rng, double low, double high) {
  return static_cast<float>(rng.uniform(low, high));
}

/// Clean glass mirrors nearly all; what is tinted and dusty answers like dark paint.
Material any_glass(std::uint16_t label, core::Rng& rng) {
  if (rng.chance(0.5)) return {label, 0.05F, 0.03F, 0.998F, any(rng, 0.02, 0.4), 0};
  return {label, any(rng, 0.03, 0.15), 0.04F, any(rng, 0.4, 0.97), any(rng, 0, 0.3), 0};
}

}  // namespace

Material any_paint(std::uint16_t label, double dullest, core::Rng& rng) {
  const double tone = rng.uniform();
  const double bright = 0.02 + 0.75 * tone * tone * tone + 0.1 * rng.uniform();
  const double gloss = rng.chance(0.25) ? rng.uniform(0.8, 0.97) : rng.uniform(dullest, 0.8);
  return {label, static_cast<float>(bright), 0.08F, static_cast<float>(gloss), 0, 0};
}

Parts make_parts(World& world, const Palette& palette, std::uint16_t label, core::Rng& rng) {
  Parts parts;
  parts.label = label;
  Material paint = any_paint(label, 0.2, rng);
  if (palette.paint == Paint::black) paint.reflectivity = any(rng, 0.02, 0.05);
  parts.paint = world.add(paint);
  parts.second = world.add(any_cover(label, rng));
  parts.glass = world.add(any_glass(label, rng));
  parts.interior = world.add({label, any(rng, 0.05, 0.3), 0.1F, 0, 0, 0});
  parts.rubber = world.add({label, any(rng, 0.04, 0.1), 0.04F, 0, 0, 0});
  parts.rim = world.add({label, any(rng, 0.1, 0.5), 0.2F, 0.5F, 0.15F, 0});
  parts.plate = world.add({label, 0.9F, 0.1F, 0, 0, 0});
  parts.dark = world.add({label, any(rng, 0.03, 0.12), 0.04F, 0.2F, 0, 0});
  parts.chrome = world.add({label, any(rng, 0.4, 0.7), 0.2F, 0.9F, 0, 0});
  return parts;
}

Palette with_parts(const Palette& palette, const Parts& parts) {
  Palette own = palette;
  own.interior = parts.interior;
  own.rubber = parts.rubber;
  own.rim = parts.rim;
  own.plate = parts.plate;
  own.dark = parts.dark;
  return own;
}

void draw_prism(const Pen& pen, const std::vector<Eigen::Vector2d>& outline, double low,
                double high, MaterialId material) {
  Pen draw = pen;
  std::vector<Eigen::Vector3d> near, far;
  for (const Eigen::Vector2d& p : outline) {
    near.emplace_back(p.x(), low, p.y());
    far.emplace_back(p.x(), high, p.y());
  }
  draw.polygon(near, material);
  draw.polygon(far, material);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const std::size_t next = (i + 1) % near.size();
    draw.quad(near[i], near[next], far[next], far[i], material);
  }
}

void draw_bar(const Pen& pen, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              double thickness, MaterialId material) {
  Pen(pen).tube({from, to}, {thickness / 2, thickness / 2}, 5, material);
}

void draw_axle(const Pen& pen, const AxleShape& axle, const Parts& parts) {
  Pen draw = pen;
  const double r = axle.radius;
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k < (axle.twin ? 2 : 1); ++k) {
      const double outer = side * (axle.half_width - k * (axle.tyre + 0.05));
      const double inner = outer - side * axle.tyre;
      draw.tube({{axle.x, inner, r}, {axle.x, outer, r}}, {r, r}, 18, parts.rubber);
    }
    const double rim = side * (axle.half_width + 0.004);
    draw.tube({{axle.x, rim - 0.002, r}, {axle.x, rim + 0.002, r}}, {0.58 * r, 0.58 * r}, 12,
              parts.rim);
  }
  const double inside = axle.half_width - 0.1;
  draw_bar(pen, {axle.x, -inside, r}, {axle.x, inside, r}, 0.16, parts.dark);
}

void draw_glazed_side(const Pen& pen, double from, double to, double y, const WallHeights& heights,
                      const Panes& panes, const Parts& parts) {
  Pen draw = pen;
  const auto face = [&](double a, double b, double low, double high, MaterialId material) {
    if (b - a < 1e-3 || high - low < 1e-3) return;
    draw.quad({a, y, low}, {b, y, low}, {b, y, high}, {a, y, high}, material);
  };
  face(from, to, heights.low, heights.sill, parts.paint);
  face(from, to, heights.lintel, heights.top, parts.paint);
  double pillar = from;
  for (const auto& [begin, end] : panes) {
    face(pillar, begin, heights.sill, heights.lintel, parts.paint);
    face(begin, end, heights.sill, heights.lintel, parts.glass);
    pillar = end;
  }
  face(pillar, to, heights.sill, heights.lintel, parts.paint);
}

void draw_glazed_end(const Pen& pen, const std::array<double, 4>& x, double half_width,
                     const WallHeights& heights, const Parts& parts) {
  Pen draw = pen;
  const std::array<double, 4> z = {heights.low, heights.sill, heights.lintel, heights.top};
  const double w = half_width;
  const double pane = w - 0.09;
  const auto band = [&](int i, double a, double b, MaterialId material) {
    draw.quad({x[i], a, z[i]}, {x[i], b, z[i]}, {x[i + 1], b, z[i + 1]}, {x[i + 1], a, z[i + 1]},
              material);
  };
  band(0, -w, w, parts.paint);
  band(1, -w, -pane, parts.paint);
  band(1, -pane, pane, parts.glass);
  band(1, pane, w, parts.paint);
  band(2, -w, w, parts.paint);
}

void draw_ladder_frame(const Pen& pen, double rear, double front, double top, const Parts& parts) {
  Pen draw = pen;
  for (const double y : {-0.42, 0.42}) {
    draw.box({rear, y - 0.04, top - 0.26}, {front, y + 0.04, top}, parts.dark);
  }
  for (double x = rear + 0.05; x < front; x += 1.1) {
    draw.box({x, -0.42, top - 0.22}, {x + 0.08, 0.42, top - 0.06}, parts.dark);
  }
}

void draw_guards(const Pen& pen, double rear, double from, double to, double half_width,
                 const Parts& parts) {
  Pen draw = pen;
  const double y = half_width - 0.08;
  if (to - from > 0.6) {
    for (const double side : {-1.0, 1.0}) {
      for (const double z : {0.5, 0.78}) {
        draw.box({from, side * y - 0.02, z - 0.06}, {to, side * y + 0.02, z + 0.06}, parts.chrome);
      }
    }
  }
  draw.box({rear + 0.03, -y, 0.42}, {rear + 0.12, y, 0.56}, parts.dark);
  for (const double side : {-1.0, 1.0}) {  // the lamps
    draw.box({rear + 0.01, side * (y - 0.25) - 0.2, 0.66},
             {rear + 0.08, side * (y - 0.25) + 0.2, 0.82}, parts.plate);
  }
}

void draw_mirrors(const Pen& pen, double x, double half_width, double low, double high,
                  const Parts& parts) {
  Pen draw = pen;
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half_width + 0.16);
    draw.box({x - 0.06, y - 0.1, low}, {x + 0.06, y + 0.1, high}, parts.dark);
    const double z = high - 0.05;
    draw_bar(pen, {x, side * half_width, z}, {x, y, z}, 0.04, parts.dark);
  }
}

void draw_seat(const Pen& pen, double width, double back_height, MaterialId material) {
  Pen draw = pen;
  const double w = width / 2;
  draw.box({-0.22, -w, 0.3}, {0.25, w, 0.45}, material);
  draw.box({-0.3, -w, 0.3}, {-0.2, w, back_height}, material);
}

}  // namespace saker::simulation
