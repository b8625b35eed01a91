#include "saker/segmentation/piece_features.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "segmentation/drawn_cylinders.h"

namespace saker::segmentation {
namespace {

using testing::kPitch, testing::kPole, testing::kTrunk;

struct Measured : testing::Cylinders {
  [[nodiscard]] PieceFeatures features(const std::vector<std::int32_t>& piece) const {
    const std::vector<std::vector<int>> kinds = {{kTrunk}, {kPole}};
    return PieceMeter(PieceFamily::cylinders).measure(piece, image, up, kinds, pixels);
  }
  [[nodiscard]] float feature(const std::vector<std::int32_t>& piece,
                              const std::string& name) const {
    const auto names = info_of(PieceFamily::cylinders).features;
    return features(piece)[std::find(names.begin(), names.end(), name) - names.begin()];
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

/// All that is drawn is one piece.
struct MeasuredVehicle : testing::Picture {
  [[nodiscard]] float feature(const std::string& name) const {
    std::vector<std::int32_t> piece;
    for (std::size_t i = 0; i < image.range.size(); ++i)
      if (image.range[i] > 0) piece.push_back(static_cast<std::int32_t>(i));
    const auto names = info_of(PieceFamily::vehicles).features;
    const std::vector<std::vector<int>> kinds = {{testing::kVehicle}};
    const PieceFeatures features =
        PieceMeter(PieceFamily::vehicles).measure(piece, image, up, kinds, pixels);
    return features[std::find(names.begin(), names.end(), name) - names.begin()];
  }
};

TEST(PieceFeatures, AVehiclesLengthLiesAlongItsLongerSide) {
  MeasuredVehicle seen;
  for (const std::size_t i : seen.draw(1.0F, 10, 4, 1.5F)) {
    seen.at(i)[testing::kVehicle] = 0.9F;
  }
  const float added = 0.1F + 10 * 0.5F * kPitch;
  EXPECT_NEAR(std::exp(seen.feature("length")) - added, 0.9F * 4, 0.1F);
  EXPECT_LT(std::exp(seen.feature("width")) - added, 0.2F);
  EXPECT_NEAR(std::exp(seen.feature("height")) - added, 0.9F * 1.5F, 0.1F);
  EXPECT_NEAR(std::exp(seen.feature("range")), 10, 0.3F);
  EXPECT_NEAR(seen.feature("vehicle"), std::log(9.0F), 1e-3F);
}

TEST(PieceFeatures, OfAVehicleAreTheSameHoweverTheSensorTilts) {
  MeasuredVehicle level, tilted;
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.4F, Eigen::Vector3f(0.6F, 0.8F, 0)).toRotationMatrix();
  for (const std::size_t i : level.draw(1.0F, 10, 4, 1.5F)) level.at(i)[testing::kVehicle] = 0.9F;
  for (const std::size_t i : tilted.draw(1.0F, 10, 4, 1.5F)) {
    tilted.at(i)[testing::kVehicle] = 0.9F;
    tilted.image.points[i] = turn * tilted.image.points[i];
  }
  tilted.up = turn * tilted.up;
  for (const char* name : info_of(PieceFamily::vehicles).features)
    EXPECT_NEAR(level.feature(name), tilted.feature(name), 2e-3F) << name;
}

TEST(PieceFeatures, OfASinglePixelOfAVehicleAreFinite) {
  MeasuredVehicle seen;
  seen.image.points[5] = {7, 1, 0};
  seen.image.range[5] = 7;
  for (const char* name : info_of(PieceFamily::vehicles).features)
    EXPECT_TRUE(std::isfinite(seen.feature(name))) << name;
}

}  // namespace
}  // namespace saker::segmentation
