#include <fmt/format.h>
#include <sodium.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "saker/core/markup.h"
#include "tools/saker/picture/canvas.h"
#include "tools/saker/picture/raster_layer.h"

namespace saker::tools {
namespace {

constexpr double kNearPx = 0.25;  // of a line's corners nothing is seen below

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string data_uri(const cv::Mat& image) {
  const std::string png = encoded_png(image);
  std::string text(sodium_base64_encoded_len(png.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(png.data()),
                    png.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // its zero
  return "data:image/png;base64," + text;
}

/// `colour` over what is there, both with their opacity.
void lay_over(cv::Vec4b& pixel, Colour colour, double share) {
  const double below = pixel[3] / 255.0 * (1 - share), sum = share + below;
  const double target[3] = {double(colour.blue), double(colour.green), double(colour.red)};
  for (int i = 0; i < 3; ++i) {
    pixel[i] = static_cast<std::uint8_t>(std::lround((share * target[i] + below * pixel[i]) / sum));
  }
  pixel[3] = static_cast<std::uint8_t>(std::lround(255 * sum));
}

class SvgCanvas : public Canvas {
 public:
  explicit SvgCanvas(const Page& page) : page_(page) {}

  void clip(bool to_view) override {
    if (to_view == clipped_) return;
    flush_points();
    body_ += to_view ? "<g clip-path=\"url(#view)\">\n" : "</g>\n";
    clipped_ = to_view;
  }

  void points(std::span<const Eigen::Vector2d> places, Colour colour, double strength) override {
    if (points_.empty()) points_ = cv::Mat::zeros(page_.view_height, page_.view_width, CV_8UC4);
    std::vector<Eigen::Vector2d> in_view;
    for (const Eigen::Vector2d& p : places) {
      in_view.emplace_back(p - Eigen::Vector2d(page_.view_left, page_.view_top));
    }
    const cv::Mat counts = counted(in_view, points_.size());
    for (int v = 0; v < points_.rows; ++v) {
      for (int u = 0; u < points_.cols; ++u) {
        const int count = counts.at<std::uint16_t>(v, u);
        if (count > 0) lay_over(points_.at<cv::Vec4b>(v, u), colour, opacity(count, strength));
      }
    }
  }

  void disc(const Eigen::Vector2d& centre, double radius, Colour colour) override {
    add(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>", centre.x(),
                    centre.y(), radius, hex(colour)));
  }

  void circle(const Eigen::Vector2d& centre, double radius, Colour colour, int width) override {
    add(fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}/>", centre.x(), centre.y(),
                    radius, line(colour, width)));
  }

  void stroke(std::span<const Eigen::Vector2d> places, Colour colour, int width,
              bool closed) override {
    std::string corners;
    Eigen::Vector2d last = Eigen::Vector2d::Constant(INFINITY);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool end = i + 1 == places.size();
      if (!end && (places[i] - last).norm() < kNearPx) continue;
      last = places[i];
      corners += fmt::format("{}{:.2f},{:.2f}", corners.empty() ? "" : " ", last.x(), last.y());
    }
    add(fmt::format("<{} points=\"{}\" {}/>", closed ? "polygon" : "polyline", corners,
                    line(colour, width)));
  }

  void text(const Eigen::Vector2d& at, const std::string& text, Colour colour,
            const TextStyle& style) override {
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    add(
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\" "
                    "fill=\"{}\">{}</text>",
                    at.x(), at.y(), style.size_px, kAnchors[static_cast<int>(style.anchor)],
                    hex(colour), core::escaped_markup(text)));
  }

  void title(const Eigen::Vector2d& at, const std::string& title) override {
    title_ = title;
    text(at, title, colours::kInk, {.size_px = kTitlePx});
  }

  void strip(const Raster& raster, const std::string& caption) override {
    const int height = strip_height_px(raster);
    strips_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{:g}\" fill=\"{}\">{}</text>\n",
                           kStripMarginPx, strips_height_ + kStripCaptionPx - 8,
                           TextStyle{}.size_px, hex(colours::kInk), core::escaped_markup(caption));
    strips_ += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "style=\"image-rendering:pixelated\" xlink:href=\"{}\"/>\n",
        kStripMarginPx, strips_height_ + kStripCaptionPx, page_.width - 2 * kStripMarginPx, height,
        data_uri(image_of(raster)));
    strips_height_ += kStripCaptionPx + height;
  }

  [[nodiscard]] std::string encoded() const override {
    const int height = page_.height + strips_height_;
    std::string svg = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "version=\"1.1\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n<title>{2}</title>\n",
        page_.width, height, core::escaped_markup(title_));
    svg += fmt::format(
        "<clipPath id=\"view\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
        page_.view_left, page_.view_top, page_.view_width, page_.view_height);
    svg +=
        fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", page_.width, height);
    svg += strips_;
    svg += fmt::format("<g transform=\"translate(0 {})\">\n", strips_height_);
    return svg + body_ + points_image() + (clipped_ ? "</g>\n" : "") + "</g>\n</svg>\n";
  }

 private:
  static std::string line(Colour colour, int width) {
    return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", hex(colour), width);
  }

  void add(const std::string& element) {
    flush_points();
    body_ += element + "\n";
  }

  [[nodiscard]] std::string points_image() const {
    if (points_.empty()) return "";
    return fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" xlink:href=\"{}\"/>\n",
                       page_.view_left, page_.view_top, page_.view_width, page_.view_height,
                       data_uri(points_));
  }

  void flush_points() {
    body_ += points_image();
    points_.release();
  }

  Page page_;
  std::string title_, strips_, body_;
  int strips_height_ = 0;
  bool clipped_ = false;
  cv::Mat points_;  // those since the last element, on nothing; empty: none
};

}  // namespace

std::unique_ptr<Canvas> make_svg_canvas(const Page& page) {
  return std::make_unique<SvgCanvas>(page);
}

}  // namespace saker::tools
