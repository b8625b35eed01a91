#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "saker/core/config_value.h"

/// Configurations in YAML files: loaded over the defaults in the structs, saved with a comment on
/// every key.
///
/// Each error is an Error of one line that names the file and line (or the --set), the key, what
/// was found and what was expected; for an unknown key the nearest known one.
namespace saker::core {

/// Every key of a configuration, groups included: "odometry", "odometry.voxel_m", …
class KeyCollector {
 public:
  explicit KeyCollector(std::string prefix = "") : prefix_(std::move(prefix)) {}

  template <class T>
  void field(const char* name, T&, Bounds, const char*, const char*) {
    add(name);
  }
  template <class T>
  void field(const char* name, T&, const char*, const char*) {
    add(name);
  }
  template <class Config>
  void group(const char* name, Config& child, const char*) {
    add(name);
    visit_inside(prefix_ + name + ".", child);
  }
  template <class Config>
  void list(const char* name, std::vector<Config>& children, const char*) {
    add(name);
    for (std::size_t i = 0; i < children.size(); ++i) {
      visit_inside(fmt_index(prefix_ + name, i) + ".", children[i]);
    }
  }

  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }

 private:
  void add(const char* name) { keys_.push_back(prefix_ + name); }
  template <class Config>
  void visit_inside(const std::string& prefix, Config& child) {
    KeyCollector inner(prefix);
    child.visit(inner);
    keys_.insert(keys_.end(), inner.keys_.begin(), inner.keys_.end());
  }

  std::string prefix_;
  std::vector<std::string> keys_;
};

/// Reads one map of a file into one struct; what the file does not name keeps its value.
class ConfigLoader {
 public:
  ConfigLoader(ConfigPlace place, YAML::Node node)
      : place_(std::move(place)), map_(std::move(node)) {
    place_.expect_map(map_);
  }

  template <class T>
  void field(const char* name, T& value, Bounds bounds, const char* unit, const char* meaning) {
    field(name, value, unit, meaning);
    if (const YAML::Node node = map_[name])
      place_.inside(name, map_).check(node, value, bounds, unit);
  }
  template <class T>
  void field(const char* name, T& value, const char*, const char*) {
    known_.emplace_back(name);
    if (const YAML::Node node = map_[name]) read_value(node, place_.inside(name, map_), value);
  }
  template <class Config>
  void group(const char* name, Config& child, const char*) {
    known_.emplace_back(name);
    if (const YAML::Node node = map_[name]) load(place_.inside(name, map_), node, child);
  }
  /// A list in a file replaces the list; a key `name[i]`, as --set has it, changes one of its
  /// entries.
  template <class Config>
  void list(const char* name, std::vector<Config>& children, const char*) {
    known_.emplace_back(name);
    if (const YAML::Node node = map_[name]) {
      place_.inside(name, map_).expect_sequence(node);
      children.assign(node.size(), Config());
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::string key = fmt_index(name, i);
      known_.push_back(key);
      const YAML::Node node = map_[name] ? map_[name][i] : map_[key];
      if (node) load(place_.inside(key, map_), node, children[i]);
    }
  }

  void refuse_unknown() const { place_.refuse_unknown(map_, known_); }

  template <class Config>
  static void load(const ConfigPlace& place, const YAML::Node& node, Config& config) {
    ConfigLoader loader(place, node);
    config.visit(loader);
    loader.refuse_unknown();
  }

 private:
  ConfigPlace place_;
  const YAML::Node map_;
  std::vector<std::string> known_;
};

/// Writes YAML with a comment on each key: unit, valid values, meaning.
class ConfigSaver {
 public:
  explicit ConfigSaver(int depth = 0) : indent_(2 * depth, ' ') {}

  template <class T>
  void field(const char* name, T& value, Bounds bounds, const char* unit, const char* meaning) {
    add(name, value_text(value), field_comment(unit, bounds, meaning));
  }
  template <class T>
  void field(const char* name, T& value, const char* unit, const char* meaning) {
    add(name, value_text(value), field_comment(unit, {}, meaning));
  }
  template <class Config>
  void group(const char* name, Config& child, const char* meaning) {
    add(name, "", meaning);
    ConfigSaver inner(depth() + 1);
    child.visit(inner);
    text_ += inner.text_;
  }
  template <class Config>
  void list(const char* name, std::vector<Config>& children, const char* meaning) {
    add(name, children.empty() ? "[]" : "", meaning);
    for (Config& child : children) {
      ConfigSaver inner(depth() + 2);
      inner.comments_ = &child == &children.front();
      child.visit(inner);
      text_ += inner.as_list_entry();
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] int depth() const { return static_cast<int>(indent_.size() / 2); }
  void add(const char* name, const std::string& value, const std::string& comment);
  [[nodiscard]] std::string as_list_entry() const;

  std::string indent_;
  std::string text_;
  bool comments_ = true;
};

/// Known keys of `config`, for the messages.
template <class Config>
[[nodiscard]] std::vector<std::string> config_keys(Config config) {
  KeyCollector collector;
  config.visit(collector);
  return collector.keys();
}

/// The text of a YAML file over `config`; `source` is how messages call it.
template <class Config>
[[nodiscard]] Config config_from_yaml(const std::string& text, const std::string& source,
                                      Config config = {}) {
  const std::vector<std::string> keys = config_keys(config);
  ConfigLoader::load(ConfigPlace(source, keys, ConfigPlace::Lines::shown), parse_yaml(text, source),
                     config);
  return config;
}

/// `a.b=value` or `a.list[2].b=value` over `config`.
template <class Config>
[[nodiscard]] Config config_with_setting(const std::string& setting, Config config) {
  const std::vector<std::string> keys = config_keys(config);
  ConfigLoader::load(ConfigPlace("--set " + setting, keys, ConfigPlace::Lines::hidden),
                     setting_as_yaml(setting), config);
  return config;
}

/// Defaults, then `file` (none when empty), then the settings in their order.
template <class Config>
[[nodiscard]] Config load_config(const std::filesystem::path& file,
                                 const std::vector<std::string>& settings) {
  Config config;
  if (!file.empty()) config = config_from_yaml(read_file(file), file.string(), std::move(config));
  for (const std::string& setting : settings) {
    config = config_with_setting(setting, std::move(config));
  }
  return config;
}

template <class Config>
[[nodiscard]] std::string config_to_yaml(Config config) {
  ConfigSaver saver;
  config.visit(saver);
  return saver.text();
}

}  // namespace saker::core
