#include "saker/core/moved_keys.h"

#include <utility>

namespace saker::core {
namespace {

/// "a" and "b.c" of "a.b.c"; "" and "c" of "c".
std::pair<std::string, std::string> first_and_rest(const std::string& key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) return {key, ""};
  return {key.substr(0, dot), key.substr(dot + 1)};
}

/// Takes the value at `key` out, and groups that are empty without it; not defined where there is
/// none.
YAML::Node take(YAML::Node map, const std::string& key) {
  const auto [first, rest] = first_and_rest(key);
  if (!map.IsMap() || !map[first]) return YAML::Node(YAML::NodeType::Undefined);
  YAML::Node value = map[first];
  if (rest.empty()) {
    map.remove(first);
    return value;
  }
  const YAML::Node taken = take(value, rest);
  if (taken.IsDefined() && value.size() == 0) map.remove(first);
  return taken;
}

/// Puts a value where there is none; groups are joined.
void put(YAML::Node map, const std::string& key, const YAML::Node& value) {
  const auto [first, rest] = first_and_rest(key);
  if (rest.empty() && !map[first]) {
    map[first] = value;
    return;
  }
  if (!rest.empty()) {
    if (!map[first]) map[first] = YAML::Node(YAML::NodeType::Map);
    if (map[first].IsMap()) put(map[first], rest, value);
    return;
  }
  if (!value.IsMap() || !map[first].IsMap()) return;
  for (const auto& entry : value) put(map[first], entry.first.Scalar(), entry.second);
}

/// The ends of the keys inside a value: ".a.b"; of one that is no group a single "".
std::vector<std::string> ends_of(const YAML::Node& value) {
  if (!value.IsMap()) return {""};
  std::vector<std::string> ends;
  for (const auto& entry : value) {
    for (const std::string& end : ends_of(entry.second)) {
      ends.push_back("." + entry.first.Scalar() + end);
    }
  }
  return ends;
}

}  // namespace

std::vector<std::string> move_keys(YAML::Node& root, std::span<const MovedKey> moved) {
  std::vector<std::string> lines;
  if (!root.IsMap()) return lines;
  for (const MovedKey& key : moved) {
    const YAML::Node value = take(root, key.old_key);
    if (!value.IsDefined()) continue;
    for (const std::string& end : ends_of(value)) {
      const std::string old_key = key.old_key + end;
      lines.push_back(key.new_key == nullptr ? old_key + ": is gone and ignored: " + key.why
                                             : old_key + ": is now " + key.new_key + end);
    }
    if (key.new_key != nullptr) put(root, key.new_key, value);
  }
  return lines;
}

}  // namespace saker::core
