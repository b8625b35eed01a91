#pragma once

#include <string>
#include <vector>

namespace saker::tools {

/// A configuration under a name of its own, for a table that compares several.
struct Variant {
  std::string name;                   ///< of its rows and its folder
  std::vector<std::string> settings;  ///< each "KEY=VALUE", over what all variants have
};

/// A policy with nothing else changed; its name is the policy's.
[[nodiscard]] Variant policy_variant(const std::string& policy);

/// \param text  "NAME KEY=VALUE …", separated by spaces. Throws Error on a name that is no folder's
/// (letters, digits, "_" and "-" only).
[[nodiscard]] Variant variant_of(const std::string& text);

}  // namespace saker::tools
