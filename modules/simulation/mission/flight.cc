#include "saker/simulation/mission/flight.h"

#include <cstdio>

#include "saker/core/files.h"
#include "saker/objects/map_io.h"
#include "saker/simulation/mission/capture_files.h"
#include "saker/simulation/mission/truth.h"
#include "saker/simulation/sensor/scan_files.h"

namespace saker::simulation {
namespace {

constexpr Time kStart = 1000 * kNanosecondsPerSecond;  ///< of the sensor's clock
constexpr double kScanPeriod = 0.1;

void drive(const FlightWorld& world, double t, RayCaster& caster) {
  for (const Driver& driver : world.drivers) {
    const SE3 T = world.built.terrain.on_ground(driver.start_s + driver.speed_mps * t, driver.d,
                                                driver.speed_mps > 0 ? 0 : M_PI);
    caster.move(driver.index, Eigen::Affine3d(T.matrix()).cast<float>());
  }
}

/// A flight under way: what is written scan by scan.
class Recorder {
 public:
  Recorder(const FlightConfig& config, std::uint64_t seed, const std::filesystem::path& folder)
      : config_(config), folder_(folder), capture_(folder, "flight", config.capture, seed) {
    if (config.labels) labels_ = std::make_unique<LabelledScanWriter>(folder);
    if (config.cast) std::filesystem::create_directories(folder / "cast");
  }

  void record(const CastScan& scan, int index, const SE3& T_world_lidar, Time start, Time stamp,
              std::span<const lidar::ImuSample> imu) {
    const SensorCapture::Ranges sent = capture_.write(scan, index + 1, start, imu);
    trajectory_ += tum_row(stamp, T_world_lidar);
    if (labels_) labels_->write(scan, T_world_lidar, stamp);
    if (!config_.cast) return;
    char name[16];
    std::snprintf(name, sizeof(name), "%06d.npy", index);
    core::write_npy(folder_ / "cast" / name, sent, scan.rows, scan.columns);
  }

  void finish() {
    capture_.finish();
    if (labels_) labels_->finish();
    core::write_file(folder_ / "trajectory_truth.txt", trajectory_);
  }

  [[nodiscard]] const lidar::SensorInfo& info() const { return capture_.info(); }

 private:
  FlightConfig config_;
  std::filesystem::path folder_;
  SensorCapture capture_;
  std::unique_ptr<LabelledScanWriter> labels_;
  std::string trajectory_;
};

std::span<const lidar::ImuSample> samples_in(const std::vector<lidar::ImuSample>& samples,
                                             Time from, Time to) {
  const auto before = [](const lidar::ImuSample& sample, Time time) { return sample.stamp < time; };
  const auto first = std::lower_bound(samples.begin(), samples.end(), from, before);
  const auto last = std::lower_bound(first, samples.end(), to, before);
  return {first, last};
}

}  // namespace

void write_flight(const FlightConfig& config, std::uint64_t seed,
                  const std::filesystem::path& folder,
                  const std::function<void(int done, int total)>& progress) {
  const FlightConfig c = core::checked(config, "flight");
  const core::Rng base(seed);
  core::Rng path_rng = base.fork(10);
  core::Rng imu_rng = base.fork(11);
  const FlightWorld flight_world = build_flight_world(c, seed);
  const BuiltWorld& built = flight_world.built;
  RayCaster caster(built.world);
  const FlightPath path(c, built.terrain, path_rng);
  Recorder recorder(c, seed, folder);
  const lidar::SensorInfo& info = recorder.info();
  const Scanner scanner(caster, built.world, ouster_beams(info), c.receiver, seed);
  const std::vector<lidar::ImuSample> imu =
      simulate_imu([&](double t) { return path.pose(t); }, c.imu, info.T_sensor_imu, c.duration_s,
                   kStart, imu_rng);

  const double last_column = info.column_window.last * info.column_period_s();
  const SE3 T_world_sim = levelled(path.pose(last_column)).inverse();
  std::vector<int> hits(built.world.objects.size() + 1, 0);
  const int scans = static_cast<int>(c.duration_s / kScanPeriod);
  for (int i = 0; i < scans; ++i) {
    const double t = i * kScanPeriod;
    const auto time_of = [&](int column) { return t + column * info.column_period_s(); };
    const CastScan scan =
        scanner.cast([&](int column) { return path.pose(time_of(column)); }, i,
                     [&](int column) { drive(flight_world, time_of(column), caster); });
    count_hits(built.world, scan, hits);
    const Time start = kStart + from_seconds(t);
    recorder.record(scan, i, T_world_sim * path.pose(t + last_column), start,
                    start + from_seconds(last_column),
                    samples_in(imu, start, start + from_seconds(kScanPeriod)));
    if (progress) progress(i + 1, scans);
  }
  recorder.finish();
  objects::write_map(folder / "truth.json", truth_map(built.world, T_world_sim, hits), {});
}

}  // namespace saker::simulation
