#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saker/objects/object_map.h"
#include "tools/saker/replay/trajectory_truth.h"

/// A map against vehicles that a person labelled in single scans. Reads vehicles.json ({"listed":
/// [track], "vehicles": [{"track", "size" [l, w, h], "parked", "labels": [[scan, x, y, z, yaw,
/// points]]}]}, lidar frame, m, rad), the map and the trajectory of its run; makes what is found of
/// the listed vehicles, the errors of size, place and heading, how honest the map's covariances
/// are, and objects on paths of moving vehicles. Method: a parked vehicle's true place is the
/// median of the third of its labels with the most points, carried into the map's frame by the
/// run's own trajectory, so that drift is no error of the map.
namespace saker::tools {

struct VehicleLabel {
  std::size_t scan = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< of the centre, lidar frame, m
  double yaw = NAN;                                           ///< lidar frame, rad
  double points = 0;
};

struct LabelledVehicle {
  Eigen::Vector3d size = Eigen::Vector3d::Constant(NAN);  ///< length, width, height, m
  bool parked = false;
  std::vector<VehicleLabel> labels;
};

struct LabelledVehicles {
  std::map<int, LabelledVehicle> tracks;
  std::vector<int> listed;  ///< seen near and from several sides
};

/// Throws Error that names file and field.
[[nodiscard]] LabelledVehicles read_labelled_vehicles(const std::filesystem::path& file);

/// A listed vehicle and what the map says of it; errors are mapped − labelled.
struct VehicleResult {
  int track = 0;
  bool found = false;
  double position_error_m = NAN;  ///< horizontal distance
  double length_error_m = NAN, width_error_m = NAN;
  double heading_error_deg = NAN;  ///< of the axis, without its direction
  bool front_right = false;
  int duplicates = 0;
  double size_nees = NAN, place_nees = NAN;  ///< a degree of freedom; NaN without covariance
};

struct VehicleFigures {
  std::vector<VehicleResult> vehicles;  ///< in the order of the list
  int mapped = 0;                       ///< cuboids in the map
  int invented = 0;  ///< within 2 m of a moving vehicle's path, 3 m from every parked one

  [[nodiscard]] nlohmann::ordered_json json() const;  ///< null where none is found
};

/// \param poses  of every scan, in their order. \param label_sd_m  of a labelled length and width,
/// whose four faces err independently, so that its centre's is half of it: it goes into the NEES
/// beside the map's own covariance.
[[nodiscard]] VehicleFigures vehicle_figures(const objects::ObjectMap& map,
                                             const objects::ClassTable& table,
                                             const std::vector<StampedPose>& poses,
                                             const LabelledVehicles& labelled, double label_sd_m);

}  // namespace saker::tools
