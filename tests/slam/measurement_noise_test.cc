#include "saker/slam/measurement_noise.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_world.h"

namespace saker::slam {
namespace {

using namespace made;

const MeasurementNoiseConfig kNone{.covariance_scale = 1, .lean_deg = 0, .roof_m = 0};

Gaussian measured(const Model& model) {
  const Eigen::Index size = is_cuboid(model) ? 9 : 6;
  return {model, 1e-4 * Eigen::MatrixXd::Identity(size, size)};
}

TEST(MeasurementNoise, NothingIsAddedWhereNothingIsConfigured) {
  for (const Model& model : {Model{car(5, 0, 0.3)}, Model{trunk(4, 1)}}) {
    EXPECT_EQ(with_common_errors(measured(model), kNone).covariance, measured(model).covariance);
  }
}

TEST(MeasurementNoise, AnAxisTurnsAboutTheMiddleOfWhatWasSeen) {
  MeasurementNoiseConfig config = kNone;
  config.lean_deg = 5;
  Cylinder pole = trunk(6, -2);
  pole.axis = Eigen::Vector3d(0.1, -0.05, 1).normalized();
  const Eigen::MatrixXd P = with_common_errors(measured(pole), config).covariance;
  // The point at `height` along the axis moves by the root's step and that of the axis.
  const auto variance_at = [&](double height) {
    Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
    J.leftCols<3>().setIdentity();
    J.middleCols<2>(3) = height * objects::tangent_basis(pole.axis);
    return (J * (P - measured(pole).covariance) * J.transpose()).trace();
  };
  EXPECT_NEAR(variance_at(pole.height / 2), 0, 1e-12);
  const double lean = 5 * std::numbers::pi / 180;
  EXPECT_NEAR(variance_at(0), 2 * std::pow(lean * pole.height / 2, 2), 1e-12);
  EXPECT_NEAR(variance_at(pole.height), variance_at(0), 1e-12);
}

TEST(MeasurementNoise, AVehiclesBottomIsAsSureAsItWas) {
  MeasurementNoiseConfig config = kNone;
  config.roof_m = 0.3;
  const Eigen::MatrixXd P = with_common_errors(measured(car(8, 1, 0)), config).covariance;
  const Eigen::MatrixXd before = measured(car(8, 1, 0)).covariance;
  const auto height_variance = [](const Eigen::MatrixXd& C, double share) {
    return C(5, 5) + 2 * share * C(5, 8) + share * share * C(8, 8);
  };
  EXPECT_NEAR(height_variance(P, -0.5), height_variance(before, -0.5), 1e-12);
  EXPECT_NEAR(height_variance(P, 0.5), height_variance(before, 0.5) + 0.09, 1e-12);
}

TEST(MeasurementNoise, AFittedCovarianceOfTheRootStaysAsItIs) {
  const Gaussian pole = measured(trunk(6, -2));
  const MeasurementNoiseConfig config{.covariance_scale = 2, .lean_deg = 5, .roof_m = 0};
  const Eigen::MatrixXd P = with_common_errors(pole, config, true).covariance;
  EXPECT_EQ((P.topLeftCorner<3, 3>()), (pole.covariance.topLeftCorner<3, 3>()));
  const double lean = 5 * std::numbers::pi / 180;
  EXPECT_NEAR(P(3, 3), pole.covariance(3, 3) + lean * lean, 1e-12);
}

/// Windows that share one error say as much as one of them: the mean of n windows in groups of k
/// has k times the variance that n windows of their own would have.
TEST(MeasurementNoise, AMapIsWidenedByTheWindowsThatCountForOneAndKeepsItsCorrelations) {
  const MeasurementNoiseConfig config{.shared_place = 9,
                                      .shared_length = 4,
                                      .shared_width = 1,
                                      .shared_root = 16,
                                      .shared_radius = 25};
  core::Rng rng(3);
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(9, 9, [&] { return rng.normal(0, 1); });
  const Eigen::MatrixXd P = root * root.transpose();
  const Eigen::MatrixXd wide = widened(car(5, 0, 0.3), P, config);
  const Vector9d factors = (Vector9d() << 1, 1, 1, 9, 9, 1, 4, 1, 1).finished();
  EXPECT_TRUE(wide.diagonal().isApprox(P.diagonal().cwiseProduct(factors)));
  EXPECT_NEAR(wide(3, 6) / std::sqrt(wide(3, 3) * wide(6, 6)),
              P(3, 6) / std::sqrt(P(3, 3) * P(6, 6)), 1e-12);
  EXPECT_EQ(wide.llt().info(), Eigen::Success);

  const Eigen::MatrixXd six = P.topLeftCorner<6, 6>();
  const Eigen::VectorXd of_trunk = widened(trunk(4, 1), six, config).diagonal();
  EXPECT_NEAR(of_trunk[0], 16 * six(0, 0), 1e-9);
  EXPECT_NEAR(of_trunk[1], 16 * six(1, 1), 1e-9);
  EXPECT_EQ(of_trunk[2], six(2, 2));
  EXPECT_EQ(of_trunk[3], six(3, 3));
  EXPECT_NEAR(of_trunk[5], 25 * six(5, 5), 1e-9);
}

TEST(MeasurementNoise, AWidthThatNoViewMeasuredIsKnownByItsClass) {
  const double sd = 0.12;
  Eigen::MatrixXd covariance = 1e-3 * Eigen::MatrixXd::Identity(9, 9);
  covariance(7, 7) = 0.3 * 0.3;
  covariance(4, 4) += 0.15 * 0.15;
  covariance(4, 7) = covariance(7, 4) = 0.045;  // one side holds, the other is not known
  Eigen::MatrixXd information = covariance.inverse();
  information(7, 7) += 1 / (sd * sd);
  EXPECT_TRUE(with_class_width(covariance, sd).isApprox(information.inverse(), 1e-9));
}

/// What the flights showed: every trunk seems to lean away from the robot, every vehicle is lower
/// from afar. Neither may bend the path more than odometry does.
TEST(MeasurementNoise, ErrorsThatDependOnTheViewDoNotTurnTheRobot) {
  SlamConfig config = honest_config();
  config.noise = {};
  Slam slam(config, {});
  std::vector<TrueObject> street;
  for (int x = -30; x < 110; x += 7) {
    street.push_back({trunk(x, 5), kTrunk});
    street.push_back({car(x + 3, -5, 0), kVehicle});
  }
  Robot robot(street, {.rotation = 2e-4, .translation = 2e-3}, 1);
  robot.range = 30;
  for (int k = 0; k <= 80; ++k) {
    SlamInput input = robot.step(0.5 * k, flat_pose(k, 0, 3, 0));
    for (Measurement& m : input.detections.measurements) {
      const double distance = objects::place(m.model).head<2>().norm();
      if (auto* cylinder = std::get_if<Cylinder>(&m.model)) {
        const Eigen::Vector3d away =
            cylinder->root.cwiseProduct(Eigen::Vector3d(1, 1, 0)) / distance;
        cylinder->axis = (cylinder->axis + 0.02 * away).normalized();
        m.covariance.block<2, 2>(3, 3) = 3e-5 * Eigen::Matrix2d::Identity();
      } else {
        auto& cuboid = std::get<Cuboid>(m.model);
        cuboid.size.z() -= 0.004 * distance;
        cuboid.pose.translation().z() -= 0.002 * distance;
      }
    }
    (void)slam.update(input, core::Budget::iterations(4));
  }
  const Keyframe& last = slam.keyframes().back();
  const SE3 truth = robot.T_start().inverse() * robot.true_pose();
  const Eigen::Vector3d tilt = core::so3_log(last.T_world_lidar.linear());
  EXPECT_LT(tilt.head<2>().norm(), 0.15 * std::numbers::pi / 180);
  EXPECT_LT(std::abs((last.T_world_lidar.translation() - truth.translation()).z()), 0.1);
}

}  // namespace
}  // namespace saker::slam
