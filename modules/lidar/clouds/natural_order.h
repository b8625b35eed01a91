#pragma once

#include <string_view>

namespace saker::lidar {

/// Names as people count them: 1, 2, 10; runs of digits compare as numbers, the rest byte by byte.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace saker::lidar
