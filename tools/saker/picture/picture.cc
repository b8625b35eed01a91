#include "tools/saker/picture/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/files.h"

namespace saker::tools {
namespace {

constexpr int kMarginPx = 24;
constexpr int kHeadPx = 56;
constexpr int kLegendPx = 64;
constexpr int kAxisLeftPx = 40;      // room for the numbers of y
constexpr int kAxisBelowPx = 36;     // for those of x, and its name
constexpr int kTickPx = 6;           // its length
constexpr int kLeastWidthPx = 900;   // room for title and legend of a narrow map
constexpr double kTicks = 8;         // at most, about, along the longer side
constexpr double kFarPx = 20000;     // a radius beyond shows no bend
constexpr double kSmallTextPx = 11;  // of numbers, and of names in the view
constexpr double kTextPx = 13;
constexpr Colour kFrame = colours::kGrey;

/// The longest of 1, 2, 5 × 10ⁿ that is at most `most`.
double round_length(double most) {
  const double decade = std::pow(10, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= most) return factor * decade;
  }
  return decade;
}

/// Multiples of `step` in [low, high].
std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> values;
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long i = first; i <= last; ++i) values.push_back(static_cast<double>(i) * step);
  return values;
}

Page page_of(const Eigen::Vector2d& size, double px_per_m, Axes axes) {
  Page page;
  page.view_left = kMarginPx + (axes == Axes::metres ? kAxisLeftPx : 0);
  page.view_top = kHeadPx + kMarginPx;
  page.view_width = static_cast<int>(std::ceil(size.x() * px_per_m));
  page.view_height = static_cast<int>(std::ceil(size.y() * px_per_m));
  page.width = std::max(page.view_left + page.view_width + kMarginPx, kLeastWidthPx);
  page.height = page.view_top + page.view_height + kMarginPx + kLegendPx +
                (axes == Axes::metres ? kAxisBelowPx : 0);
  return page;
}

}  // namespace

Colour ramp(double fraction) {
  constexpr Colour kStops[] = {
      {68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double at = 4 * std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0);
  const int i = std::min(static_cast<int>(at), 3);
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + (at - i) * (b - a)));
  };
  const Colour a = kStops[i], b = kStops[i + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

void Extent::include(const Eigen::Vector2d& p) {
  if (!p.allFinite()) return;
  low = low.cwiseMin(p);
  high = high.cwiseMax(p);
}

Extent Extent::grown(double margin_m) const {
  if (empty()) return *this;
  return {low.array() - margin_m, high.array() + margin_m};
}

Picture::Picture(const Extent& extent, int longest_px, Axes axes) : extent_(extent) {
  if (extent_.empty()) extent_ = {Eigen::Vector2d::Constant(-10), Eigen::Vector2d::Constant(10)};
  extent_.high = extent_.high.cwiseMax(extent_.low + Eigen::Vector2d::Ones());
  const Eigen::Vector2d size = extent_.high - extent_.low;
  px_per_m_ = longest_px / size.maxCoeff();
  page_ = page_of(size, px_per_m_, axes);
  png_ = make_png_canvas(page_);
  svg_ = make_svg_canvas(page_);
  if (axes == Axes::metres) draw_axes();
  if (axes != Axes::none) draw_scale();
}

Eigen::Vector2d Picture::pixel(const Eigen::Vector2d& p) const {
  return {page_.view_left + (p.x() - extent_.low.x()) * px_per_m_,
          page_.view_top + (extent_.high.y() - p.y()) * px_per_m_};
}

bool Picture::inside(const Eigen::Vector2d& p) const {
  return p.allFinite() && (p.array() >= extent_.low.array()).all() &&
         (p.array() <= extent_.high.array()).all();
}

void Picture::points(std::span<const Eigen::Vector2d> points, Colour colour, double strength) {
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& p : points) {
    if (inside(p)) places.push_back(pixel(p));
  }
  on_all(true, [&](Canvas& canvas) { canvas.points(places, colour, strength); });
}

void Picture::disc(const Eigen::Vector2d& centre, double radius_px, Colour colour) {
  if (!centre.allFinite()) return;
  on_all(true, [&](Canvas& canvas) { canvas.disc(pixel(centre), radius_px, colour); });
}

void Picture::stroke(std::span<const Eigen::Vector2d> pixels, Colour colour, int width_px,
                     bool closed) {
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& p : pixels) {
    if (p.allFinite()) corners.push_back(p);
  }
  if (corners.size() < 2) return;
  on_all(true, [&](Canvas& canvas) { canvas.stroke(corners, colour, width_px, closed); });
}

void Picture::polyline(std::span<const Eigen::Vector2d> points, Colour colour, int width_px) {
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector2d& p : points) pixels.push_back(pixel(p));
  stroke(pixels, colour, width_px, false);
}

void Picture::rectangle(const Eigen::Vector2d& centre, double yaw, double length, double width,
                        Colour colour, int width_px) {
  const Eigen::Vector2d x = 0.5 * length * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
  const Eigen::Vector2d y = 0.5 * width * Eigen::Vector2d(-std::sin(yaw), std::cos(yaw));
  const std::vector<Eigen::Vector2d> corners = {pixel(centre + x + y), pixel(centre - x + y),
                                                pixel(centre - x - y), pixel(centre + x - y)};
  stroke(corners, colour, width_px, true);
  stroke(std::vector<Eigen::Vector2d>{pixel(centre), pixel(centre + x)}, colour, width_px, false);
}

void Picture::circle(const Eigen::Vector2d& centre, double radius, Colour colour, int width_px,
                     double least_radius_px) {
  if (!centre.allFinite() || !std::isfinite(radius)) return;
  const double radius_px = std::clamp(radius * px_per_m_, least_radius_px, kFarPx);
  on_all(true, [&](Canvas& canvas) { canvas.circle(pixel(centre), radius_px, colour, width_px); });
}

void Picture::text(const Eigen::Vector2d& at, const std::string& text, Colour colour) {
  if (!inside(at)) return;
  on_all(false,
         [&](Canvas& canvas) { canvas.text(pixel(at), text, colour, {.size_px = kSmallTextPx}); });
}

void Picture::title(const std::string& text) {
  on_all(false, [&](Canvas& canvas) { canvas.title({page_.view_left, kHeadPx - 16}, text); });
}

void Picture::draw_axes() {
  const double left = page_.view_left, right = left + page_.view_width;
  const double top = page_.view_top, bottom = top + page_.view_height;
  const double step = round_length((extent_.high - extent_.low).maxCoeff() / kTicks * 1.5);
  const auto draw = [&](Canvas& canvas) {
    const auto tick = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      canvas.stroke(std::vector<Eigen::Vector2d>{from, to}, kFrame, 1, false);
    };
    canvas.stroke(
        std::vector<Eigen::Vector2d>{{left, top}, {right, top}, {right, bottom}, {left, bottom}},
        kFrame, 1, true);
    for (const double x : multiples(step, extent_.low.x(), extent_.high.x())) {
      const double u = pixel({x, 0}).x();
      tick({u, bottom}, {u, bottom + kTickPx});
      canvas.text({u, bottom + kTickPx + 12}, fmt::format("{:g}", x), colours::kInk,
                  {.size_px = kSmallTextPx, .anchor = Anchor::middle});
    }
    for (const double y : multiples(step, extent_.low.y(), extent_.high.y())) {
      const double v = pixel({0, y}).y();
      tick({left - kTickPx, v}, {left, v});
      canvas.text({left - kTickPx - 3, v + 4}, fmt::format("{:g}", y), colours::kInk,
                  {.size_px = kSmallTextPx, .anchor = Anchor::right});
    }
    canvas.text({0.5 * (left + right), bottom + kAxisBelowPx}, "x, m", colours::kInk,
                {.size_px = kTextPx, .anchor = Anchor::middle});
    canvas.text({left, top - 8}, "y, m", colours::kInk,
                {.size_px = kTextPx, .anchor = Anchor::middle});
  };
  on_all(false, draw);
}

void Picture::draw_scale() {
  const double length = round_length(0.2 * (extent_.high - extent_.low).maxCoeff());
  const double right = page_.width - kMarginPx, left = right - length * px_per_m_;
  const double y = page_.height - kMarginPx - 8;
  const std::vector<Eigen::Vector2d> bar = {{left, y - 5}, {left, y}, {right, y}, {right, y - 5}};
  on_all(false, [&](Canvas& canvas) {
    canvas.stroke(bar, colours::kInk, 2, false);
    canvas.text({0.5 * (left + right), y - 10}, fmt::format("{:g} m", length), colours::kInk,
                {.size_px = kTextPx, .anchor = Anchor::middle});
  });
}

void Picture::draw_mark(const LegendEntry& entry, const Eigen::Vector2d& at_px) {
  const Eigen::Vector2d across(10, 0), up(0, 5);
  on_all(false, [&](Canvas& canvas) {
    switch (entry.mark) {
      case Mark::dot:
        canvas.disc(at_px, 3, entry.colour);
        break;
      case Mark::ring:
        canvas.circle(at_px, 5, entry.colour, 2);
        break;
      case Mark::line:
        canvas.stroke(std::vector<Eigen::Vector2d>{at_px - across, at_px + across}, entry.colour, 2,
                      false);
        break;
      case Mark::rectangle:
        canvas.stroke(std::vector<Eigen::Vector2d>{at_px - across - up, at_px + across - up,
                                                   at_px + across + up, at_px - across + up},
                      entry.colour, 2, true);
        break;
    }
  });
}

void Picture::legend(const std::vector<LegendEntry>& entries) {
  Eigen::Vector2d at(page_.view_left + 10, page_.height - kMarginPx - 12);
  for (const LegendEntry& entry : entries) {
    draw_mark(entry, at);
    on_all(false, [&](Canvas& canvas) {
      canvas.text(at + Eigen::Vector2d(18, 5), entry.text, colours::kInk, {.size_px = kTextPx});
    });
    at.x() += 18 + text_width_px(entry.text, kTextPx) + 34;
  }
}

void Picture::strip(const Raster& raster, const std::string& caption) {
  if (raster.pixels.empty()) return;
  on_all(false, [&](Canvas& canvas) { canvas.strip(raster, caption); });
}

void Picture::save(const std::filesystem::path& file) const {
  const std::filesystem::path svg = svg_beside(file);
  if (file != svg) core::write_file(file, png_->encoded());
  core::write_file(svg, svg_->encoded());
}

std::filesystem::path svg_beside(const std::filesystem::path& file) {
  return std::filesystem::path(file).replace_extension(".svg");
}

}  // namespace saker::tools
