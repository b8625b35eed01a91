#include <algorithm>
#include <cmath>
#include <vector>

#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

using Section =
    std::vector<Eigen::Vector3d>;  ///< half a cross-section, y ≥ 0, from the sill to the middle

constexpr double kBedDepth = 0.49;         // m; of mid-size pickups 0.47 to 0.51
constexpr double kArchGap = 0.07;          // m, around a wheel
constexpr double kWheelhouseDepth = 0.32;  // m, from the side: a tyre and room to turn

/// Height of the body's upper edge at x, measured from the front end backwards.
double deck_height(const VehicleShape& s, double back) {
  const auto mix = [](double a, double b, double t) {
    return a + (b - a) * std::clamp(t, 0.0, 1.0);
  };
  if (back < 0.35) return mix(0.78 * s.bonnet, s.bonnet, std::sqrt(back / 0.35));
  if (back < s.screen_base) return mix(s.bonnet, s.belt, (back - 0.35) / (s.screen_base - 0.35));
  if (back < s.rear_base) {
    return mix(s.belt, s.tail, (back - s.screen_base) / (s.rear_base - s.screen_base));
  }
  const double left = s.length - back;
  return left < 0.15 ? mix(0.93 * s.tail, s.tail, left / 0.15) : s.tail;
}

/// Half the body's width: a superellipse in plan, full over the middle.
double half_width(const VehicleShape& s, double back) {
  const double reach = 0.9;
  const double end = std::min(back, s.length - back);
  const double t = std::clamp(1 - end / reach, 0.0, 1.0);
  const double narrowing = back < s.length / 2 ? s.roundness : 0.8 * s.roundness;
  return 0.5 * s.width * (1 - narrowing * std::pow(t, 2.6));
}

/// Lower edge of the side: the sill, raised over the wheels.
double sill_height(const VehicleShape& s, double back) {
  const double arch = s.wheel_radius + kArchGap;
  double sill = s.clearance + 0.04;
  if (std::min(back, s.length - back) < 0.3) sill += 0.06;
  for (const double axle : {s.front_axle, s.length - s.rear_axle}) {
    const double dx = std::abs(back - axle);
    if (dx < arch) sill = std::max(sill, s.wheel_radius + std::sqrt(arch * arch - dx * dx));
  }
  return sill;
}

Section body_section(const VehicleShape& s, double back) {
  const double x = s.length / 2 - back;
  const double w = half_width(s, back);
  const double top = deck_height(s, back);
  const double sill = std::min(sill_height(s, back), top - 0.12);
  const bool bed = s.open_bed && back > s.rear_base && back < s.length - 0.06;
  const double inner = bed ? 0.93 * w - 0.07 : 0.6 * w;
  const double floor = bed ? s.tail - kBedDepth : top + 0.02;
  const double middle = std::clamp(0.55 * top, sill + 0.02, top - 0.08);
  return {{x, 0.8 * w, sill},         {x, 0.97 * w, sill}, {x, w, middle},
          {x, 0.985 * w, top - 0.07}, {x, 0.93 * w, top},  {x, inner, top + (bed ? 0 : 0.01)},
          {x, inner - 0.01, floor},   {x, 0, floor}};
}

Eigen::Vector3d mirrored(const Eigen::Vector3d& p) { return {p.x(), -p.y(), p.z()}; }

void join(const Section& a, const Section& b, const std::vector<MaterialId>& materials,
          const Pen& pen) {
  Pen draw = pen;
  for (std::size_t k = 0; k + 1 < a.size(); ++k) {
    draw.quad(a[k], b[k], b[k + 1], a[k + 1], materials[k]);
    draw.quad(mirrored(a[k]), mirrored(b[k]), mirrored(b[k + 1]), mirrored(a[k + 1]), materials[k]);
  }
}

/// The flat face that closes a body at its end.
void close(const Section& section, MaterialId material, const Pen& pen) {
  std::vector<Eigen::Vector3d> ring(section.begin(), section.end());
  for (auto it = section.rbegin(); it != section.rend(); ++it) ring.push_back(mirrored(*it));
  Pen(pen).polygon(ring, material);
}

void draw_body(const VehicleShape& s, const Palette& palette, MaterialId paint, const Pen& pen) {
  constexpr int kStations = 44;
  std::vector<Section> sections;
  for (int i = 0; i <= kStations; ++i) {
    const double t = static_cast<double>(i) / kStations;
    sections.push_back(body_section(s, s.length * (0.5 - 0.5 * std::cos(t * M_PI))));
  }
  const std::vector<MaterialId> materials(sections[0].size() - 1, paint);
  for (int i = 0; i < kStations; ++i) join(sections[i], sections[i + 1], materials, pen);
  close(sections.front(), paint, pen);
  close(sections.back(), paint, pen);
  const double w = 0.4 * s.width;
  Pen(pen).box({-s.length / 2 + 0.3, -w, s.clearance}, {s.length / 2 - 0.3, w, s.clearance + 0.1},
               palette.dark);
}

/// One cross-section of the windows and the roof.
Section cabin_section(const VehicleShape& s, double back, double roof) {
  const double x = s.length / 2 - back;
  const double sill = std::min(deck_height(s, back), roof);
  const double bottom = 0.93 * half_width(s, back) - 0.02;
  const double rise = roof - sill;
  const double top = bottom - s.tumblehome * rise;
  const double edge = std::min(0.5 * rise, 0.07);
  return {{x, bottom, sill},
          {x, top, roof - edge},
          {x, top - 1.3 * edge, roof - 0.1 * edge},
          {x, 0, roof}};
}

/// Where the cabin is cut and what its sides and its top are made of up to the next cut.
struct Cut {
  double back;
  double roof;
  MaterialId side;
  MaterialId top;
};

std::vector<Cut> cabin_cuts(const VehicleShape& s, MaterialId paint, MaterialId glass) {
  const double front_roof = s.height - 0.035;
  const double rear_roof = s.height - (s.open_bed ? 0.03 : 0.05);
  const double door = s.roof_front + 0.42 * (s.roof_rear - s.roof_front);
  const double sill = deck_height(s, s.rear_base);
  const MaterialId rear_side = s.panel_sides ? paint : glass;
  const double split = 0.62;
  return {{s.screen_base, deck_height(s, s.screen_base), paint, glass},
          {s.roof_front - 0.04, front_roof - 0.02, paint, paint},
          {s.roof_front + 0.06, front_roof, glass, paint},
          {door, s.height, paint, paint},
          {door + 0.1, s.height, rear_side, paint},
          {s.roof_rear - 0.18, s.height - 0.015, paint, paint},
          {s.roof_rear, rear_roof, paint, glass},
          {s.roof_rear + split * (s.rear_base - s.roof_rear),
           rear_roof + split * (sill - rear_roof), paint, paint},
          {s.rear_base, sill, paint, paint}};
}

void draw_cabin(const VehicleShape& s, MaterialId paint, MaterialId glass, const Pen& pen) {
  const std::vector<Cut> cuts = cabin_cuts(s, paint, glass);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Section a = cabin_section(s, cuts[i].back, cuts[i].roof);
    const Section b = cabin_section(s, cuts[i + 1].back, cuts[i + 1].roof);
    join(a, b, {cuts[i].side, cuts[i].side, cuts[i].top}, pen);
  }
}

void draw_seats(const VehicleShape& s, const Palette& palette, const Pen& pen) {
  Pen draw = pen;
  const double half = 0.36 * s.width;
  const double top = s.belt + 0.55 * (s.height - s.belt);
  const double front = s.length / 2 - s.roof_front;
  draw.box({front + 0.2, -half, 0.4}, {front + 0.5, half, s.belt - 0.03}, palette.interior);
  for (const double side : {-0.5, 0.5}) {
    const double y = side * half;
    draw.box({front - 0.8, y - 0.25, 0.4}, {front - 0.65, y + 0.25, top - 0.15}, palette.interior);
    draw.box({front - 0.82, y - 0.12, top - 0.15}, {front - 0.74, y + 0.12, top}, palette.interior);
    draw.box({front - 0.65, y - 0.25, 0.35}, {front - 0.1, y + 0.25, 0.6}, palette.interior);
  }
  const double rear = s.length / 2 - s.roof_rear;
  if (front - rear < 1.7) return;
  draw.box({rear + 0.1, -half, 0.4}, {rear + 0.3, half, top - 0.12}, palette.interior);
}

/// Liners that close a wheel's arch down to the sill: no beam gets into the body there.
void draw_wheelhouse(const VehicleShape& s, const Palette& palette, double x, double side,
                     const Pen& pen) {
  constexpr int kSteps = 10;
  Pen draw = pen;
  const double arch = s.wheel_radius + kArchGap;
  const double outer = side * (s.width / 2 - 0.06);
  const double inner = side * (s.width / 2 - kWheelhouseDepth);
  const double sill = s.clearance + 0.04;
  std::vector<Eigen::Vector3d> back = {{x + arch, inner, sill}};
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = M_PI * i / kSteps;
    back.emplace_back(x + arch * std::cos(angle), inner, s.wheel_radius + arch * std::sin(angle));
  }
  back.emplace_back(x - arch, inner, sill);
  const auto out = [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), outer, p.z()); };
  for (std::size_t i = 0; i + 1 < back.size(); ++i) {
    draw.quad(back[i], back[i + 1], out(back[i + 1]), out(back[i]), palette.dark);
  }
  draw.polygon(back, palette.dark);
}

void draw_wheels(const VehicleShape& s, const Palette& palette, const Pen& pen) {
  Pen draw = pen;
  const double r = s.wheel_radius;
  const double outer = s.width / 2 - 0.02;
  for (const double x : {s.length / 2 - s.front_axle, -s.length / 2 + s.rear_axle}) {
    for (const double side : {-1.0, 1.0}) {
      draw.tube({{x, side * (outer - 0.21), r}, {x, side * outer, r}}, {r, r}, 20, palette.rubber);
      const double y = side * (outer + 0.005);
      draw.tube({{x, y - 0.002, r}, {x, y + 0.002, r}}, {0.66 * r, 0.66 * r}, 14, palette.rim);
      draw_wheelhouse(s, palette, x, side, pen);
    }
  }
}

void draw_details(const VehicleShape& s, const Palette& palette, MaterialId paint, const Pen& pen) {
  Pen draw = pen;
  const double mirror = s.length / 2 - s.roof_front + 0.25;
  const double y = s.width / 2;
  for (const double side : {-1.0, 1.0}) {
    const double a = side * (y - 0.06);
    const double b = side * (y + 0.15);
    draw.box({mirror - 0.08, std::min(a, b), s.belt + 0.02},
             {mirror + 0.06, std::max(a, b), s.belt + 0.16}, paint);
  }
  for (const double x : {s.length / 2 - 0.005, -s.length / 2 + 0.005}) {
    draw.box({x - 0.004, -0.26, 0.42}, {x + 0.004, 0.26, 0.53}, palette.plate);
  }
}

}  // namespace

void draw_vehicle(const VehicleShape& shape, const Palette& palette, MaterialId paint,
                  MaterialId glass, const Pen& pen) {
  draw_body(shape, palette, paint, pen);
  draw_cabin(shape, paint, glass, pen);
  draw_seats(shape, palette, pen);
  draw_wheels(shape, palette, pen);
  draw_details(shape, palette, paint, pen);
}

}  // namespace saker::simulation
