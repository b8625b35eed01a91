#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/segmentation/piece_features.h"
#include "saker/segmentation/pieces.h"

namespace saker::segmentation {

/// Lets the pixels of one object decide together what it is. Reads the image and the network's
/// probabilities; changes them where the family's kinds are likely.
///
/// A piece is what hangs together of the pixels that are more likely of the family than of any
/// other class. It is a part of one object: of one of the kinds (trunk or pole; vehicle) or of
/// neither. With the
/// features f of the piece (piece_features.h) and the weights w of the network's description
///
///   P(kind) = exp(w_kind · f) / (Σ exp(w_k · f) + 1),   P(neither) the rest,
///
/// a multinomial logistic regression, fitted to simulated worlds (scripts/segmentation-fit). The
/// pixel's probability of each kind becomes the piece's, and the other classes share P(neither) as
/// the network has it. Frame: lidar. Cost: 1 ms for 64×1024; allocates nothing after the first
/// scans.
class ObjectPieces {
 public:
  using Piece = std::vector<std::int32_t>;  ///< pixels

  /// Without a model the network's probabilities stay.
  ObjectPieces(PieceFamily family, const objects::ClassTable& table,
               const std::optional<PieceModel>& model);

  /// \param up  unit, lidar frame
  void decide(const RangeImage& image, const Eigen::Vector3f& up, PixelProbabilities& pixels);

  /// Calls `take(piece, features)` for every piece that decide() would decide on.
  template <class Take>
  void for_each(const RangeImage& image, const Eigen::Vector3f& up,
                const PixelProbabilities& pixels, const Take& take) {
    if (!all_kinds_) return;
    find_members(image, pixels);
    const auto measured = [&](const Piece& piece) {
      take(piece, meter_.measure(piece, image, up, kinds_, pixels));
    };
    if (family_ == PieceFamily::cylinders)
      pieces_.for_each(image, up, member_, measured);
    else
      plan_pieces_.for_each(image, up, member_, measured);
  }

 private:
  void find_members(const RangeImage& image, const PixelProbabilities& pixels);
  void share(const Piece& piece, const PieceFeatures& features, PixelProbabilities& pixels) const;

  PieceFamily family_;
  std::vector<std::vector<int>> kinds_;  ///< classes of each
  std::vector<int> neither_;
  bool all_kinds_ = false;  ///< the table has each of them, and others
  std::optional<PieceModel> model_;
  Pieces pieces_;
  PlanPieces plan_pieces_;
  PieceMeter meter_;
  std::vector<std::uint8_t> member_;
};

}  // namespace saker::segmentation
