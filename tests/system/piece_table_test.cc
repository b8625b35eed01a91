#include "tools/saker/evaluate/piece_table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace saker::tools {
namespace {

const objects::ClassTable kTable;

segmentation::Segmentation::SeenPiece piece_of(segmentation::PieceFamily family) {
  const auto features = static_cast<Eigen::Index>(segmentation::info_of(family).features.size());
  return {family, segmentation::PieceFeatures::Constant(features, 0.5F), {0, 1, 2, 3, 4, 6}};
}

const std::vector<std::uint32_t> kIds = {71, 71, 10, 80, 70, 80, 0};

TEST(PieceTable, ARowHasTheScanItsFeaturesAndThePixelsByLabel) {
  const SegmentationFigures figures(kTable);
  EXPECT_EQ(
      piece_row("000007", piece_of(segmentation::PieceFamily::cylinders), kIds, figures, kTable),
      "000007,0.5,0.5,0.5,0.5,0.5,0.5,0.5,2,1,2\n");
  EXPECT_EQ(
      piece_row("000007", piece_of(segmentation::PieceFamily::vehicles), kIds, figures, kTable),
      "000007,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,1,4\n");
}

TEST(PieceTable, TheHeaderNamesEveryColumn) {
  for (const segmentation::PieceFamily family : segmentation::kPieceFamilies) {
    const segmentation::PieceFamilyInfo& info = segmentation::info_of(family);
    const std::string header = piece_header(family);
    EXPECT_EQ(header.substr(0, 9), "scan,one,");
    EXPECT_EQ(std::count(header.begin(), header.end(), ','),
              info.features.size() + info.kinds.size() + 1);
  }
}

}  // namespace
}  // namespace saker::tools
