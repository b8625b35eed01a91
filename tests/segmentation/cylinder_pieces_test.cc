#include "saker/segmentation/cylinder_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "segmentation/drawn_cylinders.h"

namespace saker::segmentation {
namespace {

using testing::kPitch, testing::kPole, testing::kTrunk;

int index_of(const std::string& feature) {
  const auto found = std::find(kPieceFeatures.begin(), kPieceFeatures.end(), feature);
  return static_cast<int>(found - kPieceFeatures.begin());
}

/// Two to one to one, whatever the piece is like.
PieceModel constant() {
  PieceModel model;
  model.crowned[index_of("one")] = std::log(2.0F);
  return model;
}

/// As likely a trunk as a pole at 0.2 m; hardly ever neither.
PieceModel by_width() {
  PieceModel model;
  model.crowned[index_of("width")] = 3, model.bare[index_of("width")] = -3;
  model.crowned[index_of("one")] = 4 - 3 * std::log(0.2F);
  model.bare[index_of("one")] = 4 + 3 * std::log(0.2F);
  return model;
}

struct Drawing : testing::Cylinders {
  void decide(const std::optional<PieceModel>& model) {
    CylinderPieces(table, model).decide(image, up, pixels);
  }
  [[nodiscard]] float trunk(std::size_t i) const { return pixels.at(i)[kTrunk]; }
  [[nodiscard]] float pole(std::size_t i) const { return pixels.at(i)[kPole]; }
};

TEST(CylinderPieces, GiveEveryPixelTheModelsProbabilities) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.1F, 0.8F);
  for (std::size_t k = 0; k < piece.size(); k += 3) {
    std::swap(picture.at(piece[k])[kTrunk], picture.at(piece[k])[kPole]);
  }
  picture.decide(constant());
  for (const std::int32_t i : piece) {
    EXPECT_NEAR(picture.trunk(i), 0.5F, 1e-5F);
    EXPECT_NEAR(picture.pole(i), 0.25F, 1e-5F);
    EXPECT_NEAR(picture.pixels.at(i)[0], 0.25F, 1e-5F);
  }
}

TEST(CylinderPieces, LeaveTheOtherClassesInTheirRatio) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.3F, 0.3F);
  for (const std::int32_t i : piece) picture.at(i)[0] = 0.1F, picture.at(i)[1] = 0.3F;
  picture.decide(constant());
  EXPECT_NEAR(picture.pixels.at(piece.front())[1], 0.75F * 0.25F, 1e-5F);
}

TEST(CylinderPieces, ThatAreNeitherAreClassZeroWhereTheNetworkSawNothingElse) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.5F, 0.5F);
  PieceModel never;
  never.crowned[index_of("one")] = never.bare[index_of("one")] = -20;
  picture.decide(never);
  EXPECT_NEAR(picture.pixels.at(piece.front())[0], 1, 1e-5F);
}

TEST(CylinderPieces, WithoutAModelStay) {
  Drawing picture;
  picture.draw(0.5F, 8, 0.35F, 2, 0.1F, 0.8F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(std::nullopt);
  EXPECT_EQ(picture.pixels.values, before);
}

TEST(CylinderPieces, ThatAreLessLikelyThanNotStay) {
  Drawing picture;
  picture.draw(0.5F, 8, 0.35F, 2, 0.2F, 0.2F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(constant());
  EXPECT_EQ(picture.pixels.values, before);
}

TEST(CylinderPieces, ThatStandApartDecideApart) {
  Drawing picture;
  const auto trunk = picture.draw(0.5F, 8, 0.4F, 2, 0.45F, 0.45F);
  const auto pole = picture.draw(0.58F, 8, 0.1F, 2, 0.45F, 0.45F);
  picture.decide(by_width());
  EXPECT_GT(picture.trunk(trunk.front()), 0.8F);
  EXPECT_GT(picture.pole(pole.front()), 0.8F);
}

TEST(CylinderPieces, AreNotCutByTheSeamOfTheImage) {
  Drawing seam, beside;
  const auto cut = seam.draw(0, 8, 0.3F, 2, 0.45F, 0.45F);
  const auto whole = beside.draw(64 * kPitch, 8, 0.3F, 2, 0.45F, 0.45F);
  ASSERT_EQ(cut.size(), whole.size());
  seam.decide(by_width());
  beside.decide(by_width());
  EXPECT_NEAR(seam.trunk(cut.front()), beside.trunk(whole.front()), 1e-3F);
}

TEST(CylinderPieces, AreTheSameForATiltedSensor) {
  Drawing level, tilted;
  const auto piece = level.draw(0.5F, 8, 0.3F, 1.6F, 0.45F, 0.45F);
  tilted.draw(0.5F, 8, 0.3F, 1.6F, 0.45F, 0.45F);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.4F, Eigen::Vector3f(0.6F, 0.8F, 0)).toRotationMatrix();
  for (const std::int32_t i : piece) tilted.image.points[i] = turn * tilted.image.points[i];
  tilted.up = turn * tilted.up;
  level.decide(by_width());
  tilted.decide(by_width());
  EXPECT_NEAR(level.trunk(piece.front()), tilted.trunk(piece.front()), 1e-3F);
}

TEST(CylinderPieces, LeaveATableWithoutCylindersAlone) {
  Drawing picture;
  for (const int k : {kTrunk, kPole}) picture.table.classes[k].shape = objects::Shape::none;
  picture.draw(80 * kPitch, 30, 0.15F, 0.5F, 0.5F, 0.4F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(constant());
  EXPECT_EQ(picture.pixels.values, before);
}

}  // namespace
}  // namespace saker::segmentation
