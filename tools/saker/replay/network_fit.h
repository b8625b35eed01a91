#pragma once

#include <filesystem>
#include <string>

#include "saker/autonomy/lockstep.h"

namespace saker::tools {

/// A line where the network was less sure of a recording's points than of 99 of 100 scans of the
/// sensors that it was trained for (`fit` in its description, by scripts/segmentation-fit); empty
/// otherwise, and where the description has none.
/// \param description  MODEL.yaml
[[nodiscard]] std::string network_fit_note(const autonomy::SegmentationFit& fit,
                                           const std::filesystem::path& description);

}  // namespace saker::tools
