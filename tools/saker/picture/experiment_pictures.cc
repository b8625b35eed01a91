#include "tools/saker/picture/experiment_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "saker/objects/map_io.h"
#include "tools/saker/picture/picture.h"
#include "tools/saker/replay/trajectory_truth.h"

namespace saker::tools {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr Colour kColours[] = {colours::kBlue, colours::kOrange, colours::kGreen, colours::kPurple,
                               colours::kSky};

Colour colour_of(std::size_t i) { return kColours[i % std::size(kColours)]; }

// The distribution, in metres of the picture.
constexpr double kBin = 0.05;
constexpr double kReach = 1.0;    ///< larger errors count in the last bins
constexpr double kHighest = 1.0;  ///< of the tallest column

std::vector<double> shares_of(const std::vector<double>& errors) {
  const int bins = static_cast<int>(std::lround(2 * kReach / kBin));
  std::vector<double> shares(static_cast<std::size_t>(bins), 0);
  for (const double error : errors) {
    const int bin = std::clamp(static_cast<int>((error + kReach) / kBin), 0, bins - 1);
    shares[static_cast<std::size_t>(bin)] += 1.0 / static_cast<double>(errors.size());
  }
  return shares;
}

/// Stairs over the bins, `scale` m of picture for all errors in one.
Points stairs(const std::vector<double>& shares, double scale) {
  Points line;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double x = -kReach + kBin * static_cast<double>(i);
    line.emplace_back(x, scale * shares[i]);
    line.emplace_back(x + kBin, scale * shares[i]);
  }
  return line;
}

void draw_error_axis(Picture& picture) {
  picture.polyline(Points{{-kReach, 0}, {kReach, 0}}, colours::kInk, 1);
  picture.polyline(Points{{0, 0}, {0, kHighest}}, colours::kGrey, 1);
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    picture.text({x - kBin, -kBin}, fmt::format("{:+.1f} m", x), colours::kInk);
  }
}

/// A run as it is drawn, moved into its place.
struct Drawn {
  std::string title;
  Points path;
  std::vector<objects::Cuboid> vehicles, targets;
  Extent extent;  ///< of path and targets
};

Drawn read_panel(const TrajectoryPanel& panel, const objects::ClassTable& table) {
  constexpr double kAround = 8;  // m
  Drawn drawn;
  drawn.title = panel.title;
  std::set<int> wanted;
  for (const auto& target : objects::read_map(panel.folder / "prior.json", table).objects) {
    wanted.insert(target.id);
  }
  for (const StampedPose& pose : read_trajectory(panel.folder / "trajectory_truth.txt")) {
    drawn.path.emplace_back(pose.T_world_lidar.translation().head<2>());
    drawn.extent.include(drawn.path.back());
  }
  for (const auto& object : objects::read_map(panel.folder / "truth.json", table).objects) {
    const auto* cuboid = std::get_if<objects::Cuboid>(&object.model);
    if (cuboid == nullptr) continue;
    (wanted.contains(object.id) ? drawn.targets : drawn.vehicles).push_back(*cuboid);
    if (wanted.contains(object.id)) {
      drawn.extent.include(Eigen::Vector2d(cuboid->pose.translation().head<2>()));
    }
  }
  drawn.extent = drawn.extent.grown(kAround);
  return drawn;
}

void draw_vehicle(Picture& picture, const objects::Cuboid& vehicle, const Eigen::Vector2d& shift,
                  Colour colour, int width_px) {
  picture.rectangle(vehicle.pose.translation().head<2>() + shift, core::yaw(vehicle.pose.linear()),
                    vehicle.size.x(), vehicle.size.y(), colour, width_px);
}

void draw_panel(Picture& picture, const Drawn& drawn, const Eigen::Vector2d& shift, Colour colour) {
  for (const objects::Cuboid& vehicle : drawn.vehicles) {
    if ((vehicle.pose.translation().head<2>().array() < drawn.extent.low.array()).any()) continue;
    if ((vehicle.pose.translation().head<2>().array() > drawn.extent.high.array()).any()) continue;
    draw_vehicle(picture, vehicle, shift, colours::kGrey, 1);
  }
  for (const objects::Cuboid& target : drawn.targets) {
    draw_vehicle(picture, target, shift, colours::kInk, 2);
  }
  Points path;
  for (const Eigen::Vector2d& p : drawn.path) path.emplace_back(p + shift);
  picture.polyline(path, colour, 2);
  picture.text(Eigen::Vector2d(drawn.extent.low.x(), drawn.extent.high.y()) + shift, drawn.title,
               colours::kInk);
}

/// Panels of all rows side by side, each moved to where it is drawn.
struct Layout {
  std::vector<std::pair<Drawn, Eigen::Vector2d>> panels;
  std::vector<std::size_t> columns;  ///< beside `panels`
  Extent extent;
};

Layout laid_out(const std::vector<std::vector<TrajectoryPanel>>& rows,
                const objects::ClassTable& table) {
  Layout layout;
  double top = 0;
  for (const auto& row : rows) {
    double left = 0, tallest = 0;
    for (std::size_t column = 0; column < row.size(); ++column) {
      Drawn drawn = read_panel(row[column], table);
      const Eigen::Vector2d size = drawn.extent.high - drawn.extent.low;
      const Eigen::Vector2d corner(left, top - size.y());
      layout.extent.include(corner);
      layout.extent.include(corner + size);
      const Eigen::Vector2d shift = corner - drawn.extent.low;
      layout.panels.emplace_back(std::move(drawn), shift);
      layout.columns.push_back(column);
      left += size.x();
      tallest = std::max(tallest, size.y());
    }
    top -= tallest;
  }
  return layout;
}

}  // namespace

void write_error_picture(const std::filesystem::path& file, const std::vector<TableRow>& rows) {
  double most = 0;
  std::vector<std::vector<double>> shares;
  for (const TableRow& row : rows) {
    shares.push_back(shares_of(row.errors));
    most = std::max(most, *std::ranges::max_element(shares.back()));
  }
  Extent extent;
  extent.include({-kReach - 2 * kBin, -2 * kBin});
  extent.include({kReach + 2 * kBin, kHighest});
  Picture picture(extent, 1000, Axes::none);
  draw_error_axis(picture);
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (most > 0) picture.polyline(stairs(shares[i], kHighest / most), colour_of(i), 2);
    legend.push_back({Mark::line, colour_of(i), rows[i].policy});
  }
  picture.title("Length and width, mapped - true: share of errors by 5 cm");
  picture.legend(legend);
  picture.save(file);
}

void write_trajectory_picture(const std::filesystem::path& file,
                              const std::vector<std::vector<TrajectoryPanel>>& rows,
                              const objects::ClassTable& table) {
  const Layout layout = laid_out(rows, table);
  Picture picture(layout.extent, 2000, Axes::scale);
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const auto& [drawn, shift] = layout.panels[i];
    draw_panel(picture, drawn, shift, colour_of(layout.columns[i]));
  }
  picture.title("Flown missions from above, policies side by side: path, targets, other vehicles");
  picture.legend({{Mark::rectangle, colours::kInk, "target"},
                  {Mark::rectangle, colours::kGrey, "other vehicle"}});
  picture.save(file);
}

void write_calibration_picture(const std::filesystem::path& file, const std::string& policy,
                               const std::vector<CalibrationBin>& bins) {
  double most = 0;
  for (const CalibrationBin& bin : bins) most = std::max({most, bin.predicted, bin.realised});
  const double scale = most > 0 ? 1 / most : 1;  // pictures are for metres, these are centimetres
  Extent extent;
  extent.include({-0.1, -0.1});
  extent.include({1.1, 1.1});
  Picture picture(extent, 900, Axes::none);
  picture.polyline(Points{{0, 1.1}, {0, 0}, {1.1, 0}}, colours::kInk, 1);
  for (const double ratio : {0.8, 1.0, 1.25}) {
    const double end = std::min(1.1, 1.1 / ratio);
    picture.polyline(Points{{0, 0}, {end, ratio * end}}, colours::kGrey, ratio == 1.0 ? 2 : 1);
  }
  for (const CalibrationBin& bin : bins) {
    picture.disc({scale * bin.predicted, scale * bin.realised}, 6, colours::kBlue);
  }
  picture.title(fmt::format(
      "{}: size error, realised (up) against predicted (right), largest {:.2f} m", policy, most));
  picture.save(file);
}

}  // namespace saker::tools
