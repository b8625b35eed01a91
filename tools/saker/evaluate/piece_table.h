#pragma once

#include <span>
#include <string>

#include "saker/segmentation/segmentation.h"
#include "tools/saker/evaluate/segmentation_figures.h"

/// Pieces of pixels that may be trunks or poles, as scripts/segmentation-fit reads them. Reads what
/// Segmentation::cylinder_pieces gives and a person's ids; makes CSV: scan, kPieceFeatures, and the
/// pixels by what their label says: crowned, bare (cylinders with and without a crown) or neither.
namespace saker::tools {

[[nodiscard]] std::string piece_header();

/// Ids that `figures` does not count are in no column.
[[nodiscard]] std::string piece_row(const std::string& scan,
                                    const segmentation::Segmentation::SeenPiece& piece,
                                    std::span<const std::uint32_t> ids,
                                    const SegmentationFigures& figures,
                                    const objects::ClassTable& table);

}  // namespace saker::tools
