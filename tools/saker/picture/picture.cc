#include "tools/saker/picture/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "saker/core/files.h"

namespace saker::tools {
namespace {

constexpr int kMarginPx = 24;
constexpr int kTitlePx = 56;
constexpr int kLegendPx = 64;
constexpr int kStripCaptionPx = 30;
constexpr int kLeastStripPx = 128;
constexpr int kLeastWidthPx = 640;  // room for the legend beside a narrow map
constexpr int kShift = 4;           // OpenCV draws at 1/16 px
constexpr double kTextScale = 0.5;
constexpr double kFarPx = 20000;  // beyond, OpenCV's fixed point would overflow

cv::Scalar bgr(Colour c) { return {double(c.blue), double(c.green), double(c.red)}; }

cv::Point fixed(const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d near = pixel.cwiseMax(-kFarPx).cwiseMin(kFarPx);
  return {static_cast<int>(std::lround(near.x() * (1 << kShift))),
          static_cast<int>(std::lround(near.y() * (1 << kShift)))};
}

void put_text(cv::Mat& image, const Eigen::Vector2d& at, const std::string& text, Colour colour,
              double scale = kTextScale) {
  const cv::Point place(static_cast<int>(at.x()), static_cast<int>(at.y()));
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, scale, bgr(colour), 1, cv::LINE_AA);
}

int text_width(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kTextScale, 1, &baseline).width;
}

/// The longest of 1, 2, 5 × 10ⁿ that is at most `most`.
double round_length(double most) {
  const double decade = std::pow(10, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= most) return factor * decade;
  }
  return decade;
}

/// Lets every pixel fade from white to the colour by what fell on it.
void blend(cv::Mat& image, const cv::Mat& counts, Colour colour, double strength) {
  const double target[3] = {double(colour.blue), double(colour.green), double(colour.red)};
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const int count = counts.at<std::uint16_t>(v, u);
      if (count == 0) continue;
      const double opacity = 1 - std::pow(1 - strength, count);
      auto& pixel = image.at<cv::Vec3b>(v, u);
      for (int i = 0; i < 3; ++i) {
        pixel[i] = static_cast<std::uint8_t>(pixel[i] + opacity * (target[i] - pixel[i]));
      }
    }
  }
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

Picture::Picture(const Extent& extent, int longest_px, ScaleBar scale_bar) : extent_(extent) {
  if (extent_.empty()) extent_ = {Eigen::Vector2d::Constant(-10), Eigen::Vector2d::Constant(10)};
  const Eigen::Vector2d size = (extent_.high - extent_.low).cwiseMax(1.0);
  px_per_m_ = longest_px / size.maxCoeff();
  drawn_width_px_ = static_cast<int>(std::ceil(size.x() * px_per_m_));
  drawn_height_px_ = static_cast<int>(std::ceil(size.y() * px_per_m_));
  const int width = std::max(drawn_width_px_, kLeastWidthPx) + 2 * kMarginPx;
  const int height = drawn_height_px_ + kTitlePx + kLegendPx + 2 * kMarginPx;
  image_ = std::make_unique<cv::Mat>(height, width, CV_8UC3, cv::Scalar(255, 255, 255));
  strips_ = std::make_unique<cv::Mat>();
  if (scale_bar == ScaleBar::shown) draw_scale_bar();
}

Picture::~Picture() = default;

Eigen::Vector2d Picture::pixel(const Eigen::Vector2d& p) const {
  return {kMarginPx + (p.x() - extent_.low.x()) * px_per_m_,
          kTitlePx + kMarginPx + (extent_.high.y() - p.y()) * px_per_m_};
}

void Picture::points(std::span<const Eigen::Vector2d> points, Colour colour, double strength) {
  cv::Mat counts = cv::Mat::zeros(image_->size(), CV_16UC1);
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d at = pixel(p);
    if (!p.allFinite() || (p.array() < extent_.low.array()).any() ||
        (p.array() > extent_.high.array()).any()) {
      continue;
    }
    auto& count = counts.at<std::uint16_t>(static_cast<int>(at.y()), static_cast<int>(at.x()));
    if (count < 0xFFFF) ++count;
  }
  blend(*image_, counts, colour, strength);
}

void Picture::disc(const Eigen::Vector2d& centre, double radius_px, Colour colour) {
  if (!centre.allFinite()) return;
  const int radius = static_cast<int>(std::lround(radius_px * (1 << kShift)));
  cv::circle(*image_, fixed(pixel(centre)), radius, bgr(colour), cv::FILLED, cv::LINE_AA, kShift);
}

void Picture::stroke(std::span<const Eigen::Vector2d> pixels, Colour colour, int width_px,
                     bool closed) {
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& p : pixels) {
    if (p.allFinite()) corners.push_back(fixed(p));
  }
  if (corners.size() < 2) return;
  cv::polylines(*image_, corners, closed, bgr(colour), width_px, cv::LINE_AA, kShift);
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
  cv::circle(*image_, fixed(pixel(centre)),
             static_cast<int>(std::lround(radius_px * (1 << kShift))), bgr(colour), width_px,
             cv::LINE_AA, kShift);
}

void Picture::text(const Eigen::Vector2d& at, const std::string& text, Colour colour) {
  if (at.allFinite()) put_text(*image_, pixel(at), text, colour, 0.8 * kTextScale);
}

void Picture::title(const std::string& text) {
  put_text(*image_, {kMarginPx, kTitlePx - 16}, text, colours::kInk, 0.7);
}

void Picture::draw_scale_bar() {
  const double length = round_length(0.2 * (extent_.high - extent_.low).cwiseMax(1.0).maxCoeff());
  const double right = image_->cols - kMarginPx, left = right - length * px_per_m_;
  const double y = image_->rows - kMarginPx - 8;
  stroke(std::vector<Eigen::Vector2d>{{left, y - 5}, {left, y}, {right, y}, {right, y - 5}},
         colours::kInk, 2, false);
  const std::string label = fmt::format("{:g} m", length);
  put_text(*image_, {0.5 * (left + right - text_width(label)), y - 10}, label, colours::kInk);
}

void Picture::draw_mark(const LegendEntry& entry, const Eigen::Vector2d& at_px) {
  const Eigen::Vector2d across(10, 0), up(0, 5);
  switch (entry.mark) {
    case Mark::dot:
      cv::circle(*image_, fixed(at_px), 3 << kShift, bgr(entry.colour), cv::FILLED, cv::LINE_AA,
                 kShift);
      break;
    case Mark::ring:
      cv::circle(*image_, fixed(at_px), 5 << kShift, bgr(entry.colour), 2, cv::LINE_AA, kShift);
      break;
    case Mark::line:
      stroke(std::vector<Eigen::Vector2d>{at_px - across, at_px + across}, entry.colour, 2, false);
      break;
    case Mark::rectangle:
      stroke(std::vector<Eigen::Vector2d>{at_px - across - up, at_px + across - up,
                                          at_px + across + up, at_px - across + up},
             entry.colour, 2, true);
      break;
  }
}

void Picture::legend(const std::vector<LegendEntry>& entries) {
  Eigen::Vector2d at(kMarginPx + 10, image_->rows - kMarginPx - 12);
  for (const LegendEntry& entry : entries) {
    draw_mark(entry, at);
    put_text(*image_, at + Eigen::Vector2d(18, 5), entry.text, colours::kInk);
    at.x() += 18 + text_width(entry.text) + 34;
  }
}

void Picture::strip(const Raster& raster, const std::string& caption) {
  if (raster.pixels.empty()) return;
  cv::Mat pixels(raster.rows, raster.columns, CV_8UC3);
  for (int v = 0; v < raster.rows; ++v) {
    for (int u = 0; u < raster.columns; ++u) {
      const Colour c = raster.pixels[static_cast<std::size_t>(v) * raster.columns + u];
      pixels.at<cv::Vec3b>(v, u) = {c.blue, c.green, c.red};
    }
  }
  const int width = image_->cols - 2 * kMarginPx;
  const int height = raster.rows * std::max(1, kLeastStripPx / raster.rows);
  cv::Mat framed(height + kStripCaptionPx, image_->cols, CV_8UC3, cv::Scalar(255, 255, 255));
  cv::resize(pixels, framed(cv::Rect(kMarginPx, kStripCaptionPx, width, height)), {width, height},
             0, 0, cv::INTER_NEAREST);
  put_text(framed, {kMarginPx, kStripCaptionPx - 8}, caption, colours::kInk);
  if (strips_->empty()) {
    *strips_ = framed;
  } else {
    cv::vconcat(*strips_, framed, *strips_);
  }
}

void Picture::save(const std::filesystem::path& file) const {
  std::vector<std::uint8_t> bytes;
  cv::Mat whole = *image_;
  if (!strips_->empty()) cv::vconcat(*strips_, *image_, whole);
  cv::imencode(".png", whole, bytes);
  core::OutputFile out(file);
  out.write(std::span<const std::uint8_t>(bytes));
  out.finish();
}

}  // namespace saker::tools
