#include "flight/run_files/detections_file.h"

#include <gtest/gtest.h>

namespace saker::flight {
namespace {

objects::Measurement car_whose_front_is_told_by(double front_log_odds) {
  objects::Measurement measurement;
  measurement.class_id = 1;
  measurement.class_probability = {0.05, 0.95};
  measurement.model = objects::Cuboid{SE3::Identity(), {4.4, 1.8, 1.5}};
  measurement.covariance = Eigen::MatrixXd::Identity(9, 9);
  measurement.front_log_odds = front_log_odds;
  return measurement;
}

TEST(DetectionsFile, SaysWhichEndIsTheFrontWhereOneLooksMoreLikeIt) {
  EXPECT_EQ(measurement_json(car_whose_front_is_told_by(-2), {}).at("front_log_odds"), -2);
  EXPECT_FALSE(measurement_json(car_whose_front_is_told_by(0), {}).contains("front_log_odds"));
}

}  // namespace
}  // namespace saker::flight
