#pragma once

#include <memory>
#include <span>
#include <vector>

#include "saker/detection/beams.h"
#include "saker/detection/clusters.h"
#include "saker/detection/ground.h"
#include "saker/detection/surroundings.h"
#include "saker/detection/trunk.h"
#include "saker/detection/vehicle.h"
#include "saker/detection/window.h"
#include "saker/objects/measurement.h"

/// Stage 3 — reads the labelled scans of the last seconds (from segmentation), makes ground planes,
/// cuboids and cylinders with covariance (for SLAM): the paper's virtual sensors.
///
/// Frames: everything is given in the lidar frame of the window's last scan. Inside, clouds lie in
/// a levelled frame (odometry's z is up, roughly), and each object in the frame of its local
/// ground. Method: paper, IV-A; ground and cylinders after Chen et al., "SLOAM", RA-L 2020;
/// clusters by DBSCAN (Ester et al., KDD 1996). Objects without ground near them are refused. Cost:
/// linear in labelled points, about 50 ms for ten scans of 120,000 on one thread.
namespace saker::detection {

struct DetectionConfig {
  double window_s = 1.0;
  double least_scan_share = 0.5;
  int most_splits = 2;
  double split_ratio = 0.6;
  WindowConfig window;
  GroundConfig ground;
  ClusterConfig vehicle_clusters = {0.1, 0.5, 6};
  VehicleConfig vehicle;
  ClusterConfig trunk_clusters = {0.05, 0.3, 6};
  TrunkConfig trunk;
  SurroundingsConfig surroundings;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("window_s", window_s, {0.05, 10}, "s",
            "scans that are accumulated (paper: 1 to 3); longer shows more sides, but odometry "
            "drifts within it");
    v.field("least_scan_share", least_scan_share, {0, 1}, "",
            "of the window's scans that must have seen an object: what stands is seen by all, what "
            "drives by leaves a "
            "piece in one, and false labels flicker");
    v.field("most_splits", most_splits, {0, 5}, "",
            "how often a cluster too large for one vehicle is clustered again, more finely");
    v.field("split_ratio", split_ratio, {0.1, 0.95}, "",
            "of DBSCAN's reach from one split to the next");
    v.group("window", window, "accumulation of scans");
    v.group("ground", ground, "local ground planes");
    v.group("vehicle_clusters", vehicle_clusters, "clusters of vehicle points");
    v.group("vehicle", vehicle, "cuboids");
    v.group("trunk_clusters", trunk_clusters, "clusters of trunk and pole points");
    v.group("trunk", trunk, "cylinders");
    v.group("surroundings", surroundings, "what stands around trunks and poles");
  }
};

class Detection {
 public:
  /// Throws Error on an invalid value.
  Detection(const DetectionConfig& config, const objects::ClassTable& table);

  /// \param window in the order of time. An empty one gives no detections.
  [[nodiscard]] objects::Detections detect(std::span<const LabelledScan> window);

 private:
  using Indices = std::vector<int>;

  /// Points of one shape that an object is made of, and what else lies inside its model.
  struct Inside {
    const std::vector<ClassPoint>& points;
    const Indices& indices;
    int others = 0;
  };

  void detect_vehicles(objects::Detections& result);
  void detect_trunks(objects::Detections& result);
  void add_vehicle(const Indices& indices, int splits, objects::Detections& result);
  void split_vehicle(const Indices& indices, int splits, objects::Detections& result);
  void add_trunk(const Indices& indices, objects::Detections& result);
  [[nodiscard]] bool stands_free(const Indices& indices, const objects::Cylinder& cylinder) const;
  [[nodiscard]] bool seen_often(const std::vector<ClassPoint>& points,
                                const Indices& indices) const;
  void keep_above_ground(std::vector<ClassPoint>& points, double lowest, double highest) const;
  [[nodiscard]] std::vector<Indices> clusters(const std::vector<ClassPoint>& points,
                                              const Indices* of, const ClusterConfig& config);
  [[nodiscard]] std::vector<double> class_probability(const Inside& inside) const;
  /// A measurement that has its classes, and lacks the model.
  [[nodiscard]] objects::Measurement classified(std::vector<double> class_probability, int points,
                                                Time stamp) const;
  /// Bayes' rule: the odds of trunks against poles by what stands around the upper part.
  void weigh_crown(double odds, std::vector<double>& class_probability) const;

  DetectionConfig config_;
  objects::ClassTable table_;
  Window window_;
  VehicleKinds kinds_;
  std::unique_ptr<const VehicleFitter> fitter_;
  Ground ground_;
  Surroundings surroundings_;
  Beams beams_;
  Clusters clusters_;
  std::vector<Eigen::Vector2f> places_;
};

}  // namespace saker::detection
