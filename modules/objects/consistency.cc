#include "objects/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/statistics.h"

namespace saker::objects {
namespace {

constexpr std::size_t kLeastNeighbours = 2;  // a turn and a shift: three unknowns of four numbers

/// What a pair says about the map's frame.
struct Anchor {
  Eigen::Vector2d at;          ///< true place
  Eigen::Vector2d error;       ///< mapped − true
  Eigen::Matrix2d covariance;  ///< of the error, in the map's frame
};

const MapObject& by_id(const ObjectMap& map, int id) {
  return *std::ranges::find(map.objects, id, &MapObject::id);
}

bool has_covariance(const MapObject& object) {
  return object.covariance.size() > 0 && object.covariance.allFinite();
}

/// Of a cuboid the covariance is in its own frame.
Eigen::Matrix2d place_covariance(const MapObject& object) {
  const auto* cuboid = std::get_if<Cuboid>(&object.model);
  if (cuboid == nullptr) return object.covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix3d& R = cuboid->pose.linear();
  return (R * object.covariance.block<3, 3>(3, 3) * R.transpose()).topLeftCorner<2, 2>();
}

double size_nees(const MapObject& mapped, const MapObject& truth) {
  if (const auto* cuboid = std::get_if<Cuboid>(&mapped.model)) {
    const Eigen::Vector2d error =
        (cuboid->size - std::get<Cuboid>(truth.model).size).head<2>().eval();
    const Eigen::Matrix2d P = mapped.covariance.block<2, 2>(6, 6);
    return error.dot(P.llt().solve(error)) / 2;
  }
  const double error =
      std::get<Cylinder>(mapped.model).radius - std::get<Cylinder>(truth.model).radius;
  return error * error / mapped.covariance(5, 5);
}

/// How the error at `p` follows from a shift and a small turn about `centre`.
Eigen::Matrix<double, 2, 3> motion_at(const Eigen::Vector2d& p, const Eigen::Vector2d& centre) {
  Eigen::Matrix<double, 2, 3> J;
  J << 1, 0, centre.y() - p.y(), 0, 1, p.x() - centre.x();
  return J;
}

double place_nees(std::size_t index, const std::vector<Anchor>& all, double neighbourhood_m) {
  const Anchor& object = all[index];
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t neighbours = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Anchor& other = all[i];
    if (i == index || (other.at - object.at).norm() > neighbourhood_m) continue;
    const auto J = motion_at(other.at, object.at);
    const Eigen::Matrix<double, 3, 2> weighted = J.transpose() * other.covariance.inverse();
    information += weighted * J;
    sum += weighted * other.error;
    ++neighbours;
  }
  const auto solver = information.llt();
  if (neighbours < kLeastNeighbours || solver.info() != Eigen::Success) return NAN;
  const Eigen::Matrix3d of_motion = solver.solve(Eigen::Matrix3d::Identity());
  const Eigen::Vector2d error = object.error - solver.solve(sum).head<2>();
  const Eigen::Matrix2d P = object.covariance + of_motion.topLeftCorner<2, 2>();
  return error.dot(P.llt().solve(error)) / 2;
}

}  // namespace

std::vector<ObjectConsistency> consistency(const ObjectMap& mapped, const ObjectMap& truth,
                                           const std::vector<ClassComparison>& compared,
                                           const ConsistencyOptions& options) {
  std::vector<ObjectConsistency> result;
  std::vector<Anchor> anchors;
  std::vector<std::size_t> of_anchor;  // its entry in the result
  for (const ClassComparison& c : compared) {
    for (const FoundPair& pair : c.pairs) {
      const MapObject &found = by_id(mapped, pair.mapped), &real = by_id(truth, pair.truth);
      ObjectConsistency entry{pair, real.class_id};
      if (has_covariance(found)) {
        entry.size = size_nees(found, real);
        const Eigen::Vector2d at = place(real.model).head<2>();
        anchors.push_back({at, place(found.model).head<2>() - at, place_covariance(found)});
        of_anchor.push_back(result.size());
      }
      result.push_back(entry);
    }
  }
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    result[of_anchor[i]].place = place_nees(i, anchors, options.neighbourhood_m);
  }
  return result;
}

ConsistencyFigures mean_consistency(const std::vector<ObjectConsistency>& objects,
                                    ClassId class_id) {
  std::vector<double> sizes, places;
  for (const ObjectConsistency& object : objects) {
    if (object.class_id != class_id) continue;
    if (std::isfinite(object.size)) sizes.push_back(object.size);
    if (std::isfinite(object.place)) places.push_back(object.place);
  }
  return {static_cast<int>(sizes.size()), static_cast<int>(places.size()), core::mean(sizes),
          core::mean(places)};
}

}  // namespace saker::objects
