#pragma once

#include <string>
#include <vector>

#include "saker/autonomy/lockstep.h"

namespace saker::tools {

/// Why a run over a recording is not what a user would want of it, a line each; none: it is.
/// Status 1 says the same.
/// \param detections  measurements of objects in all windows
[[nodiscard]] std::vector<std::string> shortfalls(const autonomy::LockstepResult& result,
                                                  int detections);

}  // namespace saker::tools
