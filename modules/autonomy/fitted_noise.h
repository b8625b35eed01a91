#pragma once

#include <memory>
#include <string>

#include "saker/objects/measurement.h"
#include "saker/objects/object_map.h"
#include "saker/slam/slam.h"
#include "saker/uncertainty/uncertainty.h"

namespace saker::autonomy {

struct UncertaintyConfig {
  std::string model = "models/uncertainty.yaml";

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("model", model, "",
              "What a measurement is worth by where it is seen from (YAML, made by saker "
              "characterise fit); a path as given, else below configs/.");
  }
};

/// Throws Error on a file that is missing or not valid.
[[nodiscard]] std::shared_ptr<const uncertainty::Model> load_uncertainty(
    const UncertaintyConfig& config, const objects::ClassTable& table);

/// A line for the log where the model was fitted to another sensor than the one that is there, or
/// to one that is not known; empty where it is the same. The model is used all the same: what
/// vehicles hide of themselves is alike for all sensors, and without it nothing takes biases off.
/// \param sensor  "OS1-64 512x10", model and mode (lidar::name_and_mode); empty: not known
[[nodiscard]] std::string sensor_note(const uncertainty::Provenance& fitted,
                                      const std::string& sensor);

/// What flights taught about measurements, between detection and SLAM: the fitted bias is taken off
/// each one and its covariance of [x, y, length, width] (cuboid) or of the root's x and y
/// (cylinder) is the fitted one. The rest stays as detection says, and so do measurements from a
/// view that was not flown and cuboids that were not seen from end to end: which end is hidden
/// varies with what stands around. An end that a window states badly is no better known than such
/// ends were (`slam.noise.fitted_end_sd_m`); a width that a window states worse than
/// `slam.noise.fitted_width_sd_m` keeps what the window states. All from one cell count once, those
/// that were left as they are beside the others. A class that the model does not know is left
/// alone.
///
/// On the way out, the map's covariances get what all measurements of an object share.
///
/// Source: the paper, "Uncertainty modeling", f^g. Cost: a few microseconds a measurement.
class FittedNoise {
 public:
  /// With `slam.measurement_noise: fixed` no measurement is changed; with `fitted` a model that is
  /// null is an Error.
  FittedNoise(const slam::SlamConfig& config, std::shared_ptr<const uncertainty::Model> model);

  /// \param detections in the lidar frame. \param R_odom_lidar at their stamp; odom's z is up.
  [[nodiscard]] objects::Detections applied(objects::Detections detections,
                                            const Eigen::Matrix3d& R_odom_lidar) const;

  /// Adds to the covariances of the map what all views of an object have in common, which the graph
  /// cannot know: of cuboids the model's where it knows the class, else what is configured in
  /// `slam.noise`. Of a cylinder the model's lies along the line of sight and turns with it: over a
  /// flight hardly anything of it is common.
  void add_common(objects::ObjectMap& map) const;

 private:
  [[nodiscard]] Eigen::MatrixXd common_of(const objects::MapObject& object) const;

  slam::MeasurementNoiseConfig noise_;
  std::shared_ptr<const uncertainty::Model> model_;  // null: fixed
};

}  // namespace saker::autonomy
