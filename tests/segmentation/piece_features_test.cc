#include "saker/segmentation/piece_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segmentation/drawn_cylinders.h"

namespace saker::segmentation {
namespace {

using testing::kPitch, testing::kPole, testing::kTrunk;

struct Measured : testing::Cylinders {
  [[nodiscard]] PieceFeatures features(const std::vector<std::int32_t>& piece) const {
    return PieceMeter().measure(piece, image, up, {kTrunk}, {kPole}, pixels);
  }
  [[nodiscard]] float feature(const std::vector<std::int32_t>& piece,
                              const std::string& name) const {
    const auto found = std::find(kPieceFeatures.begin(), kPieceFeatures.end(), name);
    return features(piece)[found - kPieceFeatures.begin()];
  }
};

TEST(PieceFeatures, ExtentsAreThoseOfTheSurface) {
  Measured picture;
  const auto piece = picture.draw(0.5F, 8, 0.6F, 1.5F, 0.45F, 0.45F);
  EXPECT_NEAR(std::exp(picture.feature(piece, "width")), 0.8F * 0.6F, 8 * kPitch);
  EXPECT_NEAR(std::exp(picture.feature(piece, "height")), 1.5F, 8 * kPitch);
  EXPECT_NEAR(std::exp(picture.feature(piece, "pixels")), static_cast<float>(piece.size()), 0.1F);
}

TEST(PieceFeatures, OneColumnIsHalfAPixelWide) {
  Measured picture;
  const auto column = picture.draw(80 * kPitch, 30, 0.1F, 1.5F, 0.45F, 0.45F);
  EXPECT_NEAR(std::exp(picture.feature(column, "width")), 30 * 0.5F * kPitch, 1e-3F);
}

TEST(PieceFeatures, OfEvidenceAreMeansOverThePixels) {
  Measured picture;
  const auto piece = picture.draw(0.5F, 8, 0.4F, 2, 0.6F, 0.3F);
  EXPECT_NEAR(picture.feature(piece, "crowned_to_bare"), std::log(2.0F), 1e-4F);
  EXPECT_NEAR(picture.feature(piece, "cylinder"), std::log(9.0F), 1e-4F);
}

TEST(PieceFeatures, OfCertainPixelsAndOfASinglePixelAreFinite) {
  Measured picture;
  const auto certain = picture.draw(0.5F, 8, 0.4F, 2, 1, 0);
  EXPECT_TRUE(picture.features(certain).allFinite());
  EXPECT_TRUE(picture.features({certain.front()}).allFinite());
}

TEST(PieceFeatures, OfAPixelRightAboveTheSensorAreFinite) {
  Measured picture;
  const auto piece = picture.draw(0.5F, 8, 0.4F, 2, 0.5F, 0.4F);
  picture.image.points[piece.front()] = {0, 0, 5};
  EXPECT_TRUE(picture.features({piece.front()}).allFinite());
}

}  // namespace
}  // namespace saker::segmentation
