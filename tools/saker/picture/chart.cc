#include "tools/saker/picture/chart.h"

#include <fmt/format.h>

#include <cmath>

namespace saker::tools {
namespace {

// Of the drawing, in the picture's units.
constexpr double kWidth = 16, kHeight = 9;
constexpr double kLeft = 1.2, kBelow = 1.2, kRight = 0.4;  // margins for numbers and names
constexpr int kLongest_px = 1000;
constexpr double kDot_px = 3;

Extent extent() {
  return {Eigen::Vector2d(-kLeft, -kBelow), Eigen::Vector2d(kWidth + kRight, kHeight)};
}

}  // namespace

Chart::Chart(const std::string& title, const Axis& x, const Axis& y)
    : x_(x), y_(y), picture_(extent(), kLongest_px, Axes::none) {
  picture_.title(title);
  draw_axes();
}

Eigen::Vector2d Chart::place(const Eigen::Vector2d& value) const {
  return {kWidth * (value.x() - x_.low) / (x_.high - x_.low),
          kHeight * (value.y() - y_.low) / (y_.high - y_.low)};
}

bool Chart::inside(const Eigen::Vector2d& value) const {
  return value.x() >= x_.low && value.x() <= x_.high && value.y() >= y_.low && value.y() <= y_.high;
}

void Chart::draw_axes() {
  const std::vector<Eigen::Vector2d> axes = {{0, kHeight}, {0, 0}, {kWidth, 0}};
  picture_.polyline(axes, colours::kInk, 2);
  const auto steps = [](const Axis& axis) {
    return static_cast<int>(std::floor((axis.high - axis.low) / axis.step + 1e-9));
  };
  for (int i = 0; i <= steps(x_); ++i) {
    const double value = x_.low + i * x_.step;
    const Eigen::Vector2d at = place({value, y_.low});
    picture_.polyline(std::vector<Eigen::Vector2d>{at, {at.x(), kHeight}}, {225, 228, 232}, 1);
    picture_.text(at - Eigen::Vector2d(0.15, 0.45), fmt::format("{:g}", value), colours::kInk);
  }
  for (int i = 0; i <= steps(y_); ++i) {
    const double value = y_.low + i * y_.step;
    const Eigen::Vector2d at = place({x_.low, value});
    picture_.polyline(std::vector<Eigen::Vector2d>{at, {kWidth, at.y()}}, {225, 228, 232}, 1);
    picture_.text(at - Eigen::Vector2d(0.8, 0.1), fmt::format("{:g}", value), colours::kInk);
  }
  picture_.text({0.4 * kWidth, -0.95}, x_.name, colours::kInk);
  picture_.text({0.2, kHeight - 0.4}, y_.name, colours::kInk);
}

void Chart::curve(std::span<const Eigen::Vector2d> points, Colour colour) {
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    if (inside(point)) places.push_back(place(point));
  }
  picture_.polyline(places, colour, 3);
}

void Chart::dots(std::span<const Eigen::Vector2d> points, Colour colour) {
  for (const Eigen::Vector2d& point : points) {
    if (inside(point)) picture_.disc(place(point), kDot_px, colour);
  }
}

}  // namespace saker::tools
