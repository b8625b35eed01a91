#include "tools/saker/evaluate/segmentation_figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::tools {
namespace {

// Of the default table: 0 other, 1 vehicle, 2 trunk, 3 pole, 4 ground.
const objects::ClassTable kTable;

SegmentationFigures figures_of(const std::vector<std::uint8_t>& predicted,
                               const std::vector<std::uint32_t>& ids, float probability = 1) {
  SegmentationFigures figures(kTable);
  const lidar::Labels labels{predicted, std::vector<float>(predicted.size(), probability)};
  figures.add(labels, ids);
  return figures;
}

TEST(SegmentationFigures, IntersectionOverUnionIsThatOfTheCountedPoints) {
  // Three right, one missed, two wrong: 3 / (4 + 5 - 3).
  const auto figures = figures_of({1, 1, 1, 0, 1, 1}, {10, 10, 10, 10, 40, 70});
  EXPECT_DOUBLE_EQ(figures.classes()[1].iou(), 0.5);
  EXPECT_DOUBLE_EQ(figures.classes()[1].precision(), 0.6);
  EXPECT_DOUBLE_EQ(figures.classes()[1].recall(), 0.75);
}

TEST(SegmentationFigures, IdsThatMeanNothingDoNotCount) {
  const auto figures = figures_of({1, 1, 1, 1, 1, 1}, {0, 1, 52, 81, 99, 10});
  EXPECT_EQ(figures.classes()[1].predicted, 1);
}

TEST(SegmentationFigures, AnIdThatAClassMergesCounts) {
  objects::ClassTable table;
  objects::ObjectClass& sign = table.classes.emplace_back();
  sign.name = "sign";
  sign.shape = objects::Shape::cylinder;
  sign.label_ids = {81};
  SegmentationFigures figures(table);
  figures.add({{5}, {1.0F}}, std::vector<std::uint32_t>{81});
  EXPECT_DOUBLE_EQ(figures.classes()[5].iou(), 1);
}

TEST(SegmentationFigures, InstancesInTheUpperBitsAreOneClass) {
  EXPECT_EQ(figures_of({1, 1}, {10U | 7U << 16, 10U | 8U << 16}).classes()[1].both, 2);
}

TEST(SegmentationFigures, RecallIsToldForEachIdOfAClass) {
  const auto figures = figures_of({1, 1, 1, 0, 0}, {10, 10, 18, 18, 18});
  EXPECT_EQ(figures.labels().at(10).right, 2);
  EXPECT_EQ(figures.labels().at(18).right, 1);
  EXPECT_EQ(figures.labels().at(18).points, 3);
}

TEST(SegmentationFigures, AClassThatNobodyLabelledHasNoFigure) {
  EXPECT_TRUE(std::isnan(figures_of({3, 1}, {10, 10}).classes()[3].iou()));
}

TEST(SegmentationFigures, CalibrationErrorIsTheDistanceOfTheRightShareFromTheProbability) {
  // One of four is right, and all say 0.75.
  EXPECT_NEAR(figures_of({1, 1, 1, 1}, {10, 40, 40, 40}, 0.75F).expected_calibration_error(), 0.5,
              1e-6);
}

TEST(SegmentationFigures, BinsAreWeightedByTheirPoints) {
  SegmentationFigures figures(kTable);
  figures.add({{1, 1, 1}, {1, 1, 1}}, std::vector<std::uint32_t>{10, 10, 10});  // no error
  figures.add({{1}, {0.5F}}, std::vector<std::uint32_t>{10});                   // 0.5 too modest
  EXPECT_NEAR(figures.expected_calibration_error(), 0.125, 1e-6);
}

}  // namespace
}  // namespace saker::tools
