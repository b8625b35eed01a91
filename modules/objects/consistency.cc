#include "saker/objects/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "saker/core/statistics.h"

namespace saker::objects {
namespace {

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

double place_nees(const MapObject& mapped, const MapObject& truth) {
  const Eigen::Vector2d error = (place(mapped.model) - place(truth.model)).head<2>();
  return error.dot(place_covariance(mapped).llt().solve(error)) / 2;
}

}  // namespace

std::vector<ObjectConsistency> consistency(const ObjectMap& mapped, const ObjectMap& truth,
                                           const std::vector<ClassComparison>& compared) {
  std::vector<ObjectConsistency> result;
  for (const ClassComparison& c : compared) {
    for (const FoundPair& pair : c.pairs) {
      const MapObject &found = by_id(mapped, pair.mapped), &real = by_id(truth, pair.truth);
      ObjectConsistency entry{pair, real.class_id};
      if (has_covariance(found)) {
        entry.size = size_nees(found, real);
        entry.place = place_nees(found, real);
      }
      result.push_back(entry);
    }
  }
  return result;
}

ConsistencyFigures mean_consistency(const std::vector<ObjectConsistency>& objects,
                                    ClassId class_id) {
  std::vector<double> sizes, places;
  for (const ObjectConsistency& object : objects) {
    if (object.class_id != class_id || !std::isfinite(object.size)) continue;
    sizes.push_back(object.size);
    places.push_back(object.place);
  }
  return {static_cast<int>(sizes.size()), core::mean(sizes), core::mean(places)};
}

}  // namespace saker::objects
