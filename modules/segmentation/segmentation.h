#pragma once

#include <string>

#include "saker/core/config.h"
#include "saker/lidar/scan.h"
#include "saker/objects/class_table.h"
#include "saker/segmentation/back_projection.h"
#include "saker/segmentation/features.h"
#include "saker/segmentation/network.h"
#include "saker/segmentation/object_pieces.h"
#include "saker/segmentation/range_image.h"

namespace saker::segmentation {

struct SegmentationConfig {
  std::string model = "models/segmentation.onnx";
  bool mirrored = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("model", model, "",
              "Weights of the network (ONNX), with their description beside them (.yaml); a path "
              "as given, else below configs/.");
    v.setting("mirrored", mirrored, "",
              "The network sees each image in a mirror, too, and the mean of both counts: better "
              "labels for twice the network's time.");
  }
};

/// Stage 2: reads a scan (lidar; deskewed or not, organised or not, any number of beams), makes the
/// class and its probability for every point (for detection).
///
/// Frames: the scan's lidar frame; up is found in the scan itself (ground_height.h) near where it
/// is said to be, so a tilted sensor at any height will do. Method: range image (range_image.h),
/// geometry per pixel (features.h), a small U-Net after RangeNet++ with the encoder and decoder cut
/// down, as the paper's sec. IV-A does (network.h; trained by tools/training on simulated scans
/// only), which sees the image and its mirror image, one decision for the pixels of an object
/// (object_pieces.h), back to the points (back_projection.h). A scan without finite points is all
/// `other` with probability 0. Cost: docs/real.md. One thread, one instance a thread; the same scan
/// gives the same bytes.
class Segmentation {
 public:
  /// Throws Error: a missing or wrong model, or a description that does not fit the class table.
  /// \param up  unit, lidar frame, to within 45°.
  Segmentation(const SegmentationConfig& config, const objects::ClassTable& table,
               const Eigen::Vector3f& up = Eigen::Vector3f::UnitZ());

  /// The classes are indices into the table.
  [[nodiscard]] lidar::Labels segment(const lidar::Scan& scan);

  /// A piece of the scan that may be of the family.
  struct SeenPiece {
    PieceFamily family;
    PieceFeatures features;
    std::vector<std::int32_t> points;  ///< of the scan, one a pixel
  };
  /// Those that segment() decides on: for the fit of how it does.
  [[nodiscard]] std::vector<SeenPiece> pieces(const lidar::Scan& scan);

 private:
  [[nodiscard]] const lidar::Scan& in_sensor_frame(const lidar::Scan& scan);
  [[nodiscard]] PixelProbabilities& probabilities();

  SegmentationConfig config_;
  Network network_;
  lidar::Scan moved_;
  RangeImage image_;
  Features features_;
  PixelProbabilities pixels_;
  ObjectPieces cylinders_, vehicles_;
  BackProjection back_projection_;
};

}  // namespace saker::segmentation
