#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "saker/autonomy/config.h"
#include "saker/autonomy/pipeline.h"
#include "saker/autonomy/schedule.h"
#include "saker/autonomy/worker_pool.h"
#include "saker/core/timings.h"
#include "saker/lidar/recording.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_map.h"

/// The lockstep driver: runs the stages over a recording or a simulated sensor in the sensor's time
/// and a fixed order.
///
///     scan ─▶ odometry (in order, this thread) ──────────────┐
///       └───▶ segmentation (side by side) ─▶ detection (side by side, a window of labelled scans)
///       ─▶ SLAM (in order)
///
/// Which scans are labelled and when a SLAM cycle is due follow from the stamps alone, every stage
/// is a function of its inputs, and SLAM takes its cycles in order: the result is the same to the
/// byte for any number of threads.
namespace saker::autonomy {

/// What became of one scan.
struct ScanRecord {
  std::string name;  ///< file stem or frame number
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  odometry::OdometryStatus status = odometry::OdometryStatus::refused;
  odometry::OdometryReason reason = odometry::OdometryReason::none;  ///< why it is not ok
  std::string fault;  ///< why it could not be read; empty otherwise
};

/// Hears what happens, in order, on the driver's thread.
class LockstepObserver {
 public:
  virtual ~LockstepObserver() = default;
  virtual void on_scan(const ScanRecord& record, const odometry::OdometryEstimate& estimate) = 0;
  virtual void on_detections(const objects::Detections& detections) = 0;
};

/// How sure the network was of the points of all labelled scans: of a sensor unlike those that it
/// was trained for it is not.
struct SegmentationFit {
  double probability = NAN;       ///< mean of each point's class's
  double classified_share = NAN;  ///< of the points that have another class than `other`
};

struct LockstepResult {
  std::vector<ScanRecord> scans;   ///< one for every scan that went in
  std::vector<SE3> T_world_lidar;  ///< beside `scans`: after SLAM
  objects::ObjectMap map;
  std::vector<objects::MapObject> tentative;  ///< slam.h: seen too seldom to be in the map
  SegmentationFit fit;
  int labelled_scans = 0;
  int slam_cycles = 0;
  int keyframes = 0;
};

class Lockstep {
 public:
  /// \param threads  in all, this one included; 1 runs everything here.
  /// Throws Error on an invalid configuration or a model that cannot be loaded.
  Lockstep(const Config& config, int threads, core::Timings& timings);
  ~Lockstep();

  /// Until the source ends. Never throws for what a recording contains.
  [[nodiscard]] LockstepResult run(lidar::ScanSource& source, LockstepObserver& observer);

 private:
  struct Stages;  // one a worker
  struct LabelledFuture {
    Time stamp;
    SE3 T_odom_lidar;
    std::shared_ptr<const std::vector<Eigen::Vector3f>> points;
    std::shared_future<std::shared_ptr<const lidar::Labels>> labels;
    std::shared_ptr<const std::vector<float>> reflectivity;
    Eigen::Vector3d sensor;
  };
  struct Cycle {
    slam::SlamInput input;
    std::shared_future<objects::Detections> detections;
  };

  void ingest(lidar::Frame frame, LockstepObserver& observer, LockstepResult& result);
  void start_segmentation(const std::shared_ptr<const lidar::Scan>& scan,
                          odometry::OdometryEstimate& estimate);
  void start_cycle(Time now);
  void count(const lidar::Scan& scan, const lidar::Labels& labels);  ///< from any thread
  [[nodiscard]] SegmentationFit fit() const;
  void finish_cycles(std::size_t most_pending, LockstepObserver& observer);

  Config config_;
  core::Timings& timings_;
  odometry::Odometry odometry_;
  FittedNoise noise_;
  slam::Slam slam_;
  Schedule segmentation_schedule_;
  Schedule slam_schedule_;
  MotionLog motion_log_;
  std::deque<LabelledFuture> window_;
  std::deque<Cycle> pending_;
  // Of finite points; integers, so that their order does not matter.
  std::atomic<std::int64_t> points_ = 0, classified_ = 0, probability_millionths_ = 0;
  WorkerPool<Stages> pool_;  // last: its threads use what stands above
};

}  // namespace saker::autonomy
