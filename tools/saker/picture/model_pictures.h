#pragma once

#include <filesystem>

#include "saker/objects/class_table.h"
#include "saker/uncertainty/uncertainty.h"

namespace saker::tools {

/// The paper's pictures of the models, as PNG in `folder`: for each class of cuboids the regions of
/// high confidence (CLASS_confidence), of small errors (CLASS_errors) and of both (CLASS_both)
/// around an object that looks to the right; for all classes the entropy of one view's errors
/// against range (entropy_range) and, for cuboids, angle (entropy_angle).
void write_model_pictures(const std::filesystem::path& folder, const uncertainty::Model& model,
                          const objects::ClassTable& table);

}  // namespace saker::tools
