#include "saker/core/error.h"

#include <algorithm>

#include "saker/core/one_line.h"

namespace saker {

std::string one_line(std::string text) {
  const auto control = [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; };
  std::replace_if(text.begin(), text.end(), control, '?');
  return text;
}

Error::Error(const std::string& line) : std::runtime_error(one_line(line)) {}

}  // namespace saker
