#include "saker/detection/face_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

constexpr double kHalf = 0.9;  // m

double mean(const FaceDensity& density) {
  double sum = 0, first = 0;
  for (std::size_t i = 0; i < density.probability.size(); ++i) {
    sum += density.probability[i];
    first += density.probability[i] * (density.first + static_cast<double>(i) * kCell);
  }
  return first / sum;
}

double sd(const FaceDensity& density) {
  double sum = 0, second = 0;
  const double middle = mean(density);
  for (std::size_t i = 0; i < density.probability.size(); ++i) {
    const double off = density.first + static_cast<double>(i) * kCell - middle;
    sum += density.probability[i];
    second += density.probability[i] * off * off;
  }
  return std::sqrt(second / sum);
}

/// Nine strips of an end whose outermost line lies at 2 m.
FaceView bowed_view(double depth) {
  const Bow bow{depth, kHalf};
  FaceView view{{}, 2, 0, kHalf, true, 0.85, 0, 1, 10};
  for (double y = -0.8; y <= 0.81; y += 0.2) view.strips.push_back({y, 2 - bow.at(y)});
  return view;
}

FaceView end_view(const FaceConfig& config) { return bowed_view(0.5 * config.bow_end_m); }

double likeliest(const FaceDensity& density) {
  const auto most = std::ranges::max_element(density.probability) - density.probability.begin();
  return density.first + static_cast<double>(most) * kCell;
}

/// Share of it within 0.2 m of a place.
double share_at(const FaceDensity& density, double place) {
  double sum = 0, near = 0;
  for (std::size_t i = 0; i < density.probability.size(); ++i) {
    const double at = density.first + static_cast<double>(i) * kCell;
    sum += density.probability[i];
    if (std::abs(at - place) < 0.2) near += density.probability[i];
  }
  return near / sum;
}

TEST(FaceDensity, OfASeenFaceLiesAtItsHitsUnlessTheyAreNotIts) {
  const FaceView view = end_view({});
  const FaceDensity density = face_density(view, INFINITY, {});
  EXPECT_NEAR(likeliest(density), 2.03, 0.05);
  EXPECT_NEAR(share_at(density, 2.03), view.seen, 0.03);
}

TEST(FaceDensity, OfASeenFaceLiesAtItsMiddleHoweverDeepItBows) {
  for (const double depth : {0.0, 0.2, 0.4}) {
    const FaceDensity density = face_density(bowed_view(depth), INFINITY, {});
    EXPECT_NEAR(likeliest(density), 2.02, 0.05) << depth;
  }
}

TEST(FaceDensity, CornersAloneShowThatTheFaceLiesFartherOut) {
  const FaceConfig config;
  FaceView view = end_view(config);
  std::erase_if(view.strips, [](const Strip& strip) { return strip.across < 0.5; });
  view.hits = view.strips.front().outward;
  EXPECT_GT(mean(face_density(view, 2.1, config)), view.hits + 0.03);
}

TEST(FaceDensity, AMirrorMovesNoSide) {
  FaceView view{{}, 0.9, 0, 2.2, false, 0.85, 0, 1, 10};
  for (double x = -2; x <= 2; x += 0.2) view.strips.push_back({x, 0.9});
  FaceConfig flat;
  flat.bow_side_m = 0;
  const double plain = mean(face_density(view, 0.95, flat));
  view.strips[14].outward = 1.08;
  EXPECT_NEAR(mean(face_density(view, 0.95, flat)), plain, 0.02);
}

TEST(FaceDensity, OfASeenFaceThatNoBeamPassesMayBeHidden) {
  const FaceView view = end_view({});
  EXPECT_GT(share_at(face_density(view, 2.05, {}), 2.03), 0.95);
  EXPECT_LT(share_at(face_density(view, 3.5, {}), 2.03), 0.6);
}

TEST(FaceDensity, OfAnUnseenFaceLiesAtTheCornerOfASeenOneWhereBeamsPass) {
  FaceView view = end_view({});
  view.seen = 0;
  view.corner = 0.5;
  EXPECT_NEAR(mean(face_density(view, 2.3, {})), 2.2, 0.1);
  EXPECT_GT(mean(face_density(view, 6, {})), 2.7);
}

TEST(FaceDensity, OfAHiddenFaceEndsWhereBeamsPass) {
  FaceView view = end_view({});
  view.seen = 0;
  EXPECT_GT(sd(face_density(view, INFINITY, {})), 0.5);
  const FaceDensity free = face_density(view, 2.3, {});
  EXPECT_LT(sd(free), 0.2);
  EXPECT_NEAR(mean(free), 2.2, 0.1);
}

TEST(SizeDensity, OfTwoKnownFacesIsTheirDistanceWhateverThePrior) {
  const FaceDensity face = face_density(end_view({}), 2.05, {});
  const auto moments = SizeDensity(face, face).with({5, 0.5});
  EXPECT_NEAR(moments.mean.sum(), 2 * mean(face), 0.05);
}

TEST(SizeDensity, PriorPlacesAHiddenFace) {
  FaceView hidden = end_view({});
  hidden.seen = 0;
  const FaceDensity seen = face_density(end_view({}), 2.05, {});
  const SizeDensity size(seen, face_density(hidden, INFINITY, {}));
  const auto moments = size.with({4.6, 0.2});
  EXPECT_NEAR(moments.mean.sum(), 4.6, 0.05);
  const Eigen::Matrix2d covariance = moments.second - moments.mean * moments.mean.transpose();
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), 0.2, 0.06);
}

TEST(SizeDensity, LikelierSizeHasMoreEvidence) {
  const FaceDensity face = face_density(end_view({}), 2.05, {});
  const SizeDensity size(face, face);
  EXPECT_GT(size.with({4.1, 0.2}).log_evidence, size.with({6, 0.2}).log_evidence + 5);
}

TEST(StripsAlong, AreTheOutermostLayersOfBothFaces) {
  Places places;
  for (double y = 0.05; y < 1.8; y += 0.05) {
    for (const double x : {-1.0, -0.97, 0.0, 1.97, 2.0}) places.emplace_back(x, y);
  }
  const FaceStrips strips = strips_along(places, 0, {});
  ASSERT_EQ(strips.high.size(), 9u);
  for (const Strip& strip : strips.high) EXPECT_NEAR(strip.outward, 1.985, 1e-9);
  for (const Strip& strip : strips.low) EXPECT_NEAR(strip.outward, 0.985, 1e-9);
}

TEST(FaceDensity, OfAHiddenSideReachesAWidthBeyondHitsOnTheOther) {
  FaceView view{{}, 0.1, 0, 2.2, false, 0, 0, 1, 10};
  for (double x = -2; x <= 2; x += 0.2) view.strips.push_back({x, 0.1});
  const FaceDensity density = face_density(view, INFINITY, {});
  EXPECT_GT(share_at(density, 1.8), 0.1);
}

}  // namespace
}  // namespace saker::detection
