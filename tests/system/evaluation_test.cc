#include "tools/saker/evaluate/evaluation.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

const objects::ClassTable kTable;

EvaluatedScan scan_with(const std::string& name, std::size_t missed, std::size_t wrong) {
  EvaluatedScan scan{name, {}, {}, {}};
  scan.points[1].resize(missed);
  scan.points[2].resize(wrong);
  return scan;
}

TEST(WorstScans, AreThoseWithTheMostFaultsInTheirOrder) {
  WorstScans worst(2);
  worst.add(scan_with("a", 1, 1));
  worst.add(scan_with("b", 0, 5));
  worst.add(scan_with("c", 3, 0));
  ASSERT_EQ(worst.scans().size(), 2U);
  EXPECT_EQ(worst.scans()[0].name, "b");
  EXPECT_EQ(worst.scans()[1].name, "c");
}

TEST(WorstScans, AScanWithoutAFaultIsNone) {
  WorstScans worst(2);
  worst.add(scan_with("a", 0, 0));
  EXPECT_TRUE(worst.scans().empty());
}

/// Two vehicle points, one of them missed, and one point of the ground that is called vehicle.
TEST(Evaluation, TellsRightMissedAndWrongPointsOfAScanApart) {
  lidar::Scan scan;
  scan.points.assign(3, Eigen::Vector3f(5, 0, 0));
  const std::vector<std::uint32_t> ids = {10, 10, 40};
  Evaluation evaluation(kTable);
  evaluation.add("000001", scan, {{1, 0, 1}, {1, 1, 1}}, &ids, nullptr, {}, 20);
  const auto figures = evaluation.json();
  EXPECT_EQ(figures["worst"][0]["right_points"], 1);
  EXPECT_EQ(figures["worst"][0]["missed_points"], 1);
  EXPECT_EQ(figures["worst"][0]["wrong_points"], 1);
  EXPECT_EQ(figures["ms_a_scan"]["median"], 20);
  EXPECT_FALSE(figures.contains("boxes"));
}

TEST(Evaluation, JudgesByBoxesWhereThereAreNoLabels) {
  lidar::Scan scan;
  scan.points.assign(50, Eigen::Vector3f(5, 0, 0));
  scan.points.emplace_back(5.F, 9.F, 0.F);
  lidar::Labels labels{std::vector<std::uint8_t>(51, 0), std::vector<float>(51, 1)};
  labels.classes.back() = 1;
  const std::vector<LabelledBox> boxes = {{"car", "", {5, 0, 0}, {4, 2, 1.5}, 0}};
  Evaluation evaluation(kTable);
  evaluation.add("000001", scan, labels, nullptr, &boxes, {}, 20);
  EXPECT_EQ(evaluation.json()["worst"][0]["missed_points"], 50);
  EXPECT_EQ(evaluation.json()["worst"][0]["wrong_points"], 1);
  EXPECT_EQ(evaluation.worst().front().box_verdicts.front(), BoxJudgement::Of::missed);
}

}  // namespace
}  // namespace saker::tools
