#include "tools/saker/picture/scan_picture.h"

#include <cmath>

#include "saker/core/se3.h"
#include "saker/segmentation/range_image.h"
#include "tools/saker/picture/picture.h"

namespace saker::tools {
namespace {

constexpr double kReach_m = 40;     // shown around the sensor: farther out points are too sparse
constexpr double kFarRange_m = 60;  // brightest
constexpr Colour kNoReturn{255, 255, 255};
constexpr Colour kOther{190, 196, 204};
constexpr Colour kGroundPoint{214, 200, 170};
constexpr Colour kPlane{235, 215, 170};

Colour colour_of(const objects::ObjectClass& object_class) {
  switch (object_class.shape) {
    case objects::Shape::none:
      return kOther;
    case objects::Shape::cuboid:
      return colours::kBlue;
    case objects::Shape::cylinder:
      return object_class.name == "pole" ? colours::kOrange : colours::kGreen;
    case objects::Shape::plane:
      break;
  }
  return kGroundPoint;
}

/// The image with a colour for the point that each pixel shows.
template <class ColourOf>
Raster raster(const segmentation::RangeImage& image, ColourOf colour) {
  Raster result{image.rows, image.columns, {}};
  for (std::size_t i = 0; i < image.size(); ++i) {
    result.pixels.push_back(image.valid(i) && image.point[i] >= 0 ? colour(i) : kNoReturn);
  }
  return result;
}

void add_strips(Picture& picture, const ScanView& view, const objects::ClassTable& table) {
  segmentation::RangeImage image;
  segmentation::project(view.scan, image);
  picture.strip(
      raster(image, [&](std::size_t i) { return ramp(std::sqrt(image.range[i] / kFarRange_m)); }),
      "range: dark near, bright from 60 m; columns clockwise");
  picture.strip(
      raster(image,
             [&](std::size_t i) { return colour_of(table[view.labels.classes[image.point[i]]]); }),
      "class");
}

/// The window's points of one class, in the last scan's frame.
std::vector<Eigen::Vector2d> points_of(const ScanView& view, objects::ClassId wanted) {
  std::vector<Eigen::Vector2d> points;
  const SE3 T_lidar_odom = view.window.back().T_odom_lidar.inverse();
  for (const detection::LabelledScan& scan : view.window) {
    const SE3 T = T_lidar_odom * scan.T_odom_lidar;
    for (std::size_t i = 0; i < scan.points->size(); ++i) {
      if (scan.labels->classes[i] != wanted) continue;
      points.emplace_back((T * (*scan.points)[i].cast<double>()).head<2>());
    }
  }
  return points;
}

void draw(Picture& picture, const objects::Measurement& measurement, Colour colour) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&measurement.model)) {
    const double turned = measurement.front_log_odds < 0 ? M_PI : 0;  // the stroke ends in front
    picture.rectangle(cuboid->pose.translation().head<2>(),
                      core::yaw(cuboid->pose.linear()) + turned, cuboid->size.x(), cuboid->size.y(),
                      colour, 2);
  } else {
    const auto& cylinder = std::get<objects::Cylinder>(measurement.model);
    picture.circle(cylinder.root.head<2>(), cylinder.radius, colour, 2, 6);
  }
}

Extent extent() {
  return {Eigen::Vector2d::Constant(-kReach_m), Eigen::Vector2d::Constant(kReach_m)};
}

void draw_top_view(Picture& picture, const ScanView& view, const objects::ClassTable& table) {
  for (int id = 0; id < table.size(); ++id) {
    const auto class_id = static_cast<objects::ClassId>(id);
    const bool object = table[class_id].shape == objects::Shape::cuboid ||
                        table[class_id].shape == objects::Shape::cylinder;
    picture.points(points_of(view, class_id), colour_of(table[class_id]), object ? 0.6 : 0.25);
  }
  for (const objects::GroundPlane& plane : view.detections.ground) {
    if (extent().low.x() < plane.point.x() && plane.point.x() < extent().high.x() &&
        extent().low.y() < plane.point.y() && plane.point.y() < extent().high.y()) {
      picture.circle(plane.point.head<2>(), 0.3 * plane.radius, kPlane, 1);
    }
  }
  for (const objects::Measurement& measurement : view.detections.measurements) {
    draw(picture, measurement, measurement.moving ? colours::kPurple : colours::kInk);
  }
  picture.disc(Eigen::Vector2d::Zero(), 5, colours::kYellow);
}

}  // namespace

void write_scan_picture(const std::filesystem::path& file, const ScanView& view,
                        const objects::ClassTable& table) {
  Picture picture(extent());
  draw_top_view(picture, view, table);
  add_strips(picture, view, table);
  picture.title(view.title);
  picture.legend({{Mark::dot, colours::kBlue, "vehicle"},
                  {Mark::dot, colours::kGreen, "trunk"},
                  {Mark::dot, colours::kOrange, "pole"},
                  {Mark::dot, kGroundPoint, "ground"},
                  {Mark::rectangle, colours::kInk, "fitted model"},
                  {Mark::rectangle, colours::kPurple, "moving"},
                  {Mark::ring, kPlane, "ground plane"},
                  {Mark::dot, colours::kYellow, "sensor"}});
  picture.save(file);
}

}  // namespace saker::tools
