#include "tools/saker/evaluate/piece_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace saker::tools {

std::string piece_header() {
  return fmt::format("scan,{},crowned,bare,neither\n",
                     fmt::join(segmentation::kPieceFeatures, ","));
}

std::string piece_row(const std::string& scan, const segmentation::Segmentation::SeenPiece& piece,
                      std::span<const std::uint32_t> ids, const SegmentationFigures& figures,
                      const objects::ClassTable& table) {
  int crowned = 0, bare = 0, neither = 0;
  for (const std::int32_t point : piece.points) {
    const std::uint32_t id = ids[static_cast<std::size_t>(point)];
    if (!figures.counts(id)) continue;
    const objects::ObjectClass& c = table[figures.class_of(id)];
    ++(c.shape != objects::Shape::cylinder ? neither : c.crowned ? crowned : bare);
  }
  return fmt::format("{},{},{},{},{}\n", scan,
                     fmt::join(piece.features.begin(), piece.features.end(), ","), crowned, bare,
                     neither);
}

}  // namespace saker::tools
