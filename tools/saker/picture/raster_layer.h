#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "tools/saker/picture/canvas.h"

/// What both canvases need of OpenCV.
namespace saker::tools {

constexpr int kStripMarginPx = 24;   // of a strip, left and right
constexpr int kStripCaptionPx = 30;  // above it
constexpr int kLeastStripPx = 128;   // its height

/// How many of the places (px) fall on each pixel of an image of this size; those outside are left
/// out. CV_16UC1.
[[nodiscard]] cv::Mat counted(std::span<const Eigen::Vector2d> places, cv::Size size);

/// 0 … 1, of a pixel that `count` points fell on.
[[nodiscard]] double opacity(int count, double strength);

[[nodiscard]] cv::Mat image_of(const Raster& raster);
[[nodiscard]] int strip_height_px(const Raster& raster);

[[nodiscard]] std::string encoded_png(const cv::Mat& image);

}  // namespace saker::tools
