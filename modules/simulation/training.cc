#include "simulation/training.h"

#include <cmath>
#include <numbers>

#include "simulation/scan_files.h"
#include "simulation/world_builder.h"

namespace saker::simulation {
namespace {

SE3 tilted(const SE3& T, double roll, double pitch) {
  SE3 tilt = SE3::Identity();
  tilt.linear() = (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return T * tilt;
}

Eigen::Vector2d any_place(const BuiltWorld& built, core::Rng& rng) {
  if (built.free_places.empty()) return Eigen::Vector2d::Zero();
  return built.free_places[rng.index(static_cast<int>(built.free_places.size()))];
}

/// On the roof of a car that stands on the road.
SE3 pose_on_car(const BuiltWorld& built, core::Rng& rng) {
  const Eigen::Vector2d place = any_place(built, rng);
  const double yaw = (rng.chance(0.5) ? 0 : std::numbers::pi) + rng.normal(0, 0.15);
  const SE3 T_world_ground = built.terrain.on_ground(place.x(), place.y(), yaw);
  const double height = rng.chance(0.7) ? rng.normal(1.73, 0.04) : rng.uniform(1.4, 2.3);
  const double roll = rng.normal(0, 0.01);
  return tilted(T_world_ground * placed(0, 0, height), roll, rng.normal(0, 0.012));
}

/// Below a vehicle that flies, or in a hand.
SE3 pose_in_air(const BuiltWorld& built, core::Rng& rng) {
  const Eigen::Vector2d place = any_place(built, rng);
  const double height = 0.8 * std::exp(rng.uniform() * std::log(12 / 0.8));
  const SE3 T =
      built.terrain.upright(place.x(), place.y(), rng.uniform(-std::numbers::pi, std::numbers::pi));
  const double roll = rng.normal(0, 0.09);
  return tilted(T * placed(0, 0, height), roll, rng.normal(0, 0.09));
}

std::uint64_t world_seed(const core::Rng& base, int world) {
  return static_cast<std::uint64_t>(base.fork(2 * static_cast<std::uint64_t>(world) + 1).uniform() *
                                    1e15);
}

struct Sensor {
  BeamTable beams;
  ReceiverConfig receiver;
};

Sensor hdl64(core::Rng& rng) { return {hdl64_beams(rng), hdl64_receiver()}; }

Sensor os1() {
  return {ouster_beams(lidar::SensorInfo::make_os1(64, 1024, lidar::PacketProfile::kLegacy)), {}};
}

/// Blanks what the car under the sensor hides: a few patches of the lowest beams.
void hide_own_car(CastScan& scan, core::Rng& rng) {
  const int patches = rng.index(8);
  for (int k = 0; k < patches; ++k) {
    const double column = rng.uniform(0, scan.columns);
    const double row = scan.rows * rng.uniform(0.78, 1.02);
    const double half_width = scan.columns * rng.uniform(0.008, 0.05);
    const double half_height = scan.rows * rng.uniform(0.06, 0.16);
    for (int i = 0; i < scan.rows; ++i) {
      const double up = (i - row) / half_height;
      if (std::abs(up) >= 1) continue;
      const double ragged = half_width * std::sqrt(1 - up * up) * rng.uniform(0.8, 1.2);
      for (int c = static_cast<int>(column - ragged); c < column + ragged; ++c) {
        const int wrapped = (c + scan.columns) % scan.columns;
        scan.range_m[static_cast<std::size_t>(i) * scan.columns + wrapped] = 0;
      }
    }
  }
}

}  // namespace

void write_training_scans(const TrainingConfig& config, std::uint64_t seed,
                          const std::filesystem::path& folder, const Progress& progress) {
  const TrainingConfig c = core::checked(config, "training");
  LabelledScanWriter writer(folder);
  const core::Rng base(seed);
  int done = 0;
  for (int w = 0; w < c.worlds; ++w) {
    const BuiltWorld built = build_world(c.world, world_seed(base, w));
    const RayCaster caster(built.world);
    core::Rng rng = base.fork(2 * w);
    for (int k = 0; k < c.scans_per_world; ++k) {
      const bool on_car = rng.chance(c.hdl64_share);
      const SE3 T_world_lidar = on_car ? pose_on_car(built, rng) : pose_in_air(built, rng);
      Sensor sensor = on_car ? hdl64(rng) : os1();
      const Scanner scanner(caster, built.world, std::move(sensor.beams), sensor.receiver,
                            static_cast<std::uint64_t>(rng.index(1 << 30)));
      CastScan scan = scanner.cast([&](int) { return T_world_lidar; }, k);
      if (on_car) hide_own_car(scan, rng);
      writer.write(scan, T_world_lidar, from_seconds(0.1 * done));
      ++done;
      if (progress) progress(done, c.worlds * c.scans_per_world);
    }
  }
  writer.finish();
}

}  // namespace saker::simulation
