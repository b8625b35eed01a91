#pragma once

#include <string>

namespace saker {

/// The repository's root, without a slash at its end: for tests that read configs or recordings.
[[nodiscard]] std::string source_dir();

}  // namespace saker
