#include "paths.h"

namespace saker {

std::string source_dir() { return SAKER_SOURCE_DIR; }

}  // namespace saker
