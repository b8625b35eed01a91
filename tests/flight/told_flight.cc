#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "saker/autonomy/team_config.h"
#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/packed_history.h"
#include "saker/objects/map_io.h"
#include "saker/simulation/mission/mission_world.h"
#include "saker/simulation/mission/scenario.h"
#include "saker/simulation/mission/truth.h"

/// What another robot tells of the site of saker-sim without having to fly: the target farthest
/// from take-off, as it truly is, and a pole that nobody else comes to, seen along a short path.
///   told_flight ROBOT SCENARIO OUT
/// Writes OUT/history.bin, a flight whose take-off was surveyed in a base that is the `world` of
/// saker-sim's vehicle, and OUT/objects.json, what it saw. Prints the target's id.
namespace saker::flight {
namespace {

constexpr std::uint64_t kSeed = 1;  // saker-sim's default
constexpr int kKeyframes = 12;
constexpr double kSize_sd = 0.05, kPlace_sd = 0.05, kTurn_sd = 0.02;  // m, rad: of a measurement

objects::MapObject farthest_target(const simulation::MissionWorld& site) {
  const std::vector<int> unhit(site.world().objects.size() + 1, 0);
  const objects::ObjectMap truth =
      simulation::truth_map(site.world(), site.T_sim_world.inverse(), unhit);
  objects::MapObject farthest;
  double most = -1;
  for (const objects::MapObject& object : truth.objects) {
    const double away = objects::place(object.model).norm();
    if (std::ranges::count(site.targets, object.id) == 0 || away <= most) continue;
    farthest = object;
    most = away;
  }
  return farthest;
}

objects::MapObject pole(const objects::ClassTable& table) {
  objects::MapObject object;
  object.id = 1000;
  object.class_id = table.find("pole");
  object.model = objects::Cylinder{{80, 60, -0.5}, Eigen::Vector3d::UnitZ(), 0.1, 6};
  return object;
}

objects::Measurement measured(const objects::MapObject& object, const SE3& T_lidar_world,
                              const objects::ClassTable& table) {
  objects::Measurement measurement;
  measurement.class_id = object.class_id;
  measurement.class_probability.assign(static_cast<std::size_t>(table.size()), 0);
  measurement.class_probability[static_cast<std::size_t>(object.class_id)] = 1;
  measurement.model = objects::transformed(T_lidar_world, object.model);
  if (std::holds_alternative<objects::Cuboid>(object.model)) {
    Vector9d sd;
    sd << Eigen::Vector3d::Constant(kTurn_sd), Eigen::Vector3d::Constant(kPlace_sd),
        Eigen::Vector3d::Constant(kSize_sd);
    measurement.covariance = sd.cwiseAbs2().asDiagonal();
  } else {
    Vector6d sd;
    sd << Eigen::Vector3d::Constant(kPlace_sd), kTurn_sd, kTurn_sd, kSize_sd;
    measurement.covariance = sd.cwiseAbs2().asDiagonal();
  }
  return measurement;
}

/// Past each object, half the keyframes a metre apart beside it.
slam::History past(const std::vector<objects::MapObject>& objects, const std::string& robot,
                   const objects::ClassTable& table) {
  slam::History history{robot, 1, {}};
  for (int k = 0; k < kKeyframes; ++k) {
    const objects::MapObject& object = objects[static_cast<std::size_t>(2 * k / kKeyframes)];
    slam::HistoryEntry& entry = history.entries.emplace_back();
    entry.stamp = from_seconds(10 + 2 * k);
    entry.T_odom_lidar.translation() =
        objects::place(object.model) + Eigen::Vector3d(k % (kKeyframes / 2), 6, 2);
    entry.motion_covariance = 1e-5 * Matrix6d::Identity();
    entry.measurements.push_back(measured(object, entry.T_odom_lidar.inverse(), table));
  }
  return history;
}

void tell(const std::string& robot, const std::string& scenario, const std::filesystem::path& out) {
  const auto config = core::load_config<simulation::Scenario>(scenario, {});
  const objects::ClassTable table;
  const objects::MapObject target =
      farthest_target(simulation::build_mission_world(config.mission, kSeed));
  const std::vector<objects::MapObject> seen = {target, pole(table)};
  const slam::PosePrior takeoff{SE3::Identity(), autonomy::covariance_of({})};
  std::filesystem::create_directories(out);
  core::write_file(out / "history.bin",
                   exchange::packed(past(seen, robot, table), table.size(), takeoff));
  objects::write_map(out / "objects.json", {.frame = "base", .objects = seen, .ground = {}}, table);
  std::cout << target.id << "\n";
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    saker::flight::tell(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
