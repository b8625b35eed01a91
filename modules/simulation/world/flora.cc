#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/plants.h"

namespace saker::simulation {
namespace {

Eigen::Vector3d unit_vector(core::Rng& rng) {
  const double z = rng.uniform(-1, 1);
  const double angle = rng.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// One leaf, or a spray of them: a square card turned at random.
void draw_leaf(Pen& pen, const Eigen::Vector3d& centre, double size, MaterialId material,
               core::Rng& rng) {
  const Eigen::Vector3d normal = unit_vector(rng);
  const Eigen::Vector3d u = 0.5 * size * normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  pen.quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v, material);
}

struct Blob {
  Eigen::Vector3d centre;
  double radius;
};

/// Blobs within the unit crown: where its twigs end in leaves.
std::vector<Blob> crown_blobs(core::Rng& rng) {
  std::vector<Blob> blobs = {{{0, 0, 0.5}, 0.42}};
  const int count = 5 + rng.index(9);
  const double roundness = rng.uniform(0.6, 1.2);
  for (int i = 0; i < count; ++i) {
    const double height = rng.uniform(0.14, 0.86);
    const double reach = std::pow(std::sin(std::numbers::pi * height), roundness);
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const double out = reach * rng.uniform(0.3, 0.75);
    blobs.push_back(
        {{out * std::cos(angle), out * std::sin(angle), height}, rng.uniform(0.14, 0.34)});
  }
  return blobs;
}

/// Leaves in blobs, denser to their outside; crowns are as high as they are wide here, so z is
/// scaled by a half.
Mesh crown(const Palette& palette, int leaves, double leaf_size, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const std::vector<Blob> blobs = crown_blobs(rng);
  for (int i = 0; i < leaves; ++i) {
    const Blob& blob = blobs[rng.index(static_cast<int>(blobs.size()))];
    const double r = blob.radius * std::pow(rng.uniform(), 0.22);
    Eigen::Vector3d p = blob.centre + r * unit_vector(rng).cwiseProduct(Eigen::Vector3d(1, 1, 0.6));
    p.z() = std::clamp(p.z(), 0.0, 1.0);
    draw_leaf(pen, p, leaf_size * rng.uniform(0.5, 1.4), palette.leaves, rng);
  }
  return mesh;
}

Mesh conifer(const Palette& palette, int leaves, double leaf_size, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int whorls = 7 + rng.index(6);
  for (int i = 0; i < leaves; ++i) {
    const double u = 1 - std::sqrt(rng.uniform());
    const double whorl = (std::floor(u * whorls) + 0.7 * std::pow(rng.uniform(), 2)) / whorls;
    const double r = (1 - u) * std::pow(rng.uniform(), 0.4);
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector3d p(r * std::cos(angle), r * std::sin(angle), std::min(whorl, 1.0));
    draw_leaf(pen, p, leaf_size * rng.uniform(0.5, 1.3), palette.leaves, rng);
  }
  return mesh;
}

/// A bush: its leaves begin at the ground.
Mesh bush(const Palette& palette, int leaves, double leaf_size, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  std::vector<Blob> blobs;
  const int count = 3 + rng.index(6);
  for (int i = 0; i < count; ++i) {
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const double out = rng.uniform(0, 0.65);
    blobs.push_back({{out * std::cos(angle), out * std::sin(angle), rng.uniform(0.2, 0.62)},
                     rng.uniform(0.25, 0.42)});
  }
  for (int i = 0; i < leaves; ++i) {
    const Blob& blob = blobs[rng.index(count)];
    Eigen::Vector3d p =
        blob.centre + blob.radius * std::pow(rng.uniform(), 0.25) * unit_vector(rng);
    if (rng.chance(0.25)) p.z() *= rng.uniform();  // stems below the leaves
    draw_leaf(pen, {p.x(), p.y(), std::abs(p.z())}, leaf_size * rng.uniform(0.5, 1.4),
              palette.leaves, rng);
  }
  return mesh;
}

/// A cut hedge: a core that no beam passes under a skin of leaves.
Mesh hedge(const Palette& palette, int leaves, double leaf_size, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  pen.box({-0.5, -0.36, 0}, {0.5, 0.36, 0.92}, palette.hedge);
  for (int i = 0; i < leaves; ++i) {
    const double side = rng.chance(0.5) ? -1 : 1;
    Eigen::Vector3d p{rng.uniform(-0.5, 0.5), side * rng.normal(0.44, 0.05), rng.uniform(0, 1)};
    if (rng.chance(0.3)) p = {p.x(), rng.uniform(-0.46, 0.46), rng.normal(0.96, 0.04)};
    draw_leaf(pen, p, leaf_size * rng.uniform(0.5, 1.4), palette.leaves, rng);
  }
  return mesh;
}

std::size_t keep(World& world, Mesh mesh) {
  world.prototypes.push_back(std::move(mesh));
  return world.prototypes.size() - 1;
}

}  // namespace

Flora grow_flora(World& world, const Palette& palette, core::Rng& rng) {
  Flora flora;
  for (int i = 0; i < 5; ++i) {
    const int leaves = 1500 + rng.index(6000);  // sparse to dense
    flora.crowns.push_back(keep(world, crown(palette, leaves, rng.uniform(0.03, 0.07), rng)));
  }
  for (int i = 0; i < 2; ++i) {
    const int leaves = 1500 + rng.index(3000);
    flora.conifers.push_back(keep(world, conifer(palette, leaves, rng.uniform(0.03, 0.07), rng)));
  }
  for (int i = 0; i < 5; ++i) {
    const int leaves = 1500 + rng.index(3000);
    flora.bushes.push_back(keep(world, bush(palette, leaves, rng.uniform(0.05, 0.12), rng)));
  }
  for (int i = 0; i < 2; ++i) {
    flora.hedges.push_back(keep(world, hedge(palette, 250 + rng.index(300), 0.09, rng)));
  }
  return flora;
}

}  // namespace saker::simulation
