#include "saker/core/error.h"

namespace saker {

Error::Error(const std::string& line) : std::runtime_error(line) {}

}  // namespace saker
