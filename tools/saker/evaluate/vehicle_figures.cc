#include "tools/saker/evaluate/vehicle_figures.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "saker/core/error.h"
#include "saker/core/statistics.h"
#include "tools/saker/evaluate/json_file.h"

namespace saker::tools {
namespace {

constexpr double kFoundWithin_m = 1.5;
constexpr double kOnPath_m = 2;          // so near a moving vehicle's path an object is its trace
constexpr double kBesideParked_m = 3;    // but not one so near a parked vehicle
constexpr std::size_t kLeastLabels = 3;  // for the median of a place

struct ParkedPlace {
  Eigen::Vector3d position;
  double yaw;
};

double wrapped(double angle, double period) {
  return angle - period * std::floor((angle + period / 2) / period);
}

/// In decimals, a half as its binary digits have it.
double rounded(double value, int digits) {
  return std::isfinite(value) ? std::stod(fmt::format("{:.{}f}", value, digits)) : value;
}
/// Labels are good to a decimetre: more digits than these would only look exact.
double to_mm(double metres) { return rounded(metres, 3); }

const SE3& pose_of(const std::vector<StampedPose>& poses, std::size_t scan) {
  if (scan < poses.size()) return poses[scan].T_world_lidar;
  throw Error(fmt::format("vehicles.json has a label in scan {}, the trajectory only {} poses",
                          scan, poses.size()));
}

ParkedPlace place_of(const LabelledVehicle& vehicle, const std::vector<StampedPose>& poses) {
  std::vector<VehicleLabel> labels = vehicle.labels;
  std::ranges::stable_sort(labels, std::greater{}, &VehicleLabel::points);
  labels.resize(std::min(labels.size(), std::max(kLeastLabels, labels.size() / 3)));
  std::array<std::vector<double>, 3> coordinates;
  std::complex<double> heading = 0;
  for (const VehicleLabel& label : labels) {
    const SE3& T = pose_of(poses, label.scan);
    const Eigen::Vector3d p = T * label.position;
    for (std::size_t k = 0; k < 3; ++k) coordinates[k].push_back(p[static_cast<int>(k)]);
    const Eigen::Vector3d ahead =
        T.linear() * Eigen::Vector3d(std::cos(label.yaw), std::sin(label.yaw), 0);
    heading += std::polar(1.0, std::atan2(ahead.y(), ahead.x()));
  }
  return {
      {core::median(coordinates[0]), core::median(coordinates[1]), core::median(coordinates[2])},
      std::arg(heading)};
}

using Mapped = std::vector<const objects::MapObject*>;

Mapped cuboids(const objects::ObjectMap& map, const objects::ClassTable& table) {
  Mapped result;
  for (const objects::MapObject& object : map.objects) {
    if (table[object.class_id].shape == objects::Shape::cuboid) result.push_back(&object);
  }
  return result;
}

Eigen::Vector2d at(const objects::MapObject& object) {
  return objects::place(object.model).head<2>();
}

void add_consistency(VehicleResult& result, const objects::MapObject& object,
                     const Eigen::Vector2d& size_error, const Eigen::Vector2d& place_error,
                     double label_sd_m) {
  if (object.covariance.size() == 0 || !object.covariance.allFinite()) return;
  const Eigen::Matrix2d label = Eigen::Matrix2d::Identity() * label_sd_m * label_sd_m;
  constexpr double kOfCentre = 0.25;  // (a + b) / 2 of faces that err alone, a size is a - b
  const Eigen::Matrix3d R = std::get<objects::Cuboid>(object.model).pose.linear();
  const Eigen::Matrix2d size = object.covariance.block<2, 2>(6, 6) + label;
  const Eigen::Matrix3d in_map = R * object.covariance.block<3, 3>(3, 3) * R.transpose();
  const Eigen::Matrix2d place = in_map.topLeftCorner<2, 2>() + kOfCentre * label;
  result.size_nees = size_error.dot(size.llt().solve(size_error)) / 2;
  result.place_nees = place_error.dot(place.llt().solve(place_error)) / 2;
}

void compare(VehicleResult& result, const objects::MapObject& object, const ParkedPlace& parked,
             const Eigen::Vector3d& size, double label_sd_m) {
  const auto& cuboid = std::get<objects::Cuboid>(object.model);
  const Eigen::Vector2d size_error = (cuboid.size - size).head<2>();
  const Eigen::Vector2d place_error = at(object) - parked.position.head<2>();
  const double turned = wrapped(core::yaw(cuboid.pose.linear()) - parked.yaw, 2 * std::numbers::pi);
  result.found = true;
  result.position_error_m = to_mm(place_error.norm());
  result.length_error_m = to_mm(size_error.x());
  result.width_error_m = to_mm(size_error.y());
  const double axis = std::abs(wrapped(turned, std::numbers::pi));
  result.heading_error_deg = rounded(axis * 180 / std::numbers::pi, 1);
  result.front_right = std::abs(turned) < std::numbers::pi / 2;
  add_consistency(result, object, size_error, place_error, label_sd_m);
}

/// Each in the order of the list takes the nearest that is left.
VehicleResult find(int track, const LabelledVehicle& vehicle, const ParkedPlace& parked,
                   const Mapped& mapped, std::set<const objects::MapObject*>& taken,
                   double label_sd_m) {
  VehicleResult result;
  result.track = track;
  const objects::MapObject* best = nullptr;
  double nearest = INFINITY;
  int near = 0;
  for (const objects::MapObject* object : mapped) {
    const double distance = (at(*object) - parked.position.head<2>()).norm();
    near += distance < kFoundWithin_m;
    if (taken.contains(object) || distance >= nearest) continue;
    nearest = distance;
    best = object;
  }
  if (nearest > kFoundWithin_m) return result;
  taken.insert(best);
  compare(result, *best, parked, vehicle.size, label_sd_m);
  result.duplicates = near - 1;
  return result;
}

double nearest_of(const std::vector<Eigen::Vector2d>& places, const Eigen::Vector2d& p) {
  double nearest = INFINITY;
  for (const Eigen::Vector2d& place : places) nearest = std::min(nearest, (place - p).norm());
  return nearest;
}

int count_invented(const Mapped& mapped, const std::vector<StampedPose>& poses,
                   const LabelledVehicles& labelled, const std::map<int, ParkedPlace>& parked) {
  std::vector<Eigen::Vector2d> paths, parked_places;
  for (const auto& [track, place] : parked) parked_places.emplace_back(place.position.head<2>());
  for (const auto& [track, vehicle] : labelled.tracks) {
    if (vehicle.parked) continue;
    for (const VehicleLabel& label : vehicle.labels) {
      paths.emplace_back((pose_of(poses, label.scan) * label.position).head<2>());
    }
  }
  return static_cast<int>(std::ranges::count_if(mapped, [&](const objects::MapObject* object) {
    return nearest_of(paths, at(*object)) < kOnPath_m &&
           nearest_of(parked_places, at(*object)) > kBesideParked_m;
  }));
}

nlohmann::ordered_json number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return rounded(value, digits);
}

LabelledVehicle read_vehicle(const JsonNode& entry) {
  LabelledVehicle vehicle;
  vehicle.size = Eigen::Vector3d(entry.at("size").numbers(3).data());
  vehicle.parked = entry.at("parked").boolean();
  entry.at("labels").each_element([&vehicle](const JsonNode& row) {
    const std::vector<double> v = row.numbers(6);
    vehicle.labels.push_back(
        {static_cast<std::size_t>(std::max(v[0], 0.0)), {v[1], v[2], v[3]}, v[4], v[5]});
  });
  return vehicle;
}

}  // namespace

LabelledVehicles read_labelled_vehicles(const std::filesystem::path& file) {
  const nlohmann::json document = read_json(file);
  const JsonNode root(document, file.string());
  LabelledVehicles result;
  root.at("vehicles").each_element([&result](const JsonNode& entry) {
    result.tracks[static_cast<int>(entry.at("track").number())] = read_vehicle(entry);
  });
  root.at("listed").each_element([&](const JsonNode& track) {
    result.listed.push_back(static_cast<int>(track.number()));
    const auto found = result.tracks.find(result.listed.back());
    if (found == result.tracks.end() || !found->second.parked || found->second.labels.empty()) {
      throw Error(fmt::format("{}: listed track {} is no parked vehicle with labels", file.string(),
                              result.listed.back()));
    }
  });
  return result;
}

VehicleFigures vehicle_figures(const objects::ObjectMap& map, const objects::ClassTable& table,
                               const std::vector<StampedPose>& poses,
                               const LabelledVehicles& labelled, double label_sd_m) {
  std::map<int, ParkedPlace> parked;
  for (const auto& [track, vehicle] : labelled.tracks) {
    if (vehicle.parked && !vehicle.labels.empty()) parked.emplace(track, place_of(vehicle, poses));
  }
  const Mapped mapped = cuboids(map, table);
  std::set<const objects::MapObject*> taken;
  VehicleFigures figures;
  figures.mapped = static_cast<int>(mapped.size());
  for (const int track : labelled.listed) {
    figures.vehicles.push_back(
        find(track, labelled.tracks.at(track), parked.at(track), mapped, taken, label_sd_m));
  }
  figures.invented = count_invented(mapped, poses, labelled, parked);
  return figures;
}

nlohmann::ordered_json VehicleFigures::json() const {
  std::vector<double> length, width, both, place, heading, size_nees, place_nees;
  int front_right = 0, duplicates = 0;
  for (const VehicleResult& v : vehicles) {
    if (!v.found) continue;
    length.push_back(v.length_error_m);
    width.push_back(v.width_error_m);
    both.insert(both.end(), {v.length_error_m, v.width_error_m});
    place.push_back(v.position_error_m);
    heading.push_back(v.heading_error_deg);
    front_right += v.front_right;
    duplicates += v.duplicates;
    if (!std::isfinite(v.size_nees)) continue;
    size_nees.push_back(v.size_nees);
    place_nees.push_back(v.place_nees);
  }
  return {{"found", place.size()},
          {"of", vehicles.size()},
          {"mapped_vehicles", mapped},
          {"invented_on_moving_paths", invented},
          {"size_mae_m", number(core::mean_absolute(both), 3)},
          {"length_bias_m", number(core::mean(length), 3)},
          {"width_bias_m", number(core::mean(width), 3)},
          {"position_mae_m", number(core::mean(place), 3)},
          {"yaw_mae_deg", number(core::mean(heading), 3)},
          {"front_right", front_right},
          {"duplicates", duplicates},
          {"size_nees", number(core::mean(size_nees), 2)},
          {"place_nees", number(core::mean(place_nees), 2)}};
}

}  // namespace saker::tools
