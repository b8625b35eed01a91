#pragma once

#include <stdexcept>
#include <string>

namespace saker {

/// A wrong configuration, file or argument, found at set-up: one line that names file, key or
/// field, the value found and what was expected. Never thrown inside a loop; `main` prints it and
/// exits with status 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& line);
};

}  // namespace saker
