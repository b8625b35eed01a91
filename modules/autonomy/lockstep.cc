#include "saker/autonomy/lockstep.h"

#include <utility>

#include "saker/autonomy/label_counts.h"

namespace saker::autonomy {
namespace {

/// Cycles that may wait for their detections: bounds the scans held in memory to a few seconds.
constexpr std::size_t kMostPendingCycles = 4;

/// A recording chooses no views: without fitted noise it needs no model.
std::shared_ptr<const uncertainty::Model> model_for_noise(const Config& config) {
  if (config.slam.measurement_noise == slam::NoiseSource::fixed) return nullptr;
  return uncertainty_for(config);
}

}  // namespace

struct Lockstep::Stages {
  segmentation::Segmentation segmentation;
  detection::Detection detection;
};

Lockstep::Lockstep(const Config& config, int threads, core::Timings& timings)
    : config_(config),
      timings_(timings),
      odometry_(config.odometry),
      noise_(config.slam, model_for_noise(config)),
      slam_(config.slam, config.objects),
      segmentation_schedule_(config.rates.segmentation_hz),
      slam_schedule_(config.rates.slam_hz),
      pool_(threads - 1, [this] {
        return std::unique_ptr<Stages>(
            new Stages{segmentation::Segmentation(config_.segmentation, config_.objects),
                       detection::Detection(config_.detection, config_.objects)});
      }) {}

Lockstep::~Lockstep() = default;

LockstepResult Lockstep::run(lidar::ScanSource& source, LockstepObserver& observer) {
  LockstepResult result;
  while (auto frame = source.next()) ingest(std::move(*frame), observer, result);
  finish_cycles(0, observer);
  result.T_world_lidar.reserve(result.scans.size());
  for (const ScanRecord& scan : result.scans) {
    result.T_world_lidar.push_back(slam_.corrected(scan.stamp, scan.T_odom_lidar));
  }
  result.map = slam_.reported_map();
  noise_.add_common(result.map);
  result.tentative = slam_.tentative();
  result.fit = fit();
  result.keyframes = static_cast<int>(slam_.keyframes().size());
  return result;
}

void Lockstep::ingest(lidar::Frame frame, LockstepObserver& observer, LockstepResult& result) {
  auto scan = std::make_shared<const lidar::Scan>(std::move(frame.scan));
  odometry::OdometryEstimate estimate =
      timings_.time("odometry", [&] { return odometry_.register_scan(*scan, frame.imu); });
  result.scans.push_back({frame.name, scan->stamp, estimate.T_odom_lidar, estimate.status,
                          estimate.reason, frame.fault});
  observer.on_scan(result.scans.back(), estimate);
  if (estimate.status == odometry::OdometryStatus::refused) return;

  motion_log_.add(estimate.stamp, estimate.T_odom_lidar, estimate.covariance);
  if (!registered(estimate.status)) return;  // where a prediction was seen from is not known
  if (!segmentation_schedule_.due(scan->stamp)) return;
  start_segmentation(scan, estimate);
  ++result.labelled_scans;
  if (!slam_schedule_.due(scan->stamp)) return;
  start_cycle(estimate.stamp);
  ++result.slam_cycles;
  finish_cycles(kMostPendingCycles, observer);
}

void Lockstep::start_segmentation(const std::shared_ptr<const lidar::Scan>& scan,
                                  odometry::OdometryEstimate& estimate) {
  auto labels = pool_.submit([this, scan](Stages& stages) {
    return timings_.time("segmentation", [&] {
      auto labelled = std::make_shared<const lidar::Labels>(stages.segmentation.segment(*scan));
      count(*scan, *labelled);
      return labelled;
    });
  });
  auto points = std::make_shared<const std::vector<Eigen::Vector3f>>(std::move(estimate.points));
  window_.push_back({scan->stamp,
                     estimate.T_odom_lidar,
                     std::move(points),
                     std::move(labels),
                     {scan, &scan->reflectivity},
                     scan->T_lidar_sensor.translation().cast<double>()});
}

void Lockstep::count(const lidar::Scan& scan, const lidar::Labels& labels) {
  const LabelCounts counts = counted(scan.points, labels);
  points_ += counts.points;
  classified_ += counts.classified;
  probability_millionths_ += counts.probability_millionths;
}

SegmentationFit Lockstep::fit() const {
  const LabelCounts sum{points_, classified_, probability_millionths_};
  if (sum.points == 0) return {};
  const auto points = static_cast<double>(sum.points);
  return {.probability = static_cast<double>(sum.probability_millionths) / points / 1e6,
          .classified_share = sum.classified_share()};
}

/// Called when the newest scan has just been labelled: the detections are given in its frame.
void Lockstep::start_cycle(Time now) {
  const Time oldest = now - from_seconds(config_.detection.window_s);
  while (window_.front().stamp < oldest) window_.pop_front();

  const std::vector<LabelledFuture> window(window_.begin(), window_.end());
  auto detections = pool_.submit([this, window](Stages& stages) {
    std::vector<detection::LabelledScan> scans;
    for (const LabelledFuture& scan : window) {
      scans.push_back({scan.stamp, scan.T_odom_lidar, scan.points, scan.labels.get(),
                       scan.reflectivity, scan.sensor});
    }
    return timings_.time("detection", [&] { return stages.detection.detect(scans); });
  });
  pending_.push_back({{window.back().stamp, window.back().T_odom_lidar, motion_log_.take(now), {}},
                      std::move(detections)});
}

void Lockstep::finish_cycles(std::size_t most_pending, LockstepObserver& observer) {
  while (pending_.size() > most_pending) {
    Cycle& cycle = pending_.front();
    cycle.input.detections = cycle.detections.get();
    observer.on_detections(cycle.input.detections);
    cycle.input.detections =
        noise_.applied(std::move(cycle.input.detections), cycle.input.T_odom_lidar.linear());
    timings_.time("slam", [&] {
      return slam_.update(cycle.input, core::Budget::iterations(config_.slam.graph.iterations));
    });
    pending_.pop_front();
  }
}

}  // namespace saker::autonomy
