#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/segmentation/piece_features.h"

namespace saker::segmentation {

/// What a model is: the file beside the weights, MODEL.yaml beside MODEL.onnx. Besides what is read
/// here it holds the provenance: sensors, scenario, seed, commit, steps, figures.
struct Sidecar {
  std::vector<std::string>
      outputs;  ///< what the network tells apart, in its order; else its classes
  std::vector<std::string> classes;   ///< of the class table, one an output
  std::vector<std::string> channels;  ///< in the order of its input
  std::string sha256;                 ///< of the weights' file
  /// Of object_pieces.h; none: pixels decide alone.
  std::optional<PieceModel> cylinders, vehicles;
};

/// Throws Error where the file is not there or a key is missing or of the wrong type, or
/// `cylinders` or `vehicles` does not have a finite weight for each of the family's features.
[[nodiscard]] Sidecar read_sidecar(const std::filesystem::path& file);

/// \return the index into the table of each output's class.
/// Throws Error where a class is not in the table or has no output, the channels are not those that
/// features.h makes, or the weights not those that the sidecar describes.
[[nodiscard]] std::vector<int> check_sidecar(const Sidecar& sidecar,
                                             const std::filesystem::path& file,
                                             const objects::ClassTable& table,
                                             const std::string& weights);

}  // namespace saker::segmentation
