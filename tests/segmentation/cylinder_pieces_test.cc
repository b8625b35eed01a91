#include "saker/segmentation/cylinder_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "segmentation/drawn_picture.h"

namespace saker::segmentation {
namespace {

using testing::kPitch, testing::kPole, testing::kTrunk;

/// With trunks and poles.
struct Picture : testing::Picture {
  std::vector<std::size_t> draw(float azimuth, float distance, float width, float height,
                                float trunk, float pole) {
    const auto drawn = testing::Picture::draw(azimuth, distance, width, height);
    for (const std::size_t i : drawn) {
      at(i)[kTrunk] = trunk, at(i)[kPole] = pole, at(i)[0] = 1 - trunk - pole;
    }
    return drawn;
  }

  void decide() { CylinderPieces(table).decide(image, up, pixels); }
  [[nodiscard]] float trunk(std::size_t i) const { return pixels.at(i)[kTrunk]; }
  [[nodiscard]] float pole(std::size_t i) const { return pixels.at(i)[kPole]; }
};

TEST(CylinderPieces, AreTrunksWhereWideAndPolesWhereThinIfThePixelsCannotTell) {
  Picture picture;
  const auto wide = picture.draw(0.5F, 8, 0.4F, 2, 0.45F, 0.45F);
  const auto thin = picture.draw(1.5F, 8, 0.1F, 2, 0.45F, 0.45F);
  picture.decide();
  EXPECT_GT(picture.trunk(wide.front()), 0.7F);
  EXPECT_GT(picture.pole(thin.front()), 0.6F);
}

TEST(CylinderPieces, ShareOneRatioWhateverSinglePixelsSay) {
  Picture picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.1F, 0.8F);
  for (std::size_t k = 0; k < piece.size(); k += 3) {
    std::swap(picture.at(piece[k])[kTrunk], picture.at(piece[k])[kPole]);
  }
  picture.decide();
  for (const std::size_t i : piece) {
    EXPECT_NEAR(picture.trunk(i), picture.trunk(piece.front()), 1e-5F);
    EXPECT_NEAR(picture.trunk(i) + picture.pole(i), 0.9F, 1e-5F);
    EXPECT_NEAR(picture.pixels.at(i)[0], 0.1F, 1e-5F);
  }
}

TEST(CylinderPieces, OfCertainPixelsStayWhatTheyAre) {
  Picture picture;
  const auto pole = picture.draw(0.5F, 8, 0.25F, 2, 0.01F, 0.98F);
  const auto trunk = picture.draw(1.5F, 8, 0.15F, 2, 0.98F, 0.01F);
  picture.decide();
  EXPECT_GT(picture.pole(pole.front()), 0.8F);
  EXPECT_GT(picture.trunk(trunk.front()), 0.8F);
}

TEST(CylinderPieces, OfFewPixelsOrShortAndStoutOnesAreNoCylinder) {
  Picture picture;
  const auto few = picture.draw(80 * kPitch, 30, 0.15F, 0.5F, 0.5F, 0.4F);
  const auto stout = picture.draw(1.5F, 8, 0.5F, 0.8F, 0.5F, 0.4F);
  ASSERT_GT(few.size(), 1);
  ASSERT_LT(few.size(), 4);
  ASSERT_GT(stout.size(), 40);
  picture.decide();
  for (const auto& piece : {few, stout}) {
    for (const std::size_t i : piece) {
      EXPECT_EQ(picture.trunk(i) + picture.pole(i), 0);
      EXPECT_NEAR(picture.pixels.at(i)[0], 1, 1e-5F);
    }
  }
}

TEST(CylinderPieces, ThatAreShortButSlenderStay) {
  Picture picture;
  const auto bollard = picture.draw(0.5F, 6, 0.12F, 0.8F, 0.1F, 0.8F);
  picture.decide();
  EXPECT_GT(picture.pole(bollard.front()), 0.8F);
}

TEST(CylinderPieces, ThatStandApartDecideApart) {
  Picture picture;
  const auto trunk = picture.draw(0.5F, 8, 0.4F, 2, 0.6F, 0.3F);
  const auto pole = picture.draw(0.58F, 8, 0.1F, 2, 0.3F, 0.6F);
  picture.decide();
  EXPECT_GT(picture.trunk(trunk.front()), 0.8F);
  EXPECT_GT(picture.pole(pole.front()), 0.7F);
}

TEST(CylinderPieces, AreNotCutByTheSeamOfTheImage) {
  Picture seam, beside;
  const auto cut = seam.draw(0, 8, 0.4F, 2, 0.45F, 0.45F);
  const auto whole = beside.draw(64 * kPitch, 8, 0.4F, 2, 0.45F, 0.45F);
  ASSERT_EQ(cut.size(), whole.size());
  seam.decide();
  beside.decide();
  EXPECT_NEAR(seam.trunk(cut.front()), beside.trunk(whole.front()), 1e-3F);
}

TEST(CylinderPieces, AreTheSameForATiltedSensor) {
  Picture level, tilted;
  const auto piece = level.draw(0.5F, 8, 0.3F, 1.6F, 0.45F, 0.45F);
  tilted.draw(0.5F, 8, 0.3F, 1.6F, 0.45F, 0.45F);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.4F, Eigen::Vector3f(0.6F, 0.8F, 0)).toRotationMatrix();
  for (const std::size_t i : piece) tilted.image.points[i] = turn * tilted.image.points[i];
  tilted.up = turn * tilted.up;
  level.decide();
  tilted.decide();
  EXPECT_NEAR(level.trunk(piece.front()), tilted.trunk(piece.front()), 1e-3F);
}

TEST(CylinderPieces, OfClassesThatStateNoWidthAreToldByThePixelsAlone) {
  Picture picture;
  const std::vector<double> a_cars = objects::ObjectClass{}.size_m;
  picture.table.classes[kTrunk].size_m = picture.table.classes[kPole].size_m = a_cars;
  const auto wide = picture.draw(0.5F, 8, 0.4F, 2, 0.3F, 0.6F);
  picture.decide();
  EXPECT_NEAR(picture.trunk(wide.front()), 0.9F / (1 + std::pow(2.0F, 0.75F)), 1e-4F);
}

TEST(CylinderPieces, LeaveATableWithoutCylindersAlone) {
  Picture picture;
  for (const int k : {kTrunk, kPole}) picture.table.classes[k].shape = objects::Shape::none;
  picture.draw(80 * kPitch, 30, 0.15F, 0.5F, 0.5F, 0.4F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide();
  EXPECT_EQ(picture.pixels.values, before);
}

}  // namespace
}  // namespace saker::segmentation
