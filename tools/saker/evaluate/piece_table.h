#pragma once

#include <span>
#include <string>

#include "saker/segmentation/segmentation.h"
#include "tools/saker/evaluate/segmentation_figures.h"

/// Pieces of pixels that may be one object, as scripts/segmentation-fit reads them, a table a
/// family. Reads what Segmentation::pieces gives and a person's ids; makes CSV: scan, the family's
/// features, and the pixels by what their label says: the family's kinds or neither.
namespace saker::tools {

[[nodiscard]] std::string piece_header(segmentation::PieceFamily family);

/// Ids that `figures` does not count are in no column.
[[nodiscard]] std::string piece_row(const std::string& scan,
                                    const segmentation::Segmentation::SeenPiece& piece,
                                    std::span<const std::uint32_t> ids,
                                    const SegmentationFigures& figures,
                                    const objects::ClassTable& table);

}  // namespace saker::tools
