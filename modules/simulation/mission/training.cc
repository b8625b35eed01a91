#include "saker/simulation/mission/training.h"

#include <algorithm>
#include <cstdio>
#include <future>

#include "saker/core/files.h"
#include "saker/simulation/sensor/scan_effects.h"
#include "saker/simulation/sensor/scan_files.h"

namespace saker::simulation {
namespace {

/// Streams of a scan. Each is its own, so that another sensor changes neither place nor weather.
enum Stream : std::uint64_t { kMount, kWeather, kSensor, kEffects, kFile, kStreams };

constexpr double kWetShare = 0.15;  ///< of the worlds
constexpr double kVehicleFrame =
    0.06;                      ///< share of scans with the origin on the ground, as some publish
constexpr double kRaw = 0.35;  ///< of the scans that are not compensated for motion

std::uint64_t world_seed(const core::Rng& base, int world) {
  return static_cast<std::uint64_t>(base.fork(2 * static_cast<std::uint64_t>(world) + 1).uniform() *
                                    1e15);
}

/// How a scan was written.
struct FileKind {
  PointOrder order = PointOrder::rings;
  int packet_columns = 12;
  bool compensated = true;
  bool in_vehicle_frame = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of that frame in the vehicle's
};

FileKind any_file(core::Rng& rng) {
  FileKind file;
  file.order = static_cast<PointOrder>(rng.index(3));
  file.packet_columns = 2 + rng.index(24);
  file.compensated = !rng.chance(kRaw);
  file.in_vehicle_frame = rng.chance(kVehicleFrame);
  file.origin.x() = rng.uniform(-1.6, 0.4);
  file.origin.z() = rng.uniform(0, 0.4);
  return file;
}

struct TrainingScan {
  std::vector<ScanPoint> points;
  SE3 T_world_scan = SE3::Identity();
  std::string line;  ///< of sensors.csv, without the scan's name
};

std::string line_of(const SensorUnit& unit, const Mount& mount, const FileKind& file) {
  char line[160];
  std::snprintf(line, sizeof(line), "%s,%s,%.2f,%.2f,%s,%s,%s", unit.name.c_str(),
                name_of(mount.kind), mount.height_m, mount.speed_mps(),
                file.compensated ? "compensated" : "raw",
                file.in_vehicle_frame ? "vehicle" : "lidar", name_of(file.order));
  return line;
}

/// The points as the file has them: compensated or not, in the sensor's frame or the vehicle's.
void finish_points(const ScanSetting& setting, const FileKind& file, core::Rng& rng,
                   TrainingScan& out) {
  const int columns = setting.unit->beams.columns;
  const Mount& mount = *setting.mount;
  put_in_order(file.order, setting.unit->beams.rows, file.packet_columns, rng, out.points);
  out.T_world_scan = mount.pose(0);
  if (file.in_vehicle_frame) {
    out.T_world_scan = out.T_world_scan * mount.T_vehicle_lidar.inverse() *
                       placed(file.origin.x(), file.origin.y(), file.origin.z());
  }
  const SE3 T_scan_world = out.T_world_scan.inverse();
  const SE3 T_scan_lidar = T_scan_world * mount.pose(0);
  if (!file.compensated && !file.in_vehicle_frame) return;
  move_points(
      [&](int column) {
        return file.compensated ? T_scan_world * setting.T_world_lidar(column) : T_scan_lidar;
      },
      columns, out.points);
}

TrainingScan make_scan(const TrainingConfig& config, const BuiltWorld& built,
                       const RayCaster& caster, const core::Rng& base) {
  core::Rng mount_rng = base.fork(kMount);
  core::Rng weather_rng = base.fork(kWeather);
  core::Rng sensor_rng = base.fork(kSensor);
  core::Rng effects_rng = base.fork(kEffects);
  core::Rng file_rng = base.fork(kFile);
  const Mount mount = any_mount(built, mount_rng);
  ScanEffects effects = any_weather(mount, weather_rng);
  const SensorUnit unit = make_unit(any_sensor(config.sensor, sensor_rng), sensor_rng);
  add_sensor_effects(unit, effects, effects_rng);
  const FileKind file = any_file(file_rng);

  const int columns = unit.beams.columns;
  const auto pose = [&](int column) {
    return mount.pose((static_cast<double>(column) / columns - 0.5) * unit.period_s);
  };
  const Scanner scanner(caster, built.world, unit.beams, unit.receiver,
                        static_cast<std::uint64_t>(sensor_rng.index(1 << 30)));
  CastScan scan = scanner.cast(pose, 0);
  const ScanSetting setting{&caster, &built.world, &unit, &mount, pose};
  apply_effects(effects, setting, effects_rng, scan);
  TrainingScan out;
  out.points = points_of(scan, unit, effects.echo_share, effects_rng);
  out.line = line_of(unit, mount, file);
  finish_points(setting, file, file_rng, out);
  return out;
}

/// What is written, scan after scan.
class TrainingWriter {
 public:
  explicit TrainingWriter(const std::filesystem::path& folder) : folder_(folder), scans_(folder) {}

  void write(const TrainingScan& scan) {
    scans_.write(scan.points, scan.T_world_scan, from_seconds(0.1 * done_));
    char name[16];
    std::snprintf(name, sizeof(name), "%06d,", done_);
    table_ += name + scan.line + "\n";
    ++done_;
  }

  void finish() const {
    scans_.finish();
    core::write_file(folder_ / "sensors.csv", table_);
  }

  [[nodiscard]] int done() const { return done_; }

 private:
  std::filesystem::path folder_;
  LabelledScanWriter scans_;
  std::string table_ = "name,sensor,mount,height_m,speed_mps,motion,frame,order\n";
  int done_ = 0;
};

}  // namespace

void write_training_scans(const TrainingConfig& config, std::uint64_t seed,
                          const std::filesystem::path& folder, const Progress& progress,
                          int threads) {
  const TrainingConfig c = core::checked(config, "training");
  TrainingWriter writer(folder);
  const core::Rng base(seed);
  for (int w = 0; w < c.worlds; ++w) {
    const core::Rng of_world = base.fork(2 * static_cast<std::uint64_t>(w));
    BuiltWorld built = build_world(c.world, world_seed(base, w));
    core::Rng ground_rng = of_world.fork(0);
    if (ground_rng.chance(kWetShare)) wet_ground(built.world, ground_rng.uniform(0.3, 1));
    const RayCaster caster(built.world);
    const auto scan = [&](int k) {
      return make_scan(c, built, caster, of_world.fork(1 + static_cast<std::uint64_t>(k)));
    };
    for (int first = 0; first < c.scans_per_world; first += threads) {
      std::vector<std::future<TrainingScan>> ready;
      for (int k = first; k < std::min(first + threads, c.scans_per_world); ++k)
        ready.push_back(
            std::async(threads > 1 ? std::launch::async : std::launch::deferred, scan, k));
      for (std::future<TrainingScan>& result : ready) {
        writer.write(result.get());
        if (progress) progress(writer.done(), c.worlds * c.scans_per_world);
      }
    }
  }
  writer.finish();
}

}  // namespace saker::simulation
