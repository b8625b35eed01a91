#include "saker/uncertainty/sample.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;
const objects::ClassTable kTable;
const objects::ClassId kVehicle = kTable.find("vehicle");
const objects::ClassId kPole = kTable.find("pole");

objects::Cuboid cuboid_of(const Eigen::Vector3d& centre, double heading, double length,
                          double width) {
  objects::Cuboid cuboid;
  cuboid.pose.translation() = centre;
  cuboid.pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).matrix();
  cuboid.size << length, width, 1.5;
  return cuboid;
}

objects::Measurement measurement_of(objects::ClassId id) {
  objects::Measurement measurement;
  measurement.class_id = id;
  measurement.class_probability.assign(static_cast<std::size_t>(kTable.size()), 0.05);
  measurement.class_probability[id] = 0.8;
  measurement.points = 321;
  return measurement;
}

Sample made(objects::ClassId id, const Eigen::VectorXd& error) {
  Sample sample;
  sample.recording = "vehicle_0007";
  sample.object_id = 3;
  sample.kind = "sedan";
  sample.class_id = id;
  sample.time_s = 12.5;
  sample.view = {7.25, -2.0 / 3, 0.3, NAN};
  sample.points = 100;
  sample.confidence = 0.1 + 0.2;
  sample.error = error;
  return sample;
}

class SampleFileTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  void expect_refusal(const std::string& text, const std::string& expected) const {
    core::write_file(file_, text);
    try {
      (void)read_samples(file_, kTable);
      ADD_FAILURE() << "not refused, expected " << expected;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }

  std::filesystem::path file_;
};

TEST(SampleTest, ErrorOfACuboidIsInTheTrueObjectsFrame) {
  const auto truth = cuboid_of({10, 5, 1}, kPi / 2, 4.5, 1.8);
  const auto measured = cuboid_of({9.8, 5.3, 1.1}, kPi / 2 + 0.05, 4.4, 1.95);
  const Sample sample = sample_of(measurement_of(kVehicle), measured, truth, {10, 15, 3});
  ASSERT_EQ(sample.error.size(), 4);
  EXPECT_NEAR(sample.error[0], 0.3, 1e-12);  // +y of the frame is +x of the object
  EXPECT_NEAR(sample.error[1], 0.2, 1e-12);
  EXPECT_NEAR(sample.error[2], -0.1, 1e-12);
  EXPECT_NEAR(sample.error[3], 0.15, 1e-12);
  EXPECT_NEAR(sample.view.angle, 0, 1e-12);
  EXPECT_EQ(sample.confidence, 0.8);
  EXPECT_EQ(sample.points, 321);
}

TEST(SampleTest, TheWayRoundInWhichACuboidWasMeasuredDoesNotMatter) {
  const auto truth = cuboid_of({0, 0, 1}, 0.4, 4.5, 1.8);
  const auto first = cuboid_of({0.1, 0.2, 1}, 0.45, 4.3, 1.9);
  const auto reversed = cuboid_of({0.1, 0.2, 1}, 0.45 + kPi, 4.3, 1.9);
  const auto across = cuboid_of({0.1, 0.2, 1}, 0.45 - kPi / 2, 1.9, 4.3);
  const auto error = [&](const objects::Cuboid& measured) {
    return sample_of(measurement_of(kVehicle), measured, truth, {8, 8, 3}).error;
  };
  EXPECT_TRUE(error(reversed).isApprox(error(first), 1e-12));
  EXPECT_TRUE(error(across).isApprox(error(first), 1e-12));
}

TEST(SampleTest, ErrorOfACylinderIsAlongAndLeftOfTheLineOfSight) {
  objects::Cylinder truth, measured;
  truth.root << 0, 10, 0;
  measured.root << -0.2, 10.3, 0.5;  // farther, and left as seen from the origin
  const Sample sample = sample_of(measurement_of(kPole), measured, truth, {0, 0, 2});
  ASSERT_EQ(sample.error.size(), 2);
  EXPECT_NEAR(sample.error[0], 0.3, 1e-12);
  EXPECT_NEAR(sample.error[1], 0.2, 1e-12);
}

TEST(SampleTest, AVehicleWhoseEndsWereNotSeenIsNotWhole) {
  Sample sample = made(kVehicle, Eigen::Vector4d::Zero());
  sample.length_sd = 0.2;
  EXPECT_TRUE(is_whole(sample, 0.25));
  sample.length_sd = 0.9;
  EXPECT_FALSE(is_whole(sample, 0.25));
  sample.length_sd = NAN;
  EXPECT_TRUE(is_whole(sample, 0.25)) << "nobody said";
}

TEST(SampleTest, TheStatedLengthIsThatOfTheLongerEdgeTheWidthThatOfTheOther) {
  objects::Measurement across = measurement_of(kVehicle);
  across.model = cuboid_of({8, 0, 0}, 0, 1.8, 4.4);
  across.covariance = Matrix9d::Identity();
  across.covariance(7, 7) = 0.09;
  const Sample sample = sample_of(across, across.model, across.model, {0, 0, 2});
  EXPECT_DOUBLE_EQ(sample.length_sd, 0.3);
  EXPECT_DOUBLE_EQ(sample.width_sd, 1);
}

TEST_F(SampleFileTest, WhatIsWrittenIsReadBackToTheLastBit) {
  const std::vector<Sample> samples = {made(kVehicle, Eigen::Vector4d(1.0 / 3, -2, 1e-9, 0.7)),
                                       made(kPole, Eigen::Vector2d(0.01, -0.1))};
  core::write_file(file_, samples_text(samples, kTable));
  const std::vector<Sample> read = read_samples(file_, kTable);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].error, samples[0].error);
  EXPECT_EQ(read[1].error, samples[1].error);
  EXPECT_EQ(read[0].confidence, samples[0].confidence);
  EXPECT_EQ(read[0].view.angle, samples[0].view.angle);
  EXPECT_TRUE(std::isnan(read[0].view.reflectivity));
  EXPECT_EQ(samples_text(read, kTable), samples_text(samples, kTable));
}

TEST_F(SampleFileTest, EachBrokenFileIsRefusedWithFileAndLine) {
  const std::string text = samples_text({made(kVehicle, Eigen::Vector4d::Zero())}, kTable);
  const std::size_t body = text.find('\n') + 1;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from, body), from.size(), to);
  };
  expect_refusal("", "cut");
  expect_refusal(text.substr(0, text.size() - 4), "cut");
  expect_refusal("a,b\n1,2\n", ":1: ");
  expect_refusal(with(",vehicle,", ",ground,"), ":2: class \"ground\", expected");
  expect_refusal(with(",7.25,", ",far,"), ":2: range \"far\", expected a number");
  expect_refusal(with(",7.25,", ",nan,"), ":2: range \"nan\"");
  expect_refusal(with(",7.25,", ","), ":2: 16 fields, expected 17");
  expect_refusal(with(",0.30000000000000004,", ",1.5,"), ":2: confidence \"1.5\"");
}

TEST(SampleTest, ANameThatACsvCannotHoldIsRefused) {
  Sample sample = made(kPole, Eigen::Vector2d::Zero());
  sample.kind = "lamp, old";
  EXPECT_THROW((void)samples_text({sample}, kTable), Error);
}

}  // namespace
}  // namespace saker::uncertainty
