#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <string>
#include <type_traits>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/files.h"

/// Single values of a configuration, and where they stand: what config_io.h is made of.
namespace saker::core {

/// Where in which file a value stands, for messages; knows all keys of the configuration.
class ConfigPlace {
 public:
  enum class Lines { shown, hidden };

  ConfigPlace(std::string source, const std::vector<std::string>& keys, Lines lines)
      : source_(std::move(source)), keys_(&keys), lines_(lines) {}

  /// Of the value of `name` in `map`.
  [[nodiscard]] ConfigPlace inside(const std::string& name, const YAML::Node& map) const;

  /// "FILE:LINE: KEY: found, expected …"
  [[noreturn]] void fail(const YAML::Node& node, const std::string& expected) const;

  void expect_map(const YAML::Node& node) const;
  void expect_sequence(const YAML::Node& node) const;
  /// Also refuses what is named twice.
  void refuse_unknown(const YAML::Node& map, const std::vector<std::string>& known) const;

  template <class T>
  void check(const YAML::Node& node, const T& value, Bounds bounds, const char* unit) const {
    if constexpr (std::is_arithmetic_v<T>) {
      check_number(node, static_cast<double>(value), bounds, unit);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        check_number(node[i], value[i], bounds, unit);
      }
    }
  }

 private:
  void check_number(const YAML::Node& node, double value, Bounds bounds, const char* unit) const;
  [[nodiscard]] std::string at(const YAML::Mark& mark) const;
  [[nodiscard]] std::string key(const std::string& name) const;

  std::string source_;
  const std::vector<std::string>* keys_;
  Lines lines_;
  std::string key_;
  YAML::Mark key_mark_ = YAML::Mark::null_mark();
};

/// The known key with the fewest edits from `key`; empty where there is none.
[[nodiscard]] std::string nearest_key(const std::string& key,
                                      const std::vector<std::string>& known);

/// Throws Error with the line on text that is not YAML.
[[nodiscard]] YAML::Node parse_yaml(const std::string& text, const std::string& source);

/// `a.b=value` as {a: {b: value}}.
[[nodiscard]] YAML::Node setting_as_yaml(const std::string& setting);

[[nodiscard]] inline std::string fmt_index(const std::string& name, std::size_t i) {
  return fmt::format("{}[{}]", name, i);
}

// Reading: wrong types are refused by `place`.

void read_value(const YAML::Node& node, const ConfigPlace& place, bool& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, int& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, double& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, std::string& value);

template <class T>
void read_value(const YAML::Node& node, const ConfigPlace& place, std::vector<T>& values) {
  place.expect_sequence(node);
  values.assign(node.size(), T{});
  for (std::size_t i = 0; i < node.size(); ++i) read_value(node[i], place, values[i]);
}

template <class E>
requires std::is_enum_v<E>
void read_value(const YAML::Node& node, const ConfigPlace& place, E& value) {
  const std::vector<std::string> names = enum_names(E{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!node.IsScalar() || node.Scalar() != names[i]) continue;
    value = static_cast<E>(i);
    return;
  }
  place.fail(node, fmt::format("one of {}", fmt::join(names, ", ")));
}

// Writing: text that is read back as the same value.

[[nodiscard]] std::string value_text(bool value);
[[nodiscard]] std::string value_text(int value);
[[nodiscard]] std::string value_text(double value);
[[nodiscard]] std::string value_text(const std::string& value);

template <class T>
[[nodiscard]] std::string value_text(const std::vector<T>& values) {
  std::vector<std::string> texts;
  for (const T& v : values) texts.push_back(value_text(v));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

template <class E>
requires std::is_enum_v<E>
[[nodiscard]] std::string value_text(E value) {
  return enum_names(E{}).at(static_cast<std::size_t>(value));
}

/// "m, 0.05 … 10: edge of a voxel"
[[nodiscard]] std::string field_comment(const std::string& unit, Bounds bounds,
                                        const std::string& meaning);

}  // namespace saker::core
