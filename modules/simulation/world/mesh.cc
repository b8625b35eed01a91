#include "saker/simulation/world/mesh.h"

#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

/// `sides` points of the circle around `centre` normal to `axis`.
std::vector<Eigen::Vector3d> circle(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                                    double radius, int sides) {
  const Eigen::Vector3d helper =
      std::abs(axis.z()) > 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d u = helper.cross(axis).normalized();
  const Eigen::Vector3d v = axis.cross(u);
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    ring.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return ring;
}

Eigen::Vector3d direction_at(const std::vector<Eigen::Vector3d>& path, std::size_t i) {
  const Eigen::Vector3d& before = path[i == 0 ? 0 : i - 1];
  const Eigen::Vector3d& after = path[i + 1 == path.size() ? i : i + 1];
  return (after - before).normalized();
}

}  // namespace

SE3 placed(double x, double y, double z, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(x, y, z);
  return T;
}

Pen Pen::at(double x, double y, double z, double yaw) const { return at(placed(x, y, z, yaw)); }

std::uint32_t Pen::vertex(const Eigen::Vector3d& p) {
  mesh_->vertices.push_back((T_mesh_pen_ * p).cast<float>());
  return static_cast<std::uint32_t>(mesh_->vertices.size() - 1);
}

void Pen::face(std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material) {
  mesh_->triangles.push_back({a, b, c});
  mesh_->materials.push_back(material);
  mesh_->objects.push_back(object_);
}

void Pen::triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   MaterialId material) {
  const std::uint32_t ia = vertex(a);
  const std::uint32_t ib = vertex(b);
  face(ia, ib, vertex(c), material);
}

void Pen::quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
               const Eigen::Vector3d& d, MaterialId material) {
  const std::uint32_t first = vertex(a);
  (void)vertex(b);
  (void)vertex(c);
  (void)vertex(d);
  face(first, first + 1, first + 2, material);
  face(first, first + 2, first + 3, material);
}

void Pen::box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, MaterialId material) {
  std::array<Eigen::Vector3d, 8> p;
  for (int i = 0; i < 8; ++i) {
    p[i] = {(i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
            (i & 4) != 0 ? high.z() : low.z()};
  }
  quad(p[0], p[1], p[3], p[2], material);
  quad(p[4], p[5], p[7], p[6], material);
  quad(p[0], p[1], p[5], p[4], material);
  quad(p[2], p[3], p[7], p[6], material);
  quad(p[0], p[2], p[6], p[4], material);
  quad(p[1], p[3], p[7], p[5], material);
}

void Pen::polygon(const std::vector<Eigen::Vector3d>& ring, MaterialId material) {
  std::vector<std::uint32_t> ids;
  for (const Eigen::Vector3d& p : ring) ids.push_back(vertex(p));
  for (std::size_t i = 1; i + 1 < ids.size(); ++i) face(ids[0], ids[i], ids[i + 1], material);
}

void Pen::tube(const std::vector<Eigen::Vector3d>& path, const std::vector<double>& radii,
               int sides, MaterialId material, bool capped) {
  std::vector<std::vector<Eigen::Vector3d>> rings;
  for (std::size_t i = 0; i < path.size(); ++i) {
    rings.push_back(circle(path[i], direction_at(path, i), radii[i], sides));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (int k = 0; k < sides; ++k) {
      const int next = (k + 1) % sides;
      quad(rings[i][k], rings[i][next], rings[i + 1][next], rings[i + 1][k], material);
    }
  }
  if (!capped) return;
  polygon(rings.front(), material);
  polygon(rings.back(), material);
}

void Pen::post(double radius, double height, MaterialId material, int sides) {
  tube({Eigen::Vector3d::Zero(), {0, 0, height}}, {radius, radius}, sides, material);
}

void Pen::ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii,
                    MaterialId material) {
  constexpr int kRings = 6;
  constexpr int kSides = 10;
  const auto point = [&](int ring, int side) -> Eigen::Vector3d {
    const double latitude = std::numbers::pi * (ring / double{kRings} - 0.5);
    const double longitude = 2 * std::numbers::pi * side / kSides;
    return centre + radii.cwiseProduct(Eigen::Vector3d(std::cos(latitude) * std::cos(longitude),
                                                       std::cos(latitude) * std::sin(longitude),
                                                       std::sin(latitude)));
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      quad(point(ring, side), point(ring, side + 1), point(ring + 1, side + 1),
           point(ring + 1, side), material);
    }
  }
}

}  // namespace saker::simulation
