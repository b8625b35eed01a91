#include "tools/saker/picture/raster_layer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

namespace saker::tools {

cv::Mat counted(std::span<const Eigen::Vector2d> places, cv::Size size) {
  cv::Mat counts = cv::Mat::zeros(size, CV_16UC1);
  for (const Eigen::Vector2d& p : places) {
    if ((p.array() < 0).any() || p.x() >= size.width || p.y() >= size.height) continue;
    auto& count = counts.at<std::uint16_t>(static_cast<int>(p.y()), static_cast<int>(p.x()));
    if (count < 0xFFFF) ++count;
  }
  return counts;
}

double opacity(int count, double strength) { return 1 - std::pow(1 - strength, count); }

cv::Mat image_of(const Raster& raster) {
  cv::Mat image(raster.rows, raster.columns, CV_8UC3);
  for (int v = 0; v < raster.rows; ++v) {
    for (int u = 0; u < raster.columns; ++u) {
      const Colour c = raster.pixels[static_cast<std::size_t>(v) * raster.columns + u];
      image.at<cv::Vec3b>(v, u) = {c.blue, c.green, c.red};
    }
  }
  return image;
}

int strip_height_px(const Raster& raster) {
  return raster.rows * std::max(1, kLeastStripPx / raster.rows);
}

std::string encoded_png(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace saker::tools
