#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/segmentation/network.h"
#include "saker/segmentation/range_image.h"

namespace saker::segmentation::testing {

inline constexpr int kRows = 40, kColumns = 1024, kVehicle = 1, kTrunk = 2, kPole = 3;
inline constexpr float kPitch = 2 * std::numbers::pi_v<float> / kColumns;

/// An empty image of a turning sensor, in which upright surfaces that face it are drawn as its
/// beams meet them: rows and columns are kPitch apart.
struct Picture {
  objects::ClassTable table;
  RangeImage image;
  PixelProbabilities pixels;
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();

  Picture() {
    image.rows = kRows, image.columns = kColumns;
    image.points.assign(kRows * kColumns,
                        Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    image.range.assign(kRows * kColumns, 0);
    pixels = {table.size(), kRows, kColumns,
              std::vector<float>(static_cast<std::size_t>(kRows) * kColumns * table.size(), 0)};
  }

  /// A surface from 1 m below the sensor up.
  /// \return its pixels
  std::vector<std::size_t> draw(float azimuth, float distance, float width, float height) {
    std::vector<std::size_t> drawn;
    for (int row = 0; row < kRows; ++row) {
      const float z = distance * std::tan(kPitch * static_cast<float>(kRows / 2 - row));
      if (z < -1 || z > height - 1) continue;
      for (int column = 0; column < kColumns; ++column) {
        const float off = std::remainder(kPitch * static_cast<float>(column) - azimuth,
                                         2 * std::numbers::pi_v<float>);
        if (std::abs(off) * distance > 0.5F * width) continue;
        const std::size_t i = static_cast<std::size_t>(row) * kColumns + column;
        image.points[i] = {distance * std::cos(azimuth + off), distance * std::sin(azimuth + off),
                           z};
        image.range[i] = image.points[i].norm();
        drawn.push_back(i);
      }
    }
    return drawn;
  }

  [[nodiscard]] float* at(std::size_t i) { return &pixels.values[i * table.size()]; }
};

}  // namespace saker::segmentation::testing
