#include "tools/saker/picture/map_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tools/saker/picture/picture.h"

namespace saker::tools {
namespace {

constexpr double kMargin_m =
    15;  // shown around trajectory and objects: beyond it points say little
constexpr double kViewpoint_m = 0.4;  // radius of a ring: the vehicle's
constexpr double kDash_m = 0.3;
constexpr Colour kTruth = colours::kGrey;
constexpr Colour kRobots[] = {colours::kPurple, colours::kOrange, colours::kSky,
                              colours::kYellow, colours::kGreen,  colours::kInk};

Colour colour_of_robot(std::size_t robot) { return kRobots[robot % std::size(kRobots)]; }

Colour colour_of(const objects::ObjectClass& object_class) {
  if (object_class.shape == objects::Shape::cuboid) return colours::kBlue;
  return object_class.name == "pole" ? colours::kOrange : colours::kGreen;
}

std::vector<Eigen::Vector2d> flat(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> result;
  result.reserve(points.size());
  for (const Eigen::Vector3d& p : points) result.emplace_back(p.head<2>());
  return result;
}

Extent extent_of(const MapView& view) {
  Extent extent;
  for (const Eigen::Vector3d& p : view.trajectory) extent.include(p.head<2>());
  for (const RobotPath& robot : view.robots) {
    for (const Eigen::Vector3d& p : robot.positions) extent.include(p.head<2>());
  }
  for (const auto* list : {&view.map.objects, &view.tentative}) {
    for (const objects::MapObject& object : *list) {
      extent.include(objects::place(object.model).head<2>());
    }
  }
  return extent.grown(kMargin_m);
}

void draw(Picture& picture, const objects::Model& model, Colour colour, int width_px) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    picture.rectangle(cuboid->pose.translation().head<2>(), core::yaw(cuboid->pose.linear()),
                      cuboid->size.x(), cuboid->size.y(), colour, width_px);
  } else {
    const auto& cylinder = std::get<objects::Cylinder>(model);
    picture.circle(cylinder.root.head<2>(), cylinder.radius, colour, width_px);
  }
}

/// A closed outline in strokes as long as the gaps between them.
void draw_dashed(Picture& picture, const std::vector<Eigen::Vector2d>& corners, Colour colour) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - from;
    const int strokes = std::max(1, static_cast<int>(along.norm() / (2 * kDash_m)));
    const double part = 1. / (2 * strokes);
    for (int k = 0; k < strokes; ++k) {
      const std::array<Eigen::Vector2d, 2> stroke = {from + 2 * k * part * along,
                                                     from + (2 * k + 1) * part * along};
      picture.polyline(stroke, colour, 2);
    }
  }
}

/// The outline of an object's ground; of a cylinder at least as large as others are drawn.
std::vector<Eigen::Vector2d> outline(const objects::Model& model) {
  std::vector<Eigen::Vector2d> corners;
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const Eigen::Vector3d corner(0.5 * x * cuboid->size.x(), 0.5 * y * cuboid->size.y(), 0);
      corners.emplace_back((cuboid->pose * corner).head<2>());
    }
    return corners;
  }
  constexpr int kCorners = 8;
  const auto& cylinder = std::get<objects::Cylinder>(model);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * M_PI * i / kCorners;
    corners.emplace_back(cylinder.root.head<2>() + std::max(cylinder.radius, kDash_m) *
                                                       Eigen::Vector2d(cos(angle), sin(angle)));
  }
  return corners;
}

/// `Map from above: 3 vehicle, 2 trunk along 154 poses`.
std::string title_of(const MapView& view, const objects::ClassTable& table) {
  std::map<objects::ClassId, int> counts;
  for (const objects::MapObject& object : view.map.objects) ++counts[object.class_id];
  std::string title = "Map from above:";
  for (const auto& [id, count] : counts) title += fmt::format(" {} {},", count, table[id].name);
  if (counts.empty()) title += " no objects,";
  title.pop_back();
  std::size_t poses = view.trajectory.size();
  for (const RobotPath& robot : view.robots) poses += robot.positions.size();
  return title + fmt::format(" along {} poses", poses);
}

std::vector<LegendEntry> legend_of(const MapView& view) {
  std::vector<LegendEntry> legend = {{Mark::rectangle, colours::kBlue, "vehicle"},
                                     {Mark::ring, colours::kGreen, "trunk"},
                                     {Mark::ring, colours::kOrange, "pole"}};
  if (view.robots.empty()) {
    legend.push_back({Mark::line, colours::kPurple, "trajectory"});
  }
  for (std::size_t i = 0; i < view.robots.size(); ++i) {
    legend.push_back({Mark::line, colour_of_robot(i), view.robots[i].robot});
  }
  if (!view.viewpoints.empty()) {
    legend.push_back({Mark::ring, colours::kPurple, "viewpoint"});
  }
  if (!view.tentative.empty()) {
    legend.push_back({Mark::line, colours::kBlue, "dashed: seen too seldom for the map"});
  }
  if (view.truth != nullptr) legend.push_back({Mark::rectangle, kTruth, "truth"});
  return legend;
}

}  // namespace

void write_map_picture(const std::filesystem::path& file, const MapView& view,
                       const objects::ClassTable& table) {
  Picture picture(extent_of(view));
  picture.points(flat(view.cloud), colours::kInk);
  if (view.truth != nullptr) {
    for (const objects::MapObject& object : view.truth->objects) {
      draw(picture, object.model, kTruth, 4);
    }
  }
  if (!view.trajectory.empty()) picture.polyline(flat(view.trajectory), colours::kPurple);
  for (std::size_t i = 0; i < view.robots.size(); ++i) {
    picture.polyline(flat(view.robots[i].positions), colour_of_robot(i));
  }
  for (const Eigen::Vector3d& p : view.viewpoints) {
    picture.circle(p.head<2>(), kViewpoint_m, colours::kPurple, 3);
  }
  for (const objects::MapObject& object : view.map.objects) {
    draw(picture, object.model, colour_of(table[object.class_id]), 2);
  }
  for (const objects::MapObject& object : view.tentative) {
    draw_dashed(picture, outline(object.model), colour_of(table[object.class_id]));
  }
  picture.title(title_of(view, table));
  picture.legend(legend_of(view));
  picture.save(file);
}

}  // namespace saker::tools
