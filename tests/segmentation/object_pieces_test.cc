#include "saker/segmentation/object_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "segmentation/drawn_cylinders.h"

namespace saker::segmentation {
namespace {

using testing::kPitch, testing::kPole, testing::kTrunk;

Eigen::Index index_of(PieceFamily family, const std::string& feature) {
  const auto names = info_of(family).features;
  return std::find(names.begin(), names.end(), feature) - names.begin();
}

PieceModel nothing(PieceFamily family) {
  const auto features = static_cast<Eigen::Index>(info_of(family).features.size());
  return {std::vector<PieceFeatures>(info_of(family).kinds.size(), PieceFeatures::Zero(features))};
}

float& weight(PieceModel& model, std::size_t kind, const std::string& feature) {
  const bool vehicles = model.kinds.size() == 1;
  return model
      .kinds[kind][index_of(vehicles ? PieceFamily::vehicles : PieceFamily::cylinders, feature)];
}

/// Two to one to one, whatever the piece is like.
PieceModel constant() {
  PieceModel model = nothing(PieceFamily::cylinders);
  weight(model, 0, "one") = std::log(2.0F);
  return model;
}

/// As likely a trunk as a pole at 0.2 m; hardly ever neither.
PieceModel by_width() {
  PieceModel model = nothing(PieceFamily::cylinders);
  weight(model, 0, "width") = 3, weight(model, 1, "width") = -3;
  weight(model, 0, "one") = 4 - 3 * std::log(0.2F);
  weight(model, 1, "one") = 4 + 3 * std::log(0.2F);
  return model;
}

struct Drawing : testing::Cylinders {
  void decide(const std::optional<PieceModel>& model) {
    ObjectPieces(PieceFamily::cylinders, table, model).decide(image, up, pixels);
  }
  [[nodiscard]] float trunk(std::size_t i) const { return pixels.at(i)[kTrunk]; }
  [[nodiscard]] float pole(std::size_t i) const { return pixels.at(i)[kPole]; }
};

TEST(ObjectPieces, GiveEveryPixelTheModelsProbabilities) {
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

TEST(ObjectPieces, LeaveTheOtherClassesInTheirRatio) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.3F, 0.3F);
  for (const std::int32_t i : piece) picture.at(i)[0] = 0.1F, picture.at(i)[1] = 0.3F;
  picture.decide(constant());
  EXPECT_NEAR(picture.pixels.at(piece.front())[1], 0.75F * 0.25F, 1e-5F);
}

TEST(ObjectPieces, ThatAreNeitherAreClassZeroWhereTheNetworkSawNothingElse) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.5F, 0.5F);
  PieceModel never = nothing(PieceFamily::cylinders);
  weight(never, 0, "one") = weight(never, 1, "one") = -20;
  picture.decide(never);
  EXPECT_NEAR(picture.pixels.at(piece.front())[0], 1, 1e-5F);
}

TEST(ObjectPieces, WithoutAModelStay) {
  Drawing picture;
  picture.draw(0.5F, 8, 0.35F, 2, 0.1F, 0.8F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(std::nullopt);
  EXPECT_EQ(picture.pixels.values, before);
}

TEST(ObjectPieces, ThatAreLikelierThanAnyOtherClassAreDecidedOn) {
  Drawing picture;
  const auto piece = picture.draw(0.5F, 8, 0.35F, 2, 0.2F, 0.2F);
  for (const std::int32_t i : piece) picture.at(i)[0] = picture.at(i)[1] = 0.3F;
  picture.decide(constant());
  EXPECT_NEAR(picture.trunk(piece.front()), 0.5F, 1e-5F);
}

TEST(ObjectPieces, ThatAreLessLikelyThanAnotherClassStay) {
  Drawing picture;
  picture.draw(0.5F, 8, 0.35F, 2, 0.2F, 0.2F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(constant());
  EXPECT_EQ(picture.pixels.values, before);
}

TEST(ObjectPieces, ThatStandApartDecideApart) {
  Drawing picture;
  const auto trunk = picture.draw(0.5F, 8, 0.4F, 2, 0.45F, 0.45F);
  const auto pole = picture.draw(0.58F, 8, 0.1F, 2, 0.45F, 0.45F);
  picture.decide(by_width());
  EXPECT_GT(picture.trunk(trunk.front()), 0.8F);
  EXPECT_GT(picture.pole(pole.front()), 0.8F);
}

TEST(ObjectPieces, AreNotCutByTheSeamOfTheImage) {
  Drawing seam, beside;
  const auto cut = seam.draw(0, 8, 0.3F, 2, 0.45F, 0.45F);
  const auto whole = beside.draw(64 * kPitch, 8, 0.3F, 2, 0.45F, 0.45F);
  ASSERT_EQ(cut.size(), whole.size());
  seam.decide(by_width());
  beside.decide(by_width());
  EXPECT_NEAR(seam.trunk(cut.front()), beside.trunk(whole.front()), 1e-3F);
}

TEST(ObjectPieces, AreTheSameForATiltedSensor) {
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

TEST(ObjectPieces, LeaveATableWithoutCylindersAlone) {
  Drawing picture;
  for (const int k : {kTrunk, kPole}) picture.table.classes[k].shape = objects::Shape::none;
  picture.draw(80 * kPitch, 30, 0.15F, 0.5F, 0.5F, 0.4F);
  const std::vector<float> before = picture.pixels.values;
  picture.decide(constant());
  EXPECT_EQ(picture.pixels.values, before);
}

/// A vehicle's surface, of which the network is so sure.
std::vector<std::size_t> draw_vehicle(testing::Picture& picture, float azimuth, float distance,
                                      float width, float height, float probability) {
  const auto piece = picture.draw(azimuth, distance, width, height);
  for (const std::size_t i : piece) {
    picture.at(i)[testing::kVehicle] = probability;
    picture.at(i)[0] = 1 - probability;
  }
  return piece;
}

TEST(ObjectPieces, AWallThatPixelsCallAVehicleIsNone) {
  testing::Picture picture;
  const auto car = draw_vehicle(picture, 0.5F, 8, 1.8F, 1.5F, 0.8F);
  const auto wall = draw_vehicle(picture, 2.5F, 8, 12, 1.5F, 0.8F);
  PieceModel short_ones = nothing(PieceFamily::vehicles);
  weight(short_ones, 0, "length") = -5;
  weight(short_ones, 0, "one") = 5 * std::log(6.0F);
  ObjectPieces(PieceFamily::vehicles, picture.table, short_ones)
      .decide(picture.image, picture.up, picture.pixels);
  for (const std::size_t i : car) EXPECT_GT(picture.at(i)[testing::kVehicle], 0.9F);
  for (const std::size_t i : wall) EXPECT_LT(picture.at(i)[testing::kVehicle], 0.2F);
}

}  // namespace
}  // namespace saker::segmentation
