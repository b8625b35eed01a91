#include "saker/segmentation/cuboid_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segmentation/drawn_picture.h"

namespace saker::segmentation {
namespace {

using testing::kTrunk, testing::kVehicle;

struct Picture : testing::Picture {
  std::vector<std::size_t> draw(float azimuth, float width, float height, float probability) {
    const auto drawn = testing::Picture::draw(azimuth, 15, width, height);
    believe(drawn, kVehicle, probability);
    return drawn;
  }

  void decide() { CuboidPieces(table).decide(image, up, pixels); }
  [[nodiscard]] float vehicle(const std::vector<std::size_t>& piece) const {
    return pixels.at(piece.front())[kVehicle];
  }
};

TEST(CuboidPieces, ThatAreLowAndUnsureAreNoVehicle) {
  Picture picture;
  const auto fence = picture.draw(0.5F, 4, 0.8F, 0.65F);
  picture.decide();
  for (const std::size_t i : fence) {
    EXPECT_EQ(picture.at(i)[kVehicle], 0);
    EXPECT_NEAR(picture.at(i)[0], 1, 1e-6F);
  }
}

TEST(CuboidPieces, ThatAreLowButSureStay) {
  Picture picture;
  const auto roof = picture.draw(0.5F, 1.5F, 0.6F, 0.95F);
  picture.decide();
  EXPECT_FLOAT_EQ(picture.vehicle(roof), 0.95F);
}

TEST(CuboidPieces, AsHighAsAVehicleStayThoughUnsure) {
  Picture picture;
  const auto car = picture.draw(0.5F, 4, 1.5F, 0.6F);
  picture.decide();
  EXPECT_FLOAT_EQ(picture.vehicle(car), 0.6F);
}

TEST(CuboidPieces, AreJudgedOneByOne) {
  Picture picture;
  const auto car = picture.draw(0.5F, 4, 1.5F, 0.6F);
  const auto fence = picture.draw(0.9F, 4, 0.8F, 0.65F);  // its end 2 m beside the car's
  picture.decide();
  EXPECT_GT(picture.vehicle(car), 0.5F);
  EXPECT_EQ(picture.vehicle(fence), 0);
}

TEST(CuboidPieces, AreNotCutByTheSeamOfTheImage) {
  Picture picture;
  const auto car = picture.draw(0, 4, 0.8F, 0.6F);
  std::vector<std::size_t> left, right;
  for (const std::size_t i : car) (i % testing::kColumns < 512 ? left : right).push_back(i);
  ASSERT_GT(std::min(left.size(), right.size()), car.size() / 3);
  picture.believe(left, kVehicle, 0.95F);  // 0.775 together
  picture.decide();
  EXPECT_FLOAT_EQ(picture.vehicle(right), 0.6F);
}

TEST(CuboidPieces, OfAClassThatIsLowMayBeLow) {
  Picture picture;
  picture.table.classes[kVehicle].size_m = {1.2, 0.6, 1.0};  // a bin
  const auto bin = picture.draw(0.5F, 1.2F, 0.9F, 0.6F);
  picture.decide();
  EXPECT_FLOAT_EQ(picture.vehicle(bin), 0.6F);
}

TEST(CuboidPieces, LeaveOtherClassesAlone) {
  Picture picture;
  const auto bush = picture.draw(0.5F, 4, 0.8F, 0.3F);
  picture.believe(bush, kTrunk, 0.3F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide();
  EXPECT_EQ(picture.pixels.values, before);
}

}  // namespace
}  // namespace saker::segmentation
