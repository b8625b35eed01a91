#pragma once

#include "core/config.h"
#include "detection/detection.h"
#include "objects/class_table.h"
#include "odometry/odometry.h"
#include "segmentation/segmentation.h"
#include "slam/slam.h"

namespace saker::autonomy {

/// How often the stages behind odometry run, by the stamps of the scans.
struct RateConfig {
  double segmentation_hz = 5;
  double slam_hz = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("segmentation_hz", segmentation_hz, {0.5, 20}, "Hz",
            "scans that get labels; 5 keeps a window of 1 s at five views and costs half a thread");
    v.field("slam_hz", slam_hz, {0.1, 10}, "Hz",
            "detection and SLAM cycles: the rate of the flown loop");
  }
};

/// The whole configuration: the file has this shape.
struct Config {
  objects::ClassTable objects;
  odometry::OdometryConfig odometry;
  segmentation::SegmentationConfig segmentation;
  detection::DetectionConfig detection;
  slam::SlamConfig slam;
  RateConfig rates;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("objects", objects, "the classes");
    v.group("odometry", odometry, "scan to local map");
    v.group("segmentation", segmentation, "range-image network");
    v.group("detection", detection, "virtual sensors: ground, vehicles, trunks and poles");
    v.group("slam", slam, "object SLAM");
    v.group("rates", rates, "how often the stages run");
  }
};

}  // namespace saker::autonomy
