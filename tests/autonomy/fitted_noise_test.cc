#include "saker/autonomy/fitted_noise.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_model.h"
#include "saker/autonomy/lockstep.h"
#include "saker/core/error.h"
#include "saker/objects/view_cell.h"
#include "saker/slam/model_algebra.h"
#include "saker/uncertainty/fit.h"

namespace saker::autonomy {
namespace {

using namespace made;
using objects::Cuboid;
using objects::Cylinder;
using objects::Measurement;

slam::SlamConfig source(slam::NoiseSource noise) {
  slam::SlamConfig config;
  config.measurement_noise = noise;
  return config;
}

const FittedNoise& fitted() {
  static const FittedNoise noise(source(slam::NoiseSource::fitted), model());
  return noise;
}

SE3 flat_pose(double x, double y, double z, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp({0, 0, yaw});
  T.translation() = Eigen::Vector3d(x, y, z);
  return T;
}

/// What a window states of its ends, m.
void state_ends(Measurement& m, double rear_sd, double front_sd) {
  const double rear = rear_sd * rear_sd, front = front_sd * front_sd;
  m.covariance(3, 3) = (front + rear) / 4;
  m.covariance(6, 6) = front + rear;
  m.covariance(3, 6) = m.covariance(6, 3) = (front - rear) / 2;
}

/// A car ahead of the lidar, turned by `yaw`.
Measurement car(double range, double yaw) {
  Measurement m;
  m.class_id = kVehicle;
  m.model = Cuboid{flat_pose(range, 0, -2, yaw), {4.5, 1.8, 1.5}};
  m.covariance = Vector9d::LinSpaced(0.01, 0.09).asDiagonal();
  m.covariance(5, 8) = m.covariance(8, 5) = 0.02;
  state_ends(m, 0.02, 0.02);         // both were looked at
  m.covariance(7, 7) = 0.09 * 0.09;  // both sides were seen
  m.front_log_odds = 2;
  return m;
}

Measurement trunk(const Eigen::Vector3d& root) {
  Measurement m;
  m.class_id = kTrunk;
  m.model = Cylinder{root, Eigen::Vector3d::UnitZ(), 0.15, 3};
  m.covariance = Vector6d::LinSpaced(0.01, 0.06).asDiagonal();
  m.covariance(0, 3) = m.covariance(3, 0) = 0.005;
  return m;
}

Measurement applied(const Measurement& m, const Eigen::Matrix3d& R_odom_lidar,
                    const FittedNoise& noise = fitted()) {
  objects::Detections detections;
  detections.measurements = {m};
  return noise.applied(detections, R_odom_lidar).measurements.front();
}

Measurement applied(const Measurement& m) { return applied(m, Eigen::Matrix3d::Identity()); }

objects::MapObject mapped(const Measurement& m) {
  objects::MapObject object;
  object.class_id = m.class_id;
  object.model = m.model;
  object.covariance = m.covariance;
  return object;
}

void expect_untouched(const Measurement& m, const FittedNoise& noise, int cell = -1) {
  const Measurement after = applied(m, Eigen::Matrix3d::Identity(), noise);
  EXPECT_EQ(after.view_cell, cell);
  EXPECT_EQ(after.covariance, m.covariance);
  EXPECT_EQ(objects::place(after.model), objects::place(m.model));
}

uncertainty::Prediction expected(objects::ClassId id, double range, double angle) {
  uncertainty::View view;
  view.range = range;
  view.angle = angle;
  return model()->predict(id, view);
}

TEST(FittedNoise, TakesTheBiasOffAVehicle) {
  const Measurement m = car(8, 0.3);
  const auto fit = expected(kVehicle, 8, std::numbers::pi - 0.3);
  const auto& before = std::get<Cuboid>(m.model);
  const auto after = std::get<Cuboid>(applied(m).model);
  const Eigen::Vector3d step = before.pose.inverse() * after.pose.translation();
  EXPECT_NEAR(step.x(), -fit.bias[0], 1e-9);
  EXPECT_NEAR(step.y(), -fit.bias[1], 1e-9);
  EXPECT_NEAR(step.z(), 0, 1e-9);
  EXPECT_NEAR(after.size.x(), 4.5 - fit.bias[2], 1e-9);
  EXPECT_NEAR(after.size.y(), 1.8 - fit.bias[3], 1e-9);
  EXPECT_EQ(after.size.z(), 1.5);
  EXPECT_GT(fit.bias.cwiseAbs().minCoeff(), 0.01);
}

TEST(FittedNoise, ReplacesTheCovarianceOfPlaceAndSizeAndLeavesTheRest) {
  const Measurement m = car(8, 0.3);
  const auto fit = expected(kVehicle, 8, std::numbers::pi - 0.3);
  const Eigen::MatrixXd P = applied(m).covariance;
  const std::vector<int> plan = objects::planar_rows(m.model), rest = {0, 1, 2, 5, 8};
  EXPECT_TRUE(P(plan, plan).isApprox(fit.covariance, 1e-9));
  EXPECT_EQ(Eigen::MatrixXd(P(rest, rest)), Eigen::MatrixXd(m.covariance(rest, rest)));
  EXPECT_EQ(P(plan, rest).norm(), 0);
  EXPECT_EQ(applied(m).view_cell, objects::corrected_cell(fit.cell));
  EXPECT_NEAR(applied(m).length_sd, std::sqrt(m.covariance(6, 6)), 1e-12);
  EXPECT_GE(fit.cell, 0);
}

TEST(FittedNoise, AnEndThatIsStatedBadlyIsNoBetterKnownThanThatByItsSquareTheOtherIsAsTheFitSays) {
  slam::SlamConfig config = source(slam::NoiseSource::fitted);
  config.noise.fitted_end_sd_m = 0.2;
  Measurement m = car(8, 0.3);
  state_ends(m, 0.02, 0.24);
  const Measurement after = applied(m, Eigen::Matrix3d::Identity(), FittedNoise(config, model()));
  const Eigen::Vector2d ends = slam::end_variances(after.covariance, 0);
  const Eigen::Vector2d known = slam::end_variances(applied(car(8, 0.3)).covariance, 0);
  EXPECT_NEAR(std::sqrt(ends[1]), 0.24 * 0.24 / 0.2, 1e-9);
  EXPECT_NEAR(ends[0], known[0], 1e-9);
  EXPECT_NEAR(after.length_sd, std::hypot(0.02, 0.24), 1e-12);
}

TEST(FittedNoise, AHiddenSideIsKnownAsBadlyAsTheWindowStatesTheNearOneAsTheFitSays) {
  const double hidden = 0.4;              // more than the limit
  for (const double yaw : {1.2, -1.2}) {  // the lidar is to the right, then to the left
    Measurement m = car(8, yaw);
    m.covariance(7, 7) = hidden * hidden;
    const Eigen::MatrixXd P = applied(m).covariance;
    const std::vector<int> plan = objects::planar_rows(m.model);
    const Eigen::Matrix4d known = expected(kVehicle, 8, std::numbers::pi - 1.2).covariance;
    const double near = yaw > 0 ? 1 : -1;
    const Eigen::Vector4d near_side(0, near, 0, 0.5), far_side(0, -near, 0, 0.5);
    const Eigen::Matrix4d after = P(plan, plan);
    EXPECT_NEAR(near_side.dot(after * near_side), near_side.dot(known * near_side), 1e-9);
    EXPECT_NEAR(far_side.dot(after * far_side) - far_side.dot(known * far_side), hidden * hidden,
                1e-9);
  }
}

TEST(FittedNoise, AVehicleMeasuredBackToFrontIsTheSame) {
  Measurement m = car(8, 0.3 + std::numbers::pi);
  m.front_log_odds = -2;
  const Measurement a = applied(car(8, 0.3)), b = applied(m);
  EXPECT_TRUE(std::get<Cuboid>(a.model).pose.isApprox(std::get<Cuboid>(b.model).pose, 1e-9));
  EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-9));
  EXPECT_EQ(a.view_cell, b.view_cell);
  EXPECT_EQ(b.front_log_odds, 2);
}

TEST(FittedNoise, ATrunkIsPulledAlongTheLevelLineOfSight) {
  // The lidar rolls and pitches; in odom the trunk stands 3 m ahead, 4 m to the left, 2 m below.
  const Eigen::Matrix3d R_odom_lidar = core::so3_exp({0.2, -0.1, 0.5});
  const Eigen::Vector3d in_odom(3, 4, -2);
  const Measurement after = applied(trunk(R_odom_lidar.transpose() * in_odom), R_odom_lidar);
  const auto fit = expected(kTrunk, 5, 0);
  const Eigen::Vector3d along(0.6, 0.8, 0), left(-0.8, 0.6, 0);
  const Eigen::Vector3d step = R_odom_lidar * objects::place(after.model) - in_odom;
  EXPECT_NEAR(step.dot(along), -fit.bias[0], 1e-9);
  EXPECT_NEAR(step.dot(left), -fit.bias[1], 1e-9);
  EXPECT_NEAR(step.z(), 0, 1e-9);
  const Eigen::Matrix3d P =
      R_odom_lidar * after.covariance.topLeftCorner<3, 3>() * R_odom_lidar.transpose();
  EXPECT_NEAR(along.dot(P * along), fit.covariance(0, 0), 1e-9);
  EXPECT_NEAR(left.dot(P * left), fit.covariance(1, 1), 1e-9);
  EXPECT_NEAR(after.covariance(5, 5), 0.06, 1e-12) << "the radius is as detection says";
}

TEST(FittedNoise, LeavesWhatWasNotFlownAsItIsButCountsItsCellOnce) {
  const double angle = std::numbers::pi - 0.3;
  expect_untouched(car(30, 0.3), fitted(),
                   objects::uncorrected_cell(expected(kVehicle, 30, angle).cell));
  expect_untouched(trunk({25, 0, -2}), fitted(),
                   objects::uncorrected_cell(expected(kTrunk, 25, 0).cell));
}

TEST(FittedNoise, LeavesAVehicleWithAHiddenEndAsItIsBesideTheWholeOnesOfItsCell) {
  Measurement m = car(8, 0.3);
  m.length_sd = 0.7;
  expect_untouched(m, fitted(), applied(car(8, 0.3)).view_cell + 1);
}

TEST(FittedNoise, LeavesAloneAClassThatTheModelDoesNotKnow) {
  Measurement pole = trunk({5, 0, -2});
  pole.class_id = kPole;
  expect_untouched(pole, fitted());
}

TEST(FittedNoise, LeavesAloneWhatWouldHaveNoSizeLeft) {
  Measurement m = car(8, 0);
  std::get<Cuboid>(m.model).size.y() = 0.05;
  expect_untouched(m, fitted(),
                   objects::uncorrected_cell(expected(kVehicle, 8, std::numbers::pi).cell));
}

TEST(FittedNoise, FixedNoiseChangesNoMeasurementAndAddsWhatIsConfigured) {
  const FittedNoise fixed(source(slam::NoiseSource::fixed), model());
  expect_untouched(car(8, 0.3), fixed);
  objects::ObjectMap map;
  map.objects = {mapped(car(8, 0)), mapped(trunk({5, 0, -2}))};
  const objects::ObjectMap before = map;
  fixed.add_common(map);
  const slam::MeasurementNoiseConfig config;
  const Eigen::MatrixXd of_car = map.objects[0].covariance - before.objects[0].covariance;
  EXPECT_NEAR(of_car(4, 4), config.common_place_m * config.common_place_m, 1e-12);
  EXPECT_NEAR(of_car(6, 6), config.common_length_m * config.common_length_m, 1e-12);
  EXPECT_NEAR(of_car(7, 7), config.common_width_m * config.common_width_m, 1e-12);
  const Eigen::MatrixXd of_trunk = map.objects[1].covariance - before.objects[1].covariance;
  const double radius = std::get<objects::Cylinder>(before.objects[1].model).radius;
  const double root = config.common_root * radius, taper = config.common_taper * radius;
  EXPECT_NEAR(of_trunk(0, 0), root * root, 1e-12);
  EXPECT_NEAR(of_trunk(5, 5), config.common_radius_m * config.common_radius_m + taper * taper,
              1e-12);
  EXPECT_EQ(of_trunk(3, 3), 0);
}

TEST(FittedNoise, ReportedCovarianceIsTheGraphsAndTheCommonPart) {
  objects::ObjectMap map;
  map.objects = {mapped(car(8, 0.3)), mapped(trunk({5, 0, -2})), mapped(car(3, 0))};
  map.objects[2].covariance.resize(0, 0);
  const objects::ObjectMap before = map;
  fitted().add_common(map);
  const Eigen::MatrixXd of_car = map.objects[0].covariance - before.objects[0].covariance;
  EXPECT_NEAR(of_car(3, 3), 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(of_car(6, 6), 0.12 * 0.12, 1e-12);
  EXPECT_NEAR(of_car(7, 7), 0.05 * 0.05, 1e-12);
  EXPECT_EQ(of_car(8, 8), 0);
  const Eigen::MatrixXd of_trunk = map.objects[1].covariance - before.objects[1].covariance;
  const double of_root = slam::MeasurementNoiseConfig().common_root *
                         std::get<objects::Cylinder>(before.objects[1].model).radius;
  EXPECT_NEAR(of_trunk(0, 0), of_root * of_root, 1e-12);
  EXPECT_NEAR(of_trunk(1, 1), of_trunk(0, 0), 1e-12);
  EXPECT_EQ(of_trunk(2, 2), 0);
  EXPECT_GT(of_trunk(5, 5), 0) << "of the radius the model knows nothing";
  EXPECT_EQ(map.objects[2].covariance.size(), 0);
}

TEST(UncertaintyFor, WithFixedNoiseViewsAreWorthWhatTheirBiasLeaves) {
  Config config;
  config.active.policy = active::PolicyName::paper;
  config.uncertainty.model = "models/uncertainty-replica.yaml";
  const uncertainty::View behind{8, std::numbers::pi, NAN, NAN};
  const auto predicted = [&](slam::NoiseSource noise) {
    config.slam.measurement_noise = noise;
    return uncertainty_for(config)->predict(kVehicle, behind);
  };
  const uncertainty::Prediction fitted = predicted(slam::NoiseSource::fitted);
  const uncertainty::Prediction fixed = predicted(slam::NoiseSource::fixed);
  ASSERT_LT(fitted.bias[2], -0.05) << "from behind lengths are too short";
  EXPECT_NEAR(fixed.covariance(2, 2), fitted.covariance(2, 2) + std::pow(fitted.bias[2], 2), 1e-9);
}

TEST(UncertaintyFor, ThePapersEstimatorSeesLengthsBestFromObliquelyInFrontWorstFromBehind) {
  Config config;
  config.active.policy = active::PolicyName::paper;
  config.uncertainty.model = "models/uncertainty-replica.yaml";
  const auto model = uncertainty_for(config);
  const auto length_sd = [&](double angle_deg) {
    const uncertainty::View view{13, angle_deg * std::numbers::pi / 180, NAN, NAN};
    return std::sqrt(model->predict(kVehicle, view).covariance(2, 2));
  };
  EXPECT_LT(2 * length_sd(45), length_sd(165));
  EXPECT_LT(length_sd(45), length_sd(15));
}

TEST(SensorNote, SaysWhereTheModelIsOfAnotherSensor) {
  uncertainty::Provenance provenance;
  provenance.sensor = "OS1-64 512x10";
  EXPECT_EQ(sensor_note(provenance, "OS1-64 512x10"), "");
  const std::string mode = sensor_note(provenance, "OS1-64 1024x10");
  EXPECT_NE(mode.find("another mode of the same"), std::string::npos) << mode;
  const std::string model = sensor_note(provenance, "OS2-128 512x10");
  EXPECT_NE(model.find("fitted to OS1-64 512x10, not to this OS2-128 512x10: used"),
            std::string::npos)
      << model;
  EXPECT_NE(sensor_note(provenance, "").find("unknown sensor"), std::string::npos);
}

TEST(SensorNote, IsOfFittedNoiseAlone) {
  Config config;
  EXPECT_EQ(noise_note(config, "OS1-64 512x10"), "");
  EXPECT_NE(noise_note(config, "OS2-128 512x10"), "");
  config.slam.measurement_noise = slam::NoiseSource::fixed;
  EXPECT_EQ(noise_note(config, "OS2-128 512x10"), "");
}

TEST(FittedNoise, NeedsAModel) {
  EXPECT_THROW(FittedNoise(source(slam::NoiseSource::fitted), nullptr), Error);
  Config config;
  config.slam.measurement_noise = slam::NoiseSource::fitted;
  config.uncertainty.model = "models/none.yaml";
  core::Timings timings;
  try {
    Lockstep lockstep(config, 1, timings);
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("uncertainty.model: no such file"), std::string::npos) << text;
    EXPECT_NE(text.find("models/none.yaml"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace saker::autonomy
