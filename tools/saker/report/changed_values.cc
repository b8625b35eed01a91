#include "tools/saker/report/changed_values.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <map>

#include "saker/core/config_io.h"

namespace saker::tools {
namespace {

using Leaves = std::vector<std::pair<std::string, std::string>>;

bool is_flat(const YAML::Node& list) {
  for (const YAML::Node& entry : list) {
    if (!entry.IsScalar()) return false;
  }
  return true;
}

/// A scalar or a list of such is a leaf.
void add_leaves(const YAML::Node& node, const std::string& key, Leaves& leaves) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const auto name = entry.first.as<std::string>();
      add_leaves(entry.second, key.empty() ? name : fmt::format("{}.{}", key, name), leaves);
    }
  } else if (node.IsSequence() && !is_flat(node)) {
    for (std::size_t i = 0; i < node.size(); ++i)
      add_leaves(node[i], fmt::format("{}[{}]", key, i), leaves);
  } else {
    YAML::Emitter text;
    text << YAML::Flow << node;
    leaves.emplace_back(key, text.c_str());
  }
}

Leaves leaves_of(const flight::ProcessConfig& config) {
  Leaves leaves;
  add_leaves(YAML::Load(core::config_to_yaml(config)), "", leaves);
  return leaves;
}

}  // namespace

std::vector<ChangedValue> changed_values(const flight::ProcessConfig& config) {
  const Leaves now = leaves_of(config), before = leaves_of({});
  const std::map<std::string, std::string> defaults(before.begin(), before.end());
  const std::map<std::string, std::string> values(now.begin(), now.end());
  std::vector<ChangedValue> changed;
  for (const auto& [key, value] : now) {
    const auto normal = defaults.find(key);
    if (normal == defaults.end()) changed.push_back({key, value, ""});
    if (normal != defaults.end() && normal->second != value)
      changed.push_back({key, value, normal->second});
  }
  for (const auto& [key, normal] : before) {
    if (!values.contains(key)) changed.push_back({key, "", normal});
  }
  return changed;
}

}  // namespace saker::tools
