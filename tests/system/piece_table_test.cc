#include "tools/saker/evaluate/piece_table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace saker::tools {
namespace {

const objects::ClassTable kTable;

TEST(PieceTable, ARowHasTheScanItsFeaturesAndThePixelsByLabel) {
  segmentation::Segmentation::SeenPiece piece;
  piece.features.setConstant(0.5F);
  piece.points = {0, 1, 2, 3, 4, 6};
  const std::vector<std::uint32_t> ids = {71, 71, 71, 80, 70, 80, 0};
  EXPECT_EQ(piece_row("000007", piece, ids, SegmentationFigures(kTable), kTable),
            "000007,0.5,0.5,0.5,0.5,0.5,0.5,0.5,3,1,1\n");
}

TEST(PieceTable, TheHeaderNamesEveryColumn) {
  const std::string header = piece_header();
  EXPECT_EQ(header.substr(0, 9), "scan,one,");
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), segmentation::kPieceFeatureCount + 3);
}

}  // namespace
}  // namespace saker::tools
