#include "saker/simulation/world/vehicle_cab.h"

namespace saker::simulation {
namespace {

constexpr double kPillar = 0.08;  // m

/// Where the windscreen begins and ends, and the side window's rear edge.
struct Marks {
  double screen_low, screen_high, window_back, back;
};

Marks marks_of(const CabShape& cab) {
  const double low = cab.front - cab.nose;
  const double high = low - cab.rake;
  return {low, high, high - cab.window, cab.front - cab.length};
}

void draw_side(const Pen& pen, const CabShape& c, double side, const Parts& parts) {
  Pen draw = pen;
  const Marks m = marks_of(c);
  const double y = side * c.half_width;
  const double n = side * c.nose_half_width;
  const auto at = [&](double x, double z) { return Eigen::Vector3d(x, y, z); };
  draw.polygon({{c.front, n, c.low},
                {c.front - 0.04, n, c.bonnet},
                {m.screen_low, n, c.belt},
                {m.screen_low, n, c.low}},
               parts.paint);
  draw.quad({m.screen_low, n, c.low}, {m.screen_low, n, c.belt}, at(m.screen_low, c.belt),
            at(m.screen_low, c.low), parts.paint);
  draw.quad(at(m.screen_low, c.low), at(m.screen_low, c.belt), at(m.back, c.belt),
            at(m.back, c.low), parts.paint);
  const double pane_low = m.screen_low - kPillar, pane_high = m.screen_high - kPillar;
  draw.quad(at(m.screen_low, c.belt), at(pane_low, c.belt), at(pane_high, c.lintel),
            at(m.screen_high, c.lintel), parts.paint);
  draw.quad(at(pane_low, c.belt), at(m.window_back, c.belt), at(m.window_back, c.lintel),
            at(pane_high, c.lintel), parts.glass);
  draw.quad(at(m.window_back, c.belt), at(m.back, c.belt), at(m.back, c.lintel),
            at(m.window_back, c.lintel), parts.paint);
  draw.quad(at(m.screen_high, c.lintel), at(m.screen_high - 0.08, c.height), at(m.back, c.height),
            at(m.back, c.lintel), parts.paint);
}

/// Grille, bonnet, windscreen, brow, roof, back wall and underside.
void draw_across(const Pen& pen, const CabShape& c, const Parts& parts) {
  Pen draw = pen;
  const Marks m = marks_of(c);
  const auto band = [&](double xa, double za, double xb, double zb, double w, MaterialId material) {
    draw.quad({xa, -w, za}, {xa, w, za}, {xb, w, zb}, {xb, -w, zb}, material);
  };
  const double w = c.half_width;
  band(c.front, c.low, c.front - 0.04, c.bonnet, c.nose_half_width, parts.paint);
  band(c.front - 0.04, c.bonnet, m.screen_low, c.belt, c.nose_half_width, parts.paint);
  band(m.screen_low, c.belt, m.screen_high, c.lintel, w, parts.glass);
  band(m.screen_high, c.lintel, m.screen_high - 0.08, c.height, w, parts.paint);
  band(m.screen_high - 0.08, c.height, m.back, c.height, w, parts.paint);
  band(c.front, c.low, m.back, c.low, c.nose_half_width, parts.dark);
  if (c.back_wall) band(m.back, c.low, m.back, c.height, w, parts.paint);
}

void draw_inside(const Pen& pen, const CabShape& c, const Parts& parts) {
  Pen draw = pen;
  const Marks m = marks_of(c);
  const double w = c.half_width - 0.1;
  draw.box({m.screen_high - 0.25, -w, c.belt - 0.35}, {m.screen_low - 0.05, w, c.belt - 0.02},
           parts.interior);
  for (const double side : {-0.55, 0.55}) {
    draw_seat(pen.at(m.screen_high - 0.75, side * c.half_width, c.belt - 0.8), 0.5,
              std::min(1.3, c.lintel - c.belt + 0.55), parts.interior);
  }
}

void draw_outside(const Pen& pen, const CabShape& c, const Parts& parts) {
  Pen draw = pen;
  const Marks m = marks_of(c);
  const double n = c.nose_half_width;
  draw.box({c.front - 0.08, -n, c.low}, {c.front, n, c.low + 0.25}, parts.dark);
  draw.box({c.front - 0.05, -0.55 * n, c.low + 0.35}, {c.front - 0.01, 0.55 * n, c.bonnet - 0.1},
           parts.dark);
  for (const double side : {-1.0, 1.0}) {  // lamps
    draw.box({c.front - 0.06, side * 0.8 * n - 0.15, c.low + 0.28},
             {c.front - 0.002, side * 0.8 * n + 0.15, c.low + 0.48}, parts.chrome);
  }
  draw.box({c.front - 0.01, -0.26, c.low + 0.05}, {c.front, 0.26, c.low + 0.17}, parts.plate);
  draw_mirrors(pen, m.screen_low - 0.1, c.half_width, c.belt + 0.05,
               c.belt + 0.75 * (c.lintel - c.belt), parts);
}

}  // namespace

void draw_cab(const Pen& pen, const CabShape& cab, const Parts& parts) {
  for (const double side : {-1.0, 1.0}) draw_side(pen, cab, side, parts);
  draw_across(pen, cab, parts);
  draw_inside(pen, cab, parts);
  draw_outside(pen, cab, parts);
}

}  // namespace saker::simulation
