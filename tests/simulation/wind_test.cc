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

}  // namespace
}  // namespace saker::simulation
