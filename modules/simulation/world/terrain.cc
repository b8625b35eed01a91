#include "saker/simulation/world/terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kMostAcross = 1.5;
constexpr double kKerbFall = 0.8;  ///< m along the street in which a kerb is lowered

/// 0 outside, 1 within, smooth over `edge` metres.
double plateau(double distance, double half, double edge) {
  const double u = std::clamp((half + edge - std::abs(distance)) / edge, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

}  // namespace

Terrain::Terrain(const TerrainShape& shape, CrossSection section, core::Rng& rng)
    : shape_(shape), section_(std::move(section)) {
  left_ = edges_of(section_.left);
  right_ = edges_of(section_.right);
  add_waves(shape.relief_m, 25, 90, 6, rng);
  add_waves(shape.roughness_m, 2.5, 9, 8, rng);
}

void Terrain::add_waves(double sd, double shortest, double longest, int count, core::Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const double wavelength = rng.uniform(shortest, longest);
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const double k = 2 * std::numbers::pi / wavelength;
    waves_.push_back({{k * std::cos(angle), k * std::sin(angle)},
                      rng.uniform(0, 2 * std::numbers::pi),
                      sd * std::sqrt(2.0 / count)});
  }
}

std::vector<Terrain::Edge> Terrain::edges_of(const std::vector<Strip>& strips) const {
  std::vector<Edge> edges;
  double d = 0;
  double height = 0;
  for (const Strip& strip : strips) {
    edges.push_back(
        {d, height, height + strip.kerb, strip.slope, strip.surface, strip.width, strip.rough});
    height += strip.kerb + strip.slope * strip.width;
    d += strip.width;
  }
  return edges;
}

bool Terrain::in_crossing(double s, double margin) const {
  return std::abs(s - shape_.crossing) < shape_.crossing_half_width + margin;
}

double Terrain::offset(double s, double d) const {
  if (in_crossing(s, 0)) return 0;
  const std::vector<Edge>& edges = d >= 0 ? left_ : right_;
  const double out = std::abs(d);
  std::size_t i = 0;
  while (i + 1 < edges.size() && edges[i + 1].d <= out) ++i;
  return strip_offset(edges[i], s, d >= 0 ? 1 : -1, out);
}

double Terrain::strip_offset(const Edge& edge, double s, double side, double out) const {
  const double in = out - edge.d;
  double z = edge.high + edge.slope * in;
  if (edge.rough > 0) {  // none at the strip's ends: neighbours meet
    const double share = std::clamp(in / edge.width, 0.0, 1.0);
    z += edge.rough * std::sin(std::numbers::pi * share) * lumps(s, side * out);
  }
  if (!shape_.dropped.empty() && edge.high > edge.low) {  // the strip rises from the road's height
    const double share = std::max(0.0, 1 - in / edge.width);
    z -= lowered(s, side) * (edge.high - edge.low) * share;
  }
  return z;
}

double Terrain::lumps(double s, double d) const {
  constexpr double kWaves[][2] = {{1.1, 0.7}, {-0.6, 1.9}, {2.3, -0.4}, {0.5, 3.1}, {-2.7, 1.6}};
  double z = 0;
  double phase = shape_.lump_phase;
  for (const auto& k : kWaves) z += std::sin(k[0] * s + k[1] * d + (phase += 1.7));
  return z * std::sqrt(2.0 / 5);
}

double Terrain::lowered(double s, double side) const {
  constexpr double kMost = 0.85;  // a lip of 2 cm stays
  double most = 0;
  for (const DroppedKerb& kerb : shape_.dropped) {
    if (kerb.side * side < 0) continue;
    const double half = 0.5 * (kerb.to - kerb.from);
    most = std::max(most, kMost * plateau(s - kerb.from - half, half, kKerbFall));
  }
  return most;
}

double Terrain::relief(double s, double d) const {
  double z = shape_.grade * s + shape_.side_slope * d;
  for (const Wave& w : waves_) z += w.amplitude * std::sin(w.k.x() * s + w.k.y() * d + w.phase);
  for (const Ramp& ramp : shape_.ramps)
    z += ramp.slope * std::clamp(s - ramp.from, 0.0, ramp.to - ramp.from);
  for (const Swell& w : shape_.swells)
    z +=
        w.height * plateau(s - w.s, w.half_length, w.edge) * plateau(d - w.d, w.half_width, w.edge);
  return z;
}

double Terrain::height(double s, double d) const { return relief(s, d) + offset(s, d); }

double Terrain::heading(double s) const {
  const double k = 2 * std::numbers::pi / shape_.bend_period_m;
  return std::atan(shape_.bend_m * k * std::cos(k * s + shape_.bend_phase));
}

Eigen::Vector3d Terrain::at_height(double s, double d, double offset) const {
  const double k = 2 * std::numbers::pi / shape_.bend_period_m;
  const double y = shape_.bend_m * std::sin(k * s + shape_.bend_phase);
  const double turn = heading(s);
  return {s - d * std::sin(turn), y + d * std::cos(turn), relief(s, d) + offset};
}

Eigen::Vector3d Terrain::point(double s, double d) const { return at_height(s, d, offset(s, d)); }

SE3 Terrain::upright(double s, double d, double yaw) const {
  const Eigen::Vector3d p = point(s, d);
  return placed(p.x(), p.y(), p.z(), heading(s) + yaw);
}

SE3 Terrain::on_ground(double s, double d, double yaw) const {
  const SE3 T = upright(s, d, yaw);
  const double c = 0.6 * std::cos(yaw);
  const double n = 0.6 * std::sin(yaw);
  const Eigen::Vector3d x = point(s + 2 * c, d + 2 * n) - point(s - 2 * c, d - 2 * n);
  const Eigen::Vector3d y = point(s - n, d + c) - point(s + n, d - c);
  SE3 tilted = T;
  const Eigen::Vector3d z = x.cross(y).normalized();
  tilted.linear().col(0) = (x - x.dot(z) * z).normalized();
  tilted.linear().col(2) = z;
  tilted.linear().col(1) = z.cross(tilted.linear().col(0));
  return tilted;
}

void Terrain::draw_band(Pen& pen, double side, const Edge& edge, double end) const {
  const int across = std::max(1, static_cast<int>(std::ceil((end - edge.d) / kMostAcross)));
  const int along = static_cast<int>(2 * shape_.half_length / shape_.step_m);
  const auto corner = [&](int i, int k) {
    const double s = -shape_.half_length + i * shape_.step_m;
    const double out = edge.d + (end - edge.d) * k / across;
    return at_height(s, side * out, strip_offset(edge, s, side, out));
  };
  const auto crossing = [&](int i, int k) {
    const double s = -shape_.half_length + i * shape_.step_m;
    return at_height(s, side * (edge.d + (end - edge.d) * k / across), 0);
  };
  for (int i = 0; i < along; ++i) {
    const bool cut = in_crossing(-shape_.half_length + (i + 0.5) * shape_.step_m, 0);
    for (int k = 0; k < across; ++k) {
      if (cut) {
        pen.quad(crossing(i, k), crossing(i + 1, k), crossing(i + 1, k + 1), crossing(i, k + 1),
                 shape_.crossing_surface);
      } else {
        pen.quad(corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1),
                 edge.surface);
      }
    }
  }
}

void Terrain::draw_kerb(Pen& pen, double side, const Edge& edge) const {
  if (edge.high - edge.low < 1e-6) return;
  const int along = static_cast<int>(2 * shape_.half_length / shape_.step_m);
  for (int i = 0; i < along; ++i) {
    const double s = -shape_.half_length + i * shape_.step_m;
    if (in_crossing(s + 0.5 * shape_.step_m, 0)) continue;
    const double d = side * edge.d;
    const double next = s + shape_.step_m;
    pen.quad(at_height(s, d, edge.low), at_height(next, d, edge.low),
             at_height(next, d, strip_offset(edge, next, side, edge.d)),
             at_height(s, d, strip_offset(edge, s, side, edge.d)), edge.surface);
  }
}

void Terrain::draw_side(World& world, double side) const {
  const std::vector<Edge>& edges = side > 0 ? left_ : right_;
  const std::vector<Strip>& strips = side > 0 ? section_.left : section_.right;
  Pen pen(world.mesh);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    draw_band(pen, side, edges[i], edges[i].d + strips[i].width);
    draw_kerb(pen, side, edges[i]);
  }
}

void Terrain::draw(World& world) const {
  draw_side(world, 1);
  draw_side(world, -1);
}

}  // namespace saker::simulation
