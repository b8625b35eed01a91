#include "tools/saker/evaluate/piece_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace saker::tools {

std::string piece_header(segmentation::PieceFamily family) {
  const segmentation::PieceFamilyInfo& info = segmentation::info_of(family);
  return fmt::format("scan,{},{},neither\n", fmt::join(info.features, ","),
                     fmt::join(info.kinds, ","));
}

std::string piece_row(const std::string& scan, const segmentation::Segmentation::SeenPiece& piece,
                      std::span<const std::uint32_t> ids, const SegmentationFigures& figures,
                      const objects::ClassTable& table) {
  std::vector<int> pixels(segmentation::info_of(piece.family).kinds.size() + 1);
  for (const std::int32_t point : piece.points) {
    const std::uint32_t id = ids[static_cast<std::size_t>(point)];
    if (!figures.counts(id)) continue;
    const int kind = segmentation::kind_of(piece.family, table[figures.class_of(id)]);
    ++(kind < 0 ? pixels.back() : pixels[static_cast<std::size_t>(kind)]);
  }
  return fmt::format("{},{},{}\n", scan,
                     fmt::join(piece.features.begin(), piece.features.end(), ","),
                     fmt::join(pixels, ","));
}

}  // namespace saker::tools
