#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "made_model.h"
#include "saker/autonomy/fitted_noise.h"
#include "saker/core/rng.h"
#include "saker/core/statistics.h"

/// A map whose measurements err as the fitted model says knows how good it is.
namespace saker::autonomy {
namespace {

using namespace made;
using objects::Cuboid;

constexpr int kCars = 60;
constexpr int kViews = 10;   // around each
constexpr int kWindows = 5;  // from each view

slam::SlamConfig config() {
  slam::SlamConfig config;
  config.measurement_noise = slam::NoiseSource::fitted;
  return config;
}

Eigen::VectorXd sample(core::Rng& rng, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd unit(covariance.rows());
  for (double& value : unit) value = rng.normal(0, 1);
  return covariance.llt().matrixL() * unit;
}

/// The lidar `k` views on its way around a car at the origin, looking at it.
SE3 lidar_pose(int k, double range) {
  const double a = 2 * std::numbers::pi * k / kViews + 0.1;
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp({0, 0, a + std::numbers::pi});
  T.translation() = Eigen::Vector3d(range * std::cos(a), range * std::sin(a), 3);
  return T;
}

/// Of length and width.
struct Outcome {
  Eigen::Vector2d error;
  double nees;  ///< a degree of freedom; NaN: the car is not in the map
};

/// Flies around one car. What its measurements have in common and what those of a cell share is
/// drawn once.
class Round {
 public:
  Round(core::Rng& rng, const uncertainty::Model& model) : rng_(rng), model_(model) {
    common_ = sample(rng, model.common_covariance(kVehicle));
    truth_.pose.translation().z() = 0.75;
    truth_.size = {rng.uniform(3.8, 5.2), rng.uniform(1.6, 2.0), 1.5};
  }

  Outcome fly(const FittedNoise& noise, slam::Slam& slam) {
    const double range = rng_.uniform(4, 11);
    double seconds = 0;
    const SE3 T_odom_world = lidar_pose(0, range).inverse();
    for (int k = 0; k < kViews; ++k) {
      const SE3 T_world_lidar = lidar_pose(k, range);
      for (int w = 0; w < kWindows; ++w) {
        slam::SlamInput input;
        input.stamp = from_seconds(seconds += 0.5);
        input.T_odom_lidar = T_odom_world * T_world_lidar;
        input.odometry_covariance = 1e-8 * Matrix6d::Identity();
        input.detections.measurements = {measured(T_world_lidar, input.stamp)};
        input.detections = noise.applied(input.detections, input.T_odom_lidar.linear());
        (void)slam.update(input, core::Budget::iterations(4));
      }
    }
    objects::ObjectMap map = slam.map_with_covariance().map;
    noise.add_common(map);
    if (map.objects.size() != 1) return {Eigen::Vector2d::Constant(NAN), NAN};
    const objects::MapObject& found = map.objects[0];
    const Eigen::Vector2d error =
        (std::get<Cuboid>(found.model).size - truth_.size).head<2>().eval();
    const Eigen::Matrix2d P = found.covariance.block<2, 2>(6, 6);
    return {error, error.dot(P.inverse() * error) / 2};
  }

 private:
  objects::Measurement measured(const SE3& T_world_lidar, Time stamp) {
    const auto view = uncertainty::view_of(T_world_lidar.translation(), truth_);
    const auto fitted = model_.predict(kVehicle, view);
    if (!of_cell_.contains(fitted.cell)) of_cell_[fitted.cell] = sample(rng_, fitted.covariance);
    const Eigen::VectorXd error = fitted.bias + common_ + of_cell_[fitted.cell];
    Cuboid cuboid = truth_;
    cuboid.pose.translation() += Eigen::Vector3d(error[0], error[1], 0);
    cuboid.size.head<2>() += error.tail<2>();
    objects::Measurement m;
    m.stamp = stamp;
    m.class_id = kVehicle;
    m.class_probability = {0.02, 0.92, 0.02, 0.02, 0.02};
    m.model = objects::transformed(T_world_lidar.inverse(), objects::Model(cuboid));
    m.covariance = (Vector9d() << 1e-4, 1e-4, 1e-3, 0.04, 0.04, 1e-3, 0.02, 0.04, 1e-3)
                       .finished()
                       .asDiagonal();  // the length stated as well as in the fit
    m.front_log_odds = 2;
    m.points = 200;
    return m;
  }

  core::Rng& rng_;
  const uncertainty::Model& model_;
  Eigen::VectorXd common_;
  std::map<int, Eigen::VectorXd> of_cell_;
  Cuboid truth_;
};

TEST(HonestMap, SizesErrAsMuchAsTheirCovarianceSays) {
  core::Rng rng(3);
  const auto fitted = model();
  const FittedNoise noise(config(), fitted);
  std::vector<double> nees, length, width;
  for (int i = 0; i < kCars; ++i) {
    slam::Slam slam(config(), {});
    const Outcome outcome = Round(rng, *fitted).fly(noise, slam);
    nees.push_back(outcome.nees);
    length.push_back(outcome.error.x());
    width.push_back(outcome.error.y());
  }
  EXPECT_GT(core::mean(nees), 0.7);
  EXPECT_LT(core::mean(nees), 1.4);
  EXPECT_NEAR(core::mean(length), 0, 0.05) << "the bias of 0.25 m and more is taken off";
  EXPECT_NEAR(core::mean(width), 0, 0.03);
}

}  // namespace
}  // namespace saker::autonomy
