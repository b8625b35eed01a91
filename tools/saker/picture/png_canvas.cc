#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tools/saker/picture/canvas.h"
#include "tools/saker/picture/raster_layer.h"

namespace saker::tools {
namespace {

constexpr int kShift = 4;               // OpenCV draws at 1/16 px
constexpr double kDrawablePx = 20000;   // beyond, OpenCV's fixed point would overflow
constexpr double kPxPerTextScale = 26;  // of letters as high as those of a font of this size
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

cv::Scalar bgr(Colour c) { return {double(c.blue), double(c.green), double(c.red)}; }

int fixed(double px) { return static_cast<int>(std::lround(px * (1 << kShift))); }

class PngCanvas : public Canvas {
 public:
  explicit PngCanvas(const Page& page)
      : page_(page.height, page.width, CV_8UC3, cv::Scalar(255, 255, 255)),
        view_(page_(cv::Rect(page.view_left, page.view_top, page.view_width, page.view_height))),
        view_origin_(page.view_left, page.view_top),
        drawn_(page_) {}

  void clip(bool to_view) override {
    drawn_ = to_view ? view_ : page_;
    origin_ = to_view ? view_origin_ : Eigen::Vector2d::Zero();
  }

  void points(std::span<const Eigen::Vector2d> places, Colour colour, double strength) override {
    std::vector<Eigen::Vector2d> in_view;
    for (const Eigen::Vector2d& p : places) in_view.emplace_back(p - view_origin_);
    const cv::Mat counts = counted(in_view, view_.size());
    const double target[3] = {double(colour.blue), double(colour.green), double(colour.red)};
    for (int v = 0; v < view_.rows; ++v) {
      for (int u = 0; u < view_.cols; ++u) {
        const int count = counts.at<std::uint16_t>(v, u);
        if (count == 0) continue;
        auto& pixel = view_.at<cv::Vec3b>(v, u);
        for (int i = 0; i < 3; ++i) {
          pixel[i] = static_cast<std::uint8_t>(pixel[i] +
                                               opacity(count, strength) * (target[i] - pixel[i]));
        }
      }
    }
  }

  void disc(const Eigen::Vector2d& centre, double radius, Colour colour) override {
    circle(centre, radius, colour, cv::FILLED);
  }

  void circle(const Eigen::Vector2d& centre, double radius, Colour colour, int width) override {
    cv::circle(drawn_, fixed_point(centre), fixed(std::min(radius, kDrawablePx)), bgr(colour),
               width, cv::LINE_AA, kShift);
  }

  void stroke(std::span<const Eigen::Vector2d> places, Colour colour, int width,
              bool closed) override {
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& p : places) corners.push_back(fixed_point(p));
    cv::polylines(drawn_, corners, closed, bgr(colour), width, cv::LINE_AA, kShift);
  }

  void text(const Eigen::Vector2d& at, const std::string& text, Colour colour,
            const TextStyle& style) override {
    const double width = text_width_px(text, style.size_px);
    const double left = style.anchor == Anchor::left     ? 0
                        : style.anchor == Anchor::middle ? 0.5 * width
                                                         : width;
    const Eigen::Vector2d p = (at - origin_).cwiseMax(-kDrawablePx).cwiseMin(kDrawablePx);
    const cv::Point place(static_cast<int>(p.x() - left), static_cast<int>(p.y()));
    cv::putText(drawn_, text, place, kFont, style.size_px / kPxPerTextScale, bgr(colour), 1,
                cv::LINE_AA);
  }

  void title(const Eigen::Vector2d& at, const std::string& title) override {
    text(at, title, colours::kInk, {.size_px = kTitlePx});
  }

  void strip(const Raster& raster, const std::string& caption) override {
    const int width = page_.cols - 2 * kStripMarginPx, height = strip_height_px(raster);
    cv::Mat framed(height + kStripCaptionPx, page_.cols, CV_8UC3, cv::Scalar(255, 255, 255));
    cv::resize(image_of(raster), framed(cv::Rect(kStripMarginPx, kStripCaptionPx, width, height)),
               {width, height}, 0, 0, cv::INTER_NEAREST);
    cv::putText(framed, caption, {kStripMarginPx, kStripCaptionPx - 8}, kFont,
                TextStyle{}.size_px / kPxPerTextScale, bgr(colours::kInk), 1, cv::LINE_AA);
    if (strips_.empty()) {
      strips_ = framed;
    } else {
      cv::vconcat(strips_, framed, strips_);
    }
  }

  [[nodiscard]] std::string encoded() const override {
    cv::Mat all = page_;
    if (!strips_.empty()) cv::vconcat(strips_, page_, all);
    return encoded_png(all);
  }

 private:
  [[nodiscard]] cv::Point fixed_point(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d p = (place - origin_).cwiseMax(-kDrawablePx).cwiseMin(kDrawablePx);
    return {fixed(p.x()), fixed(p.y())};
  }

  cv::Mat page_;
  cv::Mat view_;  // of the page's memory, like the next
  Eigen::Vector2d view_origin_;
  cv::Mat drawn_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  cv::Mat strips_;
};

}  // namespace

std::unique_ptr<Canvas> make_png_canvas(const Page& page) {
  return std::make_unique<PngCanvas>(page);
}

int text_width_px(const std::string& text, double size_px) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, size_px / kPxPerTextScale, 1, &baseline).width;
}

}  // namespace saker::tools
