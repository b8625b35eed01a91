#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tools/saker/picture/canvas.h"

/// Pictures of a plane in metres: what maps and scans look like from above.
namespace saker::tools {

/// From 0 (dark blue) over green to 1 (yellow): quantities such as a range.
[[nodiscard]] Colour ramp(double fraction);

/// A rectangle in the plane, m.
struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(INFINITY);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-INFINITY);

  void include(const Eigen::Vector2d& p);  ///< points that are not finite are passed over
  [[nodiscard]] bool empty() const { return !(low.x() <= high.x()); }
  [[nodiscard]] Extent grown(double margin_m) const;
};

/// metres: x and y with their numbers, and a scale; scale: this alone, where places mean nothing.
enum class Axes { metres, scale, none };

enum class Mark { dot, line, rectangle, ring };

struct LegendEntry {
  Mark mark = Mark::dot;
  Colour colour;
  std::string text;
};

/// A top view on white, x to the right, y up, a title above, axes around, legend and scale below.
/// Lengths are metres but those that end in _px. Texts are ASCII. What is not finite or lies
/// outside is not drawn. The same calls make the same files.
class Picture {
 public:
  /// \param longest_px  of the drawn extent's sides; an empty extent shows 10 m around the origin.
  explicit Picture(const Extent& extent, int longest_px = 1400, Axes axes = Axes::metres);

  /// Thinly: the more points fall on a pixel, the nearer it gets to the colour.
  void points(std::span<const Eigen::Vector2d> points, Colour colour, double strength = 0.25);
  void disc(const Eigen::Vector2d& centre, double radius_px, Colour colour);
  void polyline(std::span<const Eigen::Vector2d> points, Colour colour, int width_px = 2);
  /// With a stroke from the centre to the front (x), so that the heading shows.
  void rectangle(const Eigen::Vector2d& centre, double yaw, double length, double width,
                 Colour colour, int width_px = 2);
  /// Drawn at least `least_radius_px` large, so that thin poles show.
  void circle(const Eigen::Vector2d& centre, double radius, Colour colour, int width_px = 2,
              double least_radius_px = 4);
  void text(const Eigen::Vector2d& at, const std::string& text, Colour colour);

  void title(const std::string& text);
  void legend(const std::vector<LegendEntry>& entries);

  /// Puts a raster as wide as the picture, with its caption, above the view and below the strips
  /// put there before.
  void strip(const Raster& raster, const std::string& caption);

  /// A PNG, and an SVG beside it (`svg_beside`); SVG alone where the file's name ends so. Throws
  /// Error where they cannot be written.
  void save(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p) const;
  [[nodiscard]] bool inside(const Eigen::Vector2d& p) const;
  void stroke(std::span<const Eigen::Vector2d> pixels, Colour colour, int width_px, bool closed);
  void draw_axes();
  void draw_scale();
  void draw_mark(const LegendEntry& entry, const Eigen::Vector2d& at_px);

  /// The same call to each canvas.
  template <class Call>
  void on_all(bool in_view, Call call) {
    for (const auto& canvas : {png_.get(), svg_.get()}) {
      canvas->clip(in_view);
      call(*canvas);
    }
  }

  Extent extent_;
  double px_per_m_;
  Page page_;
  std::unique_ptr<Canvas> png_, svg_;
};

/// The SVG that goes with a picture: of the same name, with another ending.
[[nodiscard]] std::filesystem::path svg_beside(const std::filesystem::path& file);

}  // namespace saker::tools
