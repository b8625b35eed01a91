#include "tools/saker/characterise/sample_matching.h"

#include "saker/objects/assignment.h"

namespace saker::tools {
namespace {

constexpr double kCuboidGate_m = 1.5;  ///< as map eval's: cars stand 2.5 m apart
constexpr double kCylinderGate_m = 0.75;
constexpr double kNever = 1e6;  ///< cost of a pair that cannot be

/// Distance in x-y in units of the gate.
double cost_of(const objects::Model& measured, const objects::Model& truth) {
  if (measured.index() != truth.index()) return kNever;
  const bool cuboid = std::holds_alternative<objects::Cuboid>(truth);
  const Eigen::Vector3d offset = objects::place(measured) - objects::place(truth);
  return offset.head<2>().norm() / (cuboid ? kCuboidGate_m : kCylinderGate_m);
}

}  // namespace

std::vector<int> matched(const std::vector<objects::Measurement>& measurements,
                         const SE3& T_world_lidar, const std::vector<KnownObject>& objects) {
  Eigen::MatrixXd cost =
      Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(measurements.size()),
                                static_cast<Eigen::Index>(objects.size()), kNever);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (measurements[i].moving) continue;
    const objects::Model measured = objects::transformed(T_world_lidar, measurements[i].model);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          cost_of(measured, objects[k].model);
    }
  }
  return objects::assign(cost, 1);
}

uncertainty::Sample sample_of_known(const objects::Measurement& measurement,
                                    const SE3& T_world_lidar, const KnownObject& object,
                                    const std::string& recording, double time_s) {
  objects::Measurement as_true = measurement;
  as_true.class_id = object.class_id;
  uncertainty::Sample sample =
      uncertainty::sample_of(as_true, objects::transformed(T_world_lidar, measurement.model),
                             object.model, T_world_lidar.translation());
  sample.recording = recording;
  sample.object_id = object.id;
  sample.kind = object.kind;
  sample.time_s = time_s;
  sample.view.reflectivity = measurement.reflectivity;
  return sample;
}

}  // namespace saker::tools
