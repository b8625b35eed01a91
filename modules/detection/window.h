#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/core/time.h"
#include "saker/lidar/scan.h"
#include "saker/objects/class_table.h"

/// The labelled scans of the last seconds as one cloud, in a levelled frame: the last scan's
/// origin, z up by odometry's frame.
namespace saker::detection {

/// One scan as segmentation left it.
struct LabelledScan {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();  ///< at `stamp`
  std::shared_ptr<const std::vector<Eigen::Vector3f>>
      points;                                   ///< deskewed, in the lidar frame at `stamp`, m
  std::shared_ptr<const lidar::Labels> labels;  ///< one a point
  std::shared_ptr<const std::vector<float>> reflectivity = nullptr;  ///< one a point; may be absent
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< where beams start, lidar frame, m
};

struct WindowConfig {
  double range_m = 60;
  double least_probability = 0.4;
  int ground_stride = 3;
  int other_stride = 3;
  int beam_stride = 3;
  int most_points = 400000;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("range_m", range_m, {1, 150}, "m",
            "points farther from the sensor are left out: a vehicle holds few of them");
    v.field("least_probability", least_probability, {0, 1}, "",
            "of the label of an object's point; the ground takes all");
    v.field("ground_stride", ground_stride, {1, 100}, "points",
            "every which ground point is used: a plane needs few");
    v.field("other_stride", other_stride, {1, 100}, "points",
            "every which point of no object is used: what stands around trunks and poles");
    v.field("beam_stride", beam_stride, {1, 100}, "points",
            "every which beam is kept to tell what it went through");
    v.field("most_points", most_points, {1000, 10000000}, "points",
            "object points of one shape in a window; the rest is left out");
  }
};

/// An object's point.
struct ClassPoint {
  Eigen::Vector3f position;  ///< in the levelled frame
  float probability = 0;     ///< of its class
  objects::ClassId class_id = 0;
  std::uint16_t scan = 0;    ///< index into Window::sensors and seconds
  float reflectivity = NAN;  ///< 0 … 1; NaN where the scan has none
};

/// What a beam went through is free.
struct Beam {
  Eigen::Vector3f end;     ///< in the levelled frame
  std::uint16_t scan = 0;  ///< index into Window::sensors
};

struct Window {
  SE3 T_lidar_level = SE3::Identity();   ///< from the levelled frame to the last scan's
  std::vector<Eigen::Vector3d> sensors;  ///< where each scan was taken, levelled frame
  std::vector<double> seconds;           ///< ≤ 0, relative to the last scan
  std::vector<ClassPoint> cuboids;       ///< of classes that are cuboids
  std::vector<ClassPoint> cylinders;     ///< of classes that are cylinders
  std::vector<Eigen::Vector3f> ground;   ///< of classes that are planes
  std::vector<Eigen::Vector3f> others;   ///< of classes that are no object
  std::vector<Beam> beams;               ///< of all classes
};

/// Fills `window` from the scans, keeping its memory. Scans without points, with labels of another
/// length or a pose that is not finite, and points that are not finite, are skipped.
void gather(std::span<const LabelledScan> scans, const objects::ClassTable& table,
            const WindowConfig& config, Window& window);

}  // namespace saker::detection
