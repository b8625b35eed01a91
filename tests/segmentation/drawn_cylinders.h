#pragma once

#include <vector>

#include "segmentation/drawn_picture.h"

namespace saker::segmentation::testing {

/// A picture with trunks and poles.
struct Cylinders : Picture {
  std::vector<std::int32_t> draw(float azimuth, float distance, float width, float height,
                                 float trunk, float pole) {
    std::vector<std::int32_t> piece;
    for (const std::size_t i : Picture::draw(azimuth, distance, width, height)) {
      at(i)[kTrunk] = trunk, at(i)[kPole] = pole, at(i)[0] = 1 - trunk - pole;
      piece.push_back(static_cast<std::int32_t>(i));
    }
    return piece;
  }
};

}  // namespace saker::segmentation::testing
