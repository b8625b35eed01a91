#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/saker/picture/picture.h"

namespace saker::tools {

/// An axis of a chart: the values at its ends and where its numbers stand.
struct Axis {
  std::string name;  ///< with unit, ASCII
  double low = 0, high = 1;
  double step = 0.1;  ///< between numbers
};

/// Curves and points over two axes. What lies outside is not drawn.
class Chart {
 public:
  Chart(const std::string& title, const Axis& x, const Axis& y);

  void curve(std::span<const Eigen::Vector2d> points, Colour colour);
  void dots(std::span<const Eigen::Vector2d> points, Colour colour);
  void legend(const std::vector<LegendEntry>& entries) { picture_.legend(entries); }

  /// PNG and SVG; throws Error where it cannot be written.
  void save(const std::filesystem::path& file) const { picture_.save(file); }

 private:
  [[nodiscard]] Eigen::Vector2d place(const Eigen::Vector2d& value) const;
  [[nodiscard]] bool inside(const Eigen::Vector2d& value) const;
  void draw_axes();

  Axis x_, y_;
  Picture picture_;
};

}  // namespace saker::tools
