#include "tools/saker/picture/picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/rng.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

fs::path picture_file(const std::string& name) { return fs::path(testing::TempDir()) / name; }

cv::Mat saved(const Picture& picture, const std::string& name) {
  const fs::path file = picture_file(name);
  picture.save(file);
  cv::Mat image = cv::imread(file.string());
  fs::remove(file);
  fs::remove(svg_beside(file));
  return image;
}

/// As SVG.
std::string drawn(const Picture& picture) {
  const fs::path file = picture_file("drawn.svg");
  picture.save(file);
  const std::string svg = core::read_file(file);
  fs::remove(file);
  return svg;
}

int count_of(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Mean place of the pixels that are nearly of the colour.
Eigen::Vector2d centre_of(const cv::Mat& image, Colour c, int* count = nullptr) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int n = 0;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto& p = image.at<cv::Vec3b>(v, u);
      if (std::abs(p[0] - c.blue) + std::abs(p[1] - c.green) + std::abs(p[2] - c.red) > 30)
        continue;
      sum += Eigen::Vector2d(u, v);
      ++n;
    }
  }
  if (count != nullptr) *count = n;
  return sum / n;
}

Extent square() {
  Extent extent;
  extent.include({-10, -10});
  extent.include({10, 10});
  return extent;
}

TEST(Picture, XIsToTheRightAndYIsUp) {
  Picture picture(square(), 800);
  picture.disc({0, 0}, 3, colours::kBlue);
  picture.disc({5, 0}, 3, colours::kOrange);
  picture.disc({0, 5}, 3, colours::kGreen);
  const cv::Mat image = saved(picture, "axes.png");
  const Eigen::Vector2d o = centre_of(image, colours::kBlue);
  const double px_per_m = 40;
  EXPECT_NEAR((centre_of(image, colours::kOrange) - o - Eigen::Vector2d(5 * px_per_m, 0)).norm(), 0,
              0.5);
  EXPECT_NEAR((centre_of(image, colours::kGreen) - o - Eigen::Vector2d(0, -5 * px_per_m)).norm(), 0,
              0.5);
}

TEST(Picture, ARectangleHasItsSize) {
  Picture picture(square(), 800);
  picture.rectangle({0, 0}, 0.5, 8, 4, colours::kOrange, 1);
  int n = 0;
  (void)centre_of(saved(picture, "rectangle.png"), colours::kOrange, &n);
  EXPECT_GT(n, 200);  // edges of 24 m at 40 px/m, of which the anti-aliased ones are paler
  EXPECT_LT(n, 1200);
}

TEST(Picture, WhatIsOutsideOrNotFiniteIsNotDrawn) {
  const cv::Mat blank = saved(Picture(square(), 400), "blank.png");
  Picture picture(square(), 400);
  const Eigen::Vector2d nan = Eigen::Vector2d::Constant(NAN), far(1e12, -1e12);
  picture.points(std::vector<Eigen::Vector2d>{nan, far}, colours::kInk);
  picture.disc(nan, 5, colours::kInk);
  picture.circle(far, 1, colours::kInk);
  picture.circle({0, 0}, NAN, colours::kInk);
  picture.rectangle(nan, 0, 1, 1, colours::kInk);
  picture.text(nan, "x", colours::kInk);
  const cv::Mat image = saved(picture, "outside.png");
  EXPECT_EQ(cv::norm(blank, image, cv::NORM_INF), 0);
}

// Of a view of 400 × 400 pixels: where it begins, and what lies inside of its frame.
constexpr int kViewLeft = 64, kViewTop = 80;
const cv::Rect kInView(kViewLeft + 2, kViewTop + 2, 396, 396);

TEST(Picture, PointsGetDarkerWhereThereAreMore) {
  Picture picture(square(), 400);
  picture.points(std::vector<Eigen::Vector2d>(1, {-5, 0}), colours::kInk);
  picture.points(std::vector<Eigen::Vector2d>(20, {5, 0}), colours::kInk);
  int dark = 0;
  const Eigen::Vector2d at = centre_of(saved(picture, "points.png")(kInView), colours::kInk, &dark);
  EXPECT_EQ(dark, 1);
  EXPECT_NEAR(at.x() + kInView.x, kViewLeft + 15 * 20, 1);
}

TEST(Picture, TheSameCallsMakeTheSameFile) {
  const auto bytes = [] {
    Picture picture(Extent{});
    picture.title("nothing");
    picture.legend(
        {{Mark::dot, colours::kInk, "points"}, {Mark::rectangle, colours::kBlue, "vehicle"}});
    const fs::path file = picture_file("same.png");
    picture.save(file);
    return core::read_file(file) + core::read_file(svg_beside(file));
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(Picture, AFileThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(Picture(square()).save("/no/such/folder/map.png"), Error);
}

TEST(Picture, StripsStandAboveTheViewInTheOrderInWhichTheyCame) {
  Picture picture(square(), 800);
  picture.disc({0, 0}, 3, colours::kGreen);
  const Eigen::Vector2d without = centre_of(saved(picture, "no_strip.png"), colours::kGreen);
  picture.strip({1, 2, {colours::kBlue, colours::kOrange}}, "first");
  picture.strip({2, 1, {colours::kPurple, colours::kPurple}}, "second");
  const cv::Mat image = saved(picture, "strips.png");
  const Eigen::Vector2d blue = centre_of(image, colours::kBlue);
  const Eigen::Vector2d orange = centre_of(image, colours::kOrange);
  const Eigen::Vector2d purple = centre_of(image, colours::kPurple);
  const Eigen::Vector2d green = centre_of(image, colours::kGreen);
  EXPECT_LT(blue.x(), orange.x());
  EXPECT_NEAR(blue.y(), orange.y(), 1);
  EXPECT_LT(blue.y(), purple.y());
  EXPECT_LT(purple.y(), green.y());
  EXPECT_GT(green.y(), without.y() + 200);
}

TEST(Picture, AxesStandAroundTheViewAndNothingIsDrawnOverThem) {
  Picture picture(square(), 400);
  const cv::Mat axes = saved(picture, "axes_alone.png");
  picture.polyline(std::vector<Eigen::Vector2d>{{-40, 3}, {40, 3}}, colours::kOrange, 3);
  const cv::Mat image = saved(picture, "axes_crossed.png");
  cv::Mat difference;
  cv::absdiff(axes, image, difference);
  EXPECT_GT(cv::norm(difference, cv::NORM_INF), 100);
  difference(cv::Rect(kViewLeft, kViewTop, 400, 400)).setTo(0);
  EXPECT_EQ(cv::norm(difference, cv::NORM_INF), 0);
}

TEST(PictureSvg, ARectangleHasItsPlaceAndSize) {
  Picture picture(square(), 800);
  picture.rectangle({1, 2}, 0, 4, 2, colours::kOrange, 1);
  const std::string svg = drawn(picture);
  EXPECT_NE(svg.find("viewBox=\"0 0 900 1004\""), std::string::npos) << svg.substr(0, 400);
  const double left = kViewLeft + 9 * 40, right = left + 4 * 40;
  const double top = kViewTop + 7 * 40, bottom = top + 2 * 40;
  const std::string corners = fmt::format(
      "{1:.2f},{2:.2f} {0:.2f},{2:.2f} {0:.2f},{3:.2f} {1:.2f},{3:.2f}", left, right, top, bottom);
  EXPECT_NE(svg.find("<polygon points=\"" + corners + "\""), std::string::npos) << corners;
}

TEST(PictureSvg, AxesSayMetresAndTextsAreTexts) {
  Picture picture(square(), 800);
  picture.title("a < b & c");
  const std::string svg = drawn(picture);
  for (const char* text : {">x, m<", ">y, m<", ">-10<", ">8<", ">2 m<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_NE(svg.find("<title>a &lt; b &amp; c</title>"), std::string::npos);
  EXPECT_EQ(count_of(svg, "a &lt; b &amp; c</text>"), 1);
  EXPECT_EQ(svg.find("a < b"), std::string::npos);
}

TEST(PictureSvg, ManyPointsAreOneImageBelowWhatIsDrawnLater) {
  Picture picture(square(), 800);
  core::Rng rng(1);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 300000; ++i) points.emplace_back(rng.uniform(-10, 10), rng.uniform(-10, 10));
  picture.points(points, colours::kInk);
  picture.points(points, colours::kGreen);
  picture.disc({0, 0}, 3, colours::kBlue);
  const std::string svg = drawn(picture);
  EXPECT_EQ(count_of(svg, "<image"), 1);
  EXPECT_LT(svg.size(), 2'000'000U);
  EXPECT_LT(svg.find("<image"), svg.find(fmt::format("cy=\"{:.1f}\"", kViewTop + 400.0)));
}

TEST(PictureSvg, StandsBesideThePngOrAlone) {
  const fs::path file = picture_file("beside.png");
  Picture(square()).save(file);
  EXPECT_TRUE(fs::remove(file));
  EXPECT_TRUE(fs::remove(svg_beside(file)));
  Picture(square()).save(svg_beside(file));
  EXPECT_FALSE(fs::exists(file));
  EXPECT_EQ(core::read_file(svg_beside(file)).substr(0, 5), "<?xml");
  fs::remove(svg_beside(file));
}

TEST(Picture, TheRampGrowsBrighterAndTakesAnyNumber) {
  const auto brightness = [](double fraction) {
    const Colour c = ramp(fraction);
    return c.red + 2 * c.green + c.blue;
  };
  for (double f = 0; f < 0.95; f += 0.1) EXPECT_LT(brightness(f), brightness(f + 0.1)) << f;
  EXPECT_EQ(brightness(-1), brightness(0));
  EXPECT_EQ(brightness(2), brightness(1));
  EXPECT_EQ(brightness(NAN), brightness(0));
}

}  // namespace
}  // namespace saker::tools
