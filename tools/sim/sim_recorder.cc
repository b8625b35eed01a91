#include "tools/sim/sim_recorder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "saker/core/config_value.h"
#include "saker/core/error.h"
#include "saker/lidar/metadata.h"
#include "saker/objects/map_io.h"
#include "saker/simulation/mission/truth.h"

namespace saker::tools {
namespace {

constexpr Time kRowPeriod = kNanosecondsPerSecond / 20;

/// The executive's configuration as far as the site and the vehicle give it.
std::string site_yaml(const simulation::MissionFence& fence, const lidar::MountConfig& mount) {
  using core::value_text;
  return fmt::format(
      "# What the executive is told of this site and this vehicle.\n"
      "motion:\n"
      "  geofence:\n"
      "    lowest_m: {}\n"
      "    highest_m: {}\n"
      "    polygon_m: {}\n"
      "mount:\n"
      "  position_m: {}\n"
      "  rotation_deg: {}\n",
      value_text(fence.lowest_m), value_text(fence.highest_m), value_text(fence.polygon_m),
      value_text(mount.position_m), value_text(mount.rotation_deg));
}

}  // namespace

SimRecorder::SimRecorder(const std::filesystem::path& out, const simulation::MissionConfig& config,
                         const simulation::SimulatedVehicle& vehicle,
                         const lidar::SensorInfo& sensor)
    : out_(out), trajectory_(out / "trajectory_truth.txt"), flight_(out / "flight_truth.csv") {
  if (!flight_) throw Error("cannot write " + (out / "flight_truth.csv").string());
  flight_ << "t_s,x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,armed,mode,faults,collisions,events\n"
          << std::flush;
  core::write_file(out / "site.yaml", site_yaml(vehicle.site().fence, config.mount));
  objects::write_map(out / "prior.json", vehicle.site().prior, {});
  lidar::write_metadata(sensor, out / "metadata.json");
}

void SimRecorder::record(simulation::SimulatedVehicle& vehicle, const VehicleState& state) {
  if (vehicle.now() >= next_row_) {
    next_row_ = vehicle.now() + kRowPeriod;
    record_flight(vehicle.truth(), state);
  }
  for (const simulation::ScanTruth& scan : vehicle.take_scan_truth())
    trajectory_.write(simulation::tum_row(scan.stamp, scan.T_world_lidar));
}

void SimRecorder::record_flight(const simulation::VehicleTruth& truth, const VehicleState& state) {
  const Eigen::Vector3d p = truth.T_world_body.translation(), &v = truth.velocity;
  flight_ << fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:d},{},{},{},{}\n",
                         to_seconds(truth.stamp), p.x(), p.y(), p.z(), v.x(), v.y(), v.z(),
                         state.armed, to_string(state.mode), state.faults, truth.collisions,
                         truth.events_begun)
          << std::flush;
}

void SimRecorder::finish(const simulation::SimulatedVehicle& vehicle, const Run& run) {
  trajectory_.finish();
  objects::write_map(out_ / "truth.json", vehicle.true_map(), {});
  const simulation::VehicleTruth truth = vehicle.truth();
  const nlohmann::ordered_json figures = {{"collisions", truth.collisions},
                                          {"min_clearance_m", truth.min_clearance_m},
                                          {"nearest_label", truth.nearest_label},
                                          {"flight_time_s", truth.flight_time_s},
                                          {"path_m", truth.path_m},
                                          {"landed", run.landed},
                                          {"seed", run.seed},
                                          {"factor", run.factor},
                                          {"wall_s", run.wall_s},
                                          {"cpu_s", run.cpu_s},
                                          {"behind_s", run.behind_s},
                                          {"packets", run.packets},
                                          {"packets_refused", run.packets_refused}};
  core::write_file(out_ / "sim.json", figures.dump(1) + "\n");
}

}  // namespace saker::tools
