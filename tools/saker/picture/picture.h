#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "saker/core/colour.h"

namespace cv {
class Mat;
}

/// Pictures of a plane in metres: what maps and scans look like from above.
namespace saker::tools {

using core::Colour;
namespace colours = core::colours;

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

enum class ScaleBar { shown, hidden };

enum class Mark { dot, line, rectangle, ring };

struct LegendEntry {
  Mark mark = Mark::dot;
  Colour colour;
  std::string text;
};

/// Rows × columns of colours, row-major.
struct Raster {
  int rows = 0;
  int columns = 0;
  std::vector<Colour> pixels;
};

/// A top view on white, x to the right, y up, a title above, legend and scale bar below. Lengths
/// are metres but those that end in _px. Texts are ASCII. What is not finite or lies outside is not
/// drawn. The same calls make the same file.
class Picture {
 public:
  /// \param longest_px  of the drawn extent's sides; an empty extent shows 10 m around the origin.
  explicit Picture(const Extent& extent, int longest_px = 1400,
                   ScaleBar scale_bar = ScaleBar::shown);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

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

  /// PNG; throws Error where it cannot be written.
  void save(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p) const;
  void stroke(std::span<const Eigen::Vector2d> pixels, Colour colour, int width_px, bool closed);
  void draw_scale_bar();
  void draw_mark(const LegendEntry& entry, const Eigen::Vector2d& at_px);

  Extent extent_;
  double px_per_m_;
  int drawn_width_px_;
  int drawn_height_px_;
  std::unique_ptr<cv::Mat> image_;
  std::unique_ptr<cv::Mat> strips_;
};

}  // namespace saker::tools
