#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "saker/core/se3.h"

namespace saker::simulation {

using MaterialId = std::uint16_t;  ///< index into World::materials
using ObjectId = std::uint16_t;    ///< index into World::objects plus one; 0: part of no object

/// Triangles in the world frame (or a prototype's), each of one material and one object.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MaterialId> materials;  ///< one a triangle
  std::vector<ObjectId> objects;      ///< one a triangle
};

/// Draws shapes, given in the frame of `T_mesh_pen`, into a mesh.
class Pen {
 public:
  explicit Pen(Mesh& mesh, const SE3& T_mesh_pen = SE3::Identity(), ObjectId object = 0)
      : mesh_(&mesh), T_mesh_pen_(T_mesh_pen), object_(object) {}

  /// The same mesh and object, drawing in a frame placed in this one's.
  [[nodiscard]] Pen at(const SE3& T_pen_child) const {
    return Pen(*mesh_, T_mesh_pen_ * T_pen_child, object_);
  }
  [[nodiscard]] Pen at(double x, double y, double z, double yaw = 0) const;

  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& d, MaterialId material);
  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                MaterialId material);

  /// A closed box between two corners.
  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, MaterialId material);

  /// A tube along `path` with a radius at each of its points; `path` has at least two points.
  void tube(const std::vector<Eigen::Vector3d>& path, const std::vector<double>& radii, int sides,
            MaterialId material, bool capped = true);

  /// An upright tube from the frame's origin.
  void post(double radius, double height, MaterialId material, int sides = 12);

  /// An ellipsoid around `centre`.
  void ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, MaterialId material);

  /// The last point of `ring` joined to the first: a flat polygon, convex.
  void polygon(const std::vector<Eigen::Vector3d>& ring, MaterialId material);

 private:
  [[nodiscard]] std::uint32_t vertex(const Eigen::Vector3d& p);
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material);

  Mesh* mesh_;
  SE3 T_mesh_pen_;
  ObjectId object_;
};

/// x, y, z and a turn about z.
[[nodiscard]] SE3 placed(double x, double y, double z, double yaw = 0);

}  // namespace saker::simulation
