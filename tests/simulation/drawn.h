#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "saker/simulation/sensor/ray_caster.h"
#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// A world of materials alone, to draw things into.
struct Sketch {
  explicit Sketch(std::uint64_t seed = 1)
      : rng(seed),
        palette(make_palette(world, rng)),
        street(make_street_palette(world, palette, rng)) {}

  [[nodiscard]] const Mesh& mesh() const { return world.mesh; }
  [[nodiscard]] Pen pen() { return Pen(world.mesh); }

  core::Rng rng;
  World world;
  Palette palette;
  StreetPalette street;
};

/// What draws one thing of flights' and missions' streets.
using Adder = void (*)(World&, const Palette&, const SE3&, core::Rng&);

/// `check` on several drawings of each kind: struct with `name` and what `draw` needs.
template <class Kinds, class Draw, class Check>
void for_each_drawing(const Kinds& kinds, std::uint64_t seeds, Draw draw, Check check) {
  for (const auto& kind : kinds) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(seed));
      Sketch s(seed);
      draw(kind, s);
      check(kind, s);
    }
  }
}

inline Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& p : mesh.vertices) box.extend(p.cast<double>());
  return box;
}

/// The box about the triangles that `wanted` picks by their material.
template <class Wanted>
Eigen::AlignedBox3d box_of(const Mesh& mesh, Wanted wanted) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!wanted(mesh.materials[i])) continue;
    for (const std::uint32_t v : mesh.triangles[i]) box.extend(mesh.vertices[v].cast<double>());
  }
  return box;
}

inline Eigen::AlignedBox3d box_of_label(const World& world, int label) {
  return box_of(world.mesh, [&](MaterialId m) { return world.materials[m].label == label; });
}

/// The box about all that is placed of prototypes.
inline Eigen::AlignedBox3d box_of_placements(const World& world) {
  Eigen::AlignedBox3d box;
  for (const Placement& placement : world.placements) {
    for (const Eigen::Vector3f& v : world.prototypes[placement.prototype].vertices)
      box.extend((placement.T_world_prototype * v).cast<double>());
  }
  return box;
}

inline std::set<int> labels_of(const World& world, const Mesh& mesh) {
  std::set<int> labels;
  for (const MaterialId m : mesh.materials) labels.insert(world.materials[m].label);
  return labels;
}

/// m² of the triangles that `wanted` picks by their material.
template <class Wanted>
double area_of(const Mesh& mesh, Wanted wanted) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!wanted(mesh.materials[i])) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d ab = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d ac = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
    area += 0.5 * ab.cross(ac).norm();
  }
  return area;
}

inline double area_of(const Mesh& mesh) {
  return area_of(mesh, [](MaterialId) { return true; });
}

using GridPoint = std::array<long, 3>;

inline GridPoint on_grid(const Eigen::Vector3f& p, double step) {
  return {std::lround(p.x() / step), std::lround(p.y() / step), std::lround(p.z() / step)};
}

/// Edges that an odd number of triangles has: a closed surface has none.
inline int open_edges(const Mesh& mesh) {
  std::map<std::pair<GridPoint, GridPoint>, int> users;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      GridPoint a = on_grid(mesh.vertices[triangle[k]], 1e-4);
      GridPoint b = on_grid(mesh.vertices[triangle[(k + 1) % 3]], 1e-4);
      if (a == b) continue;
      if (b < a) std::swap(a, b);
      ++users[{a, b}];
    }
  }
  int open = 0;
  for (const auto& [edge, count] : users) open += count % 2;
  return open;
}

/// Whether each vertex has a counterpart at −y, to about `step`.
inline bool is_mirrored(const Mesh& mesh, double step = 1e-3) {
  std::set<GridPoint> there;
  for (const Eigen::Vector3f& p : mesh.vertices) there.insert(on_grid(p, step));
  for (const Eigen::Vector3f& p : mesh.vertices) {
    const GridPoint at = on_grid({p.x(), -p.y(), p.z()}, step);
    bool found = false;
    for (long i = 0; i < 27 && !found; ++i)  // rounded to a neighbour
      found = there.contains({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
    if (!found) return false;
  }
  return true;
}

inline Shot shoot(const RayCaster& caster, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& direction, float far = 100) {
  Shot shot;
  shot.origin = from.cast<float>();
  shot.direction = direction.normalized().cast<float>();
  caster.cast({&shot, 1}, far);
  return shot;
}

inline Eigen::Vector3d place_of(const Shot& shot) {
  return (shot.origin + shot.distance * shot.direction).cast<double>();
}

/// Surfaces along a ray, nearest first.
inline std::vector<Shot> surfaces_along(const RayCaster& caster, const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& direction, float far = 100) {
  std::vector<Shot> surfaces;
  Shot shot = shoot(caster, from, direction, far);
  while (shot.hit && surfaces.size() < 100) {
    surfaces.push_back(shot);
    shot.near = shot.distance + 1e-4F;
    shot.hit = false;
    caster.cast({&shot, 1}, far);
  }
  return surfaces;
}

/// Mean and standard deviation of what is added.
class Spread {
 public:
  void add(double x) {
    ++count_;
    sum_ += x;
    squares_ += x * x;
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double mean() const { return sum_ / count_; }
  [[nodiscard]] double sd() const { return std::sqrt(squares_ / count_ - mean() * mean()); }

 private:
  int count_ = 0;
  double sum_ = 0, squares_ = 0;
};

}  // namespace saker::simulation
