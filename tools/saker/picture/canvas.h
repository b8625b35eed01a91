#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "saker/core/colour.h"

namespace saker::tools {

using core::Colour;
namespace colours = core::colours;

/// Rows × columns of colours, row-major.
struct Raster {
  int rows = 0;
  int columns = 0;
  std::vector<Colour> pixels;
};

/// Sizes in pixels: of the page, and of the view in it, where the plane is drawn.
struct Page {
  int width = 0, height = 0;
  int view_left = 0, view_top = 0;
  int view_width = 0, view_height = 0;
};

inline constexpr double kTitlePx = 18;  // the height of a title's letters

enum class Anchor { left, middle, right };

struct TextStyle {
  double size_px = 13;
  Anchor anchor = Anchor::left;  ///< where the text's place is in the text, on its base line
};

/// What a picture is drawn on: places are pixels of the page, x to the right, y down, and finite.
/// Later calls lie on top. The same calls make the same bytes.
class Canvas {
 public:
  virtual ~Canvas() = default;

  /// Whether what follows is cut off at the edges of the view.
  virtual void clip(bool to_view) = 0;
  /// Thinly: the more points fall on a pixel, the nearer it gets to the colour. Inside of the view.
  virtual void points(std::span<const Eigen::Vector2d> places, Colour colour, double strength) = 0;
  virtual void disc(const Eigen::Vector2d& centre, double radius, Colour colour) = 0;
  virtual void circle(const Eigen::Vector2d& centre, double radius, Colour colour, int width) = 0;
  virtual void stroke(std::span<const Eigen::Vector2d> places, Colour colour, int width,
                      bool closed) = 0;
  virtual void text(const Eigen::Vector2d& at, const std::string& text, Colour colour,
                    const TextStyle& style) = 0;
  virtual void title(const Eigen::Vector2d& at, const std::string& text) = 0;
  /// A raster as wide as the page, with its caption, above the page and below earlier strips.
  virtual void strip(const Raster& raster, const std::string& caption) = 0;

  /// The file's content.
  [[nodiscard]] virtual std::string encoded() const = 0;
};

/// PNG. Texts are ASCII, in OpenCV's stroke letters.
[[nodiscard]] std::unique_ptr<Canvas> make_png_canvas(const Page& page);

/// SVG 1.1: lines, shapes and texts are vectors; points and strips are PNG images inside.
[[nodiscard]] std::unique_ptr<Canvas> make_svg_canvas(const Page& page);

/// How wide the PNG shows a text; SVG's letters are narrower.
[[nodiscard]] int text_width_px(const std::string& text, double size_px);

}  // namespace saker::tools
