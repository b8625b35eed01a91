#include "tools/saker/experiment/variant.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "saker/core/error.h"

namespace saker::tools {

Variant policy_variant(const std::string& policy) { return {policy, {"active.policy=" + policy}}; }

Variant variant_of(const std::string& text) {
  std::istringstream words(text);
  Variant variant;
  words >> variant.name;
  const bool valid = std::ranges::all_of(
      variant.name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
  if (variant.name.empty() || !valid) {
    throw Error("--variant \"" + text +
                "\": expected \"NAME KEY=VALUE …\", a name of letters, digits, _ and -");
  }
  for (std::string setting; words >> setting;) variant.settings.push_back(setting);
  return variant;
}

}  // namespace saker::tools
