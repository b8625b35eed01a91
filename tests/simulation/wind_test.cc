#include "saker/simulation/vehicle/wind.h"

#include <gtest/gtest.h>

namespace saker::simulation {
namespace {

/// Means and standard deviations of 4000 s of wind.
struct Seen {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d sd = Eigen::Vector3d::Zero();
};

Seen seen(const WindConfig& config, double step) {
  Wind wind(config, core::Rng(5));
  const int count = static_cast<int>(4000 / step);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d v = wind.step(step);
    sum += v;
    squares += v.cwiseProduct(v);
  }
  Seen result;
  result.mean = sum / count;
  result.sd = (squares / count - result.mean.cwiseProduct(result.mean)).cwiseSqrt();
  return result;
}

TEST(Wind, HasTheConfiguredMeanAndGustsWhateverTheStep) {
  const WindConfig config{.mean_mps = 4, .towards_deg = 90, .gust_mps = 1, .gust_time_s = 2};
  for (const double step : {0.01, 0.1}) {
    const Seen wind = seen(config, step);
    EXPECT_LT((wind.mean - Eigen::Vector3d(0, 4, 0)).norm(), 0.15);
    EXPECT_NEAR(wind.sd.x(), 1, 0.08);
    EXPECT_NEAR(wind.sd.y(), 1, 0.08);
    EXPECT_NEAR(wind.sd.z(), 0.5, 0.05);
  }
}

TEST(Wind, AGustComesOnTopUntilTheNextOne) {
  Wind wind({.mean_mps = 1, .towards_deg = 0, .gust_mps = 0}, core::Rng(1));
  wind.blow({0, 3, 0});
  EXPECT_LT((wind.step(0.01) - Eigen::Vector3d(1, 3, 0)).norm(), 1e-12);
  wind.blow(Eigen::Vector3d::Zero());
  EXPECT_LT((wind.step(0.01) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

/// Correlation of the gusts along x with those `lag` seconds later.
double correlation(const WindConfig& config, double lag) {
  constexpr double kStep = 0.05;
  Wind wind(config, core::Rng(9));
  std::vector<double> gusts;
  for (int i = 0; i < 200000; ++i) gusts.push_back(wind.step(kStep).x());
  const auto apart = static_cast<std::size_t>(std::lround(lag / kStep));
  double products = 0, squares = 0;
  for (std::size_t i = 0; i + apart < gusts.size(); ++i) {
    products += gusts[i] * gusts[i + apart];
    squares += gusts[i] * gusts[i];
  }
  return products / squares;
}

TEST(Wind, GustsForgetThemselvesInTheirCorrelationTime) {
  const WindConfig config{.mean_mps = 0, .gust_mps = 1, .gust_time_s = 2};
  for (const double lag : {0.5, 1.0, 2.0, 4.0})
    EXPECT_NEAR(correlation(config, lag), std::exp(-lag / 2), 0.06) << lag;
}

TEST(Wind, ItsAxesAreIndependent) {
  Wind wind({.mean_mps = 0, .gust_mps = 1, .gust_time_s = 1}, core::Rng(2));
  double xy = 0, xz = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d v = wind.step(0.5);
    xy += v.x() * v.y() / kCount;
    xz += v.x() * v.z() / kCount;
  }
  EXPECT_NEAR(xy, 0, 0.03);
  EXPECT_NEAR(xz, 0, 0.02);
}

TEST(Wind, BlowsToWhereItIsTold) {
  for (const double towards : {0.0, 45.0, 180.0, -90.0}) {
    Wind wind({.mean_mps = 5, .towards_deg = towards, .gust_mps = 0}, core::Rng(1));
    const Eigen::Vector3d v = wind.step(0.01);
    EXPECT_NEAR(v.norm(), 5, 1e-12);
    EXPECT_NEAR(std::remainder(std::atan2(v.y(), v.x()) - towards * M_PI / 180, 2 * M_PI), 0, 1e-9);
    EXPECT_EQ(v.z(), 0);
  }
}

TEST(Wind, TheSameSeedGivesTheSameWindAndAnotherAnother) {
  Wind a({}, core::Rng(3)), b({}, core::Rng(3)), c({}, core::Rng(4));
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d v = a.step(0.01);
    EXPECT_EQ(v, b.step(0.01));
    EXPECT_NE(v, c.step(0.01));
  }
}

TEST(Wind, AStepOfNoTimeChangesNothing) {
  Wind wind({}, core::Rng(3));
  const Eigen::Vector3d before = wind.step(1);
  EXPECT_EQ(wind.step(0), before);
}

}  // namespace
}  // namespace saker::simulation
