#pragma once

#include <string>

namespace saker {

/// Text that somebody else wrote, for a line: control characters become "?".
[[nodiscard]] std::string one_line(std::string text);

}  // namespace saker
