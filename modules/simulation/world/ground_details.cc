#include "saker/simulation/world/ground_details.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {

MaterialId labelled(World& world, MaterialId base, std::uint16_t label) {
  Material material = world.materials[base];
  material.label = label;
  return world.add(material);
}

void GroundPainter::patch(double s, double d, double half_s, double half_d, MaterialId surface,
                          double lift) {
  Pen pen(world_->mesh);
  const int along = std::max(1, static_cast<int>(std::ceil(2 * half_s)));
  const int across = std::max(1, static_cast<int>(std::ceil(2 * half_d)));
  const auto corner = [&](int i, int k) {
    return at(s - half_s + 2 * half_s * i / along, d - half_d + 2 * half_d * k / across, lift);
  };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < across; ++k)
      pen.quad(corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1), surface);
  }
}

void GroundPainter::blot(double s, double d, double radius, double raggedness, MaterialId surface,
                         core::Rng& rng) {
  constexpr int kSides = 14;
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const double r = radius * rng.uniform(1 - raggedness, 1);
    ring.push_back(at(s + r * std::cos(angle), d + r * std::sin(angle), 0.014));
  }
  Pen pen(world_->mesh);
  const Eigen::Vector3d middle = at(s, d, 0.014);
  for (int i = 0; i < kSides; ++i) pen.triangle(middle, ring[i], ring[(i + 1) % kSides], surface);
}

void GroundPainter::speed_bump(double s, double from, double to, double length, double height) {
  Pen pen(world_->mesh);
  constexpr int kParts = 6;
  const double step = 1.0;
  for (double d = from; d < to; d += step) {
    const double end = std::min(to, d + step);
    for (int i = 0; i < kParts; ++i) {
      const auto profile = [&](int k, double across) {
        const double u = double(k) / kParts;
        const double z = height * std::min(1.0, 1.6 * std::sin(std::numbers::pi * u));
        return at(s + (u - 0.5) * length, across, z + 0.002);
      };
      pen.quad(profile(i, d), profile(i + 1, d), profile(i + 1, end), profile(i, end),
               palette_->asphalt);
    }
  }
}

void GroundPainter::tram_track(double d, double from, double to, double gauge) {
  for (const double side : {-0.5, 0.5})
    patch(0.5 * (from + to), d + side * gauge, 0.5 * (to - from), 0.04, palette_->steel, 0.01);
}

void GroundPainter::crosswalk(double s, double from, double to) {
  for (double d = from + 0.3; d + 0.5 < to; d += 1)
    patch(s, d + 0.25, 1.6, 0.25, palette_->marking, 0.006);
}

void GroundPainter::line(double d, double from, double to, double dash, double gap, double width) {
  for (double s = from; s + dash < to; s += dash + gap)
    patch(s + dash / 2, d, dash / 2, width / 2, palette_->marking, 0.006);
}

void GroundPainter::island(double s, double d, double half_s, double half_d, double height,
                           MaterialId top) {
  patch(s, d, half_s, half_d, top, height);
  Pen pen(world_->mesh);
  const auto side = [&](double s0, double d0, double s1, double d1) {
    pen.quad(at(s0, d0, -0.05), at(s1, d1, -0.05), at(s1, d1, height), at(s0, d0, height), top);
  };
  for (double x = s - half_s; x < s + half_s - 1e-6; x += 1) {
    const double end = std::min(s + half_s, x + 1);
    side(x, d - half_d, end, d - half_d);
    side(x, d + half_d, end, d + half_d);
  }
  side(s - half_s, d - half_d, s - half_s, d + half_d);
  side(s + half_s, d - half_d, s + half_s, d + half_d);
}

void GroundPainter::path(double s, double from, double to, double half_s, MaterialId surface) {
  const double rise = terrain_->height(s, to) - terrain_->height(s, from);
  if (std::abs(rise) < 0.15 * std::abs(to - from))
    return patch(s, 0.5 * (from + to), half_s, 0.5 * std::abs(to - from), surface, 0.015);
  constexpr double kTread = 0.35;
  const int steps = static_cast<int>(std::abs(to - from) / kTread);
  Pen pen(world_->mesh);
  for (int i = 0; i < steps; ++i) {
    const double a = from + (to - from) * i / steps;
    const double b = from + (to - from) * (i + 1) / steps;
    const double low = std::max(at(s, a, 0).z(), at(s, b, 0).z()) + 0.02;
    Eigen::Vector3d corner[4] = {at(s - half_s, a, 0), at(s + half_s, a, 0), at(s + half_s, b, 0),
                                 at(s - half_s, b, 0)};
    for (Eigen::Vector3d& c : corner) c.z() = low;
    pen.quad(corner[0], corner[1], corner[2], corner[3], surface);
    const Eigen::Vector3d down(0, 0, -std::abs(rise) / steps - 0.1);
    pen.quad(corner[0], corner[1], corner[1] + down, corner[0] + down, surface);
  }
}

}  // namespace saker::simulation
