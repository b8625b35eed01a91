#include "simulation/terrain.h"

#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kStep = 1.0;  ///< m between the ground's rows along the street
constexpr double kMostAcross = 1.5;

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
    edges.push_back({d, height, height + strip.kerb, strip.slope, strip.surface});
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
  return edges[i].high + edges[i].slope * (out - edges[i].d);
}

double Terrain::relief(double s, double d) const {
  double z = shape_.grade * s + shape_.side_slope * d;
  for (const Wave& w : waves_) z += w.amplitude * std::sin(w.k.x() * s + w.k.y() * d + w.phase);
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
  const int along = static_cast<int>(2 * shape_.half_length / kStep);
  const auto corner = [&](int i, int k) {
    const double s = -shape_.half_length + i * kStep;
    const double out = edge.d + (end - edge.d) * k / across;
    return at_height(s, side * out, edge.high + edge.slope * (out - edge.d));
  };
  const auto crossing = [&](int i, int k) {
    const double s = -shape_.half_length + i * kStep;
    return at_height(s, side * (edge.d + (end - edge.d) * k / across), 0);
  };
  for (int i = 0; i < along; ++i) {
    const bool cut = in_crossing(-shape_.half_length + (i + 0.5) * kStep, 0);
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
  const int along = static_cast<int>(2 * shape_.half_length / kStep);
  for (int i = 0; i < along; ++i) {
    const double s = -shape_.half_length + i * kStep;
    if (in_crossing(s + 0.5 * kStep, 0)) continue;
    const double d = side * edge.d;
    pen.quad(at_height(s, d, edge.low), at_height(s + kStep, d, edge.low),
             at_height(s + kStep, d, edge.high), at_height(s, d, edge.high), edge.surface);
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
