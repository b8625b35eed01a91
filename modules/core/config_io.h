#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "saker/core/config_value.h"
#include "saker/core/moved_keys.h"

/// Configurations in YAML files: loaded over the defaults in the structs, saved with a comment on
/// every key.
///
/// Each error is an Error of one line that names the file and line (or the --set), the key, what
/// was found and what was expected; for an unknown key the nearest known one.
namespace saker::core {

/// Every key of a configuration, groups included: "odometry", "odometry.voxel_m", …
class KeyCollector : public EachField<KeyCollector> {
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
class ConfigLoader : public EachField<ConfigLoader> {
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

/// Whether a configuration has a setting, in its groups and lists too.
class SettingFinder {
 public:
  template <class T>
  void field(const char*, T&, Bounds, const char*, const char*) {}
  template <class T>
  void field(const char*, T&, const char*, const char*) {}
  template <class T>
  void setting(const char*, T&, Bounds, const char*, const char*) {
    found_ = true;
  }
  template <class T>
  void setting(const char*, T&, const char*, const char*) {
    found_ = true;
  }
  template <class Config>
  void group(const char*, Config& child, const char*) {
    child.visit(*this);
  }
  template <class Config>
  void list(const char*, std::vector<Config>& children, const char*) {
    for (Config& child : children) child.visit(*this);
  }

  [[nodiscard]] bool found() const { return found_; }

 private:
  bool found_ = false;
};

/// What of a configuration is written: all of it, its settings alone, or all with `~` in front of
/// the comment on what is no setting; of a group without settings on the group alone.
enum class Written { all, settings, all_marked };

/// Writes YAML with a comment on each key: unit, valid values, meaning.
class ConfigSaver {
 public:
  explicit ConfigSaver(Written written = Written::all, int depth = 0)
      : written_(written), indent_(2 * static_cast<std::size_t>(depth), ' ') {}

  template <class T>
  void field(const char* name, T& value, Bounds bounds, const char* unit, const char* meaning) {
    if (written_ == Written::settings) return;
    add(name, value_text(value), marked(field_comment(unit, bounds, meaning)));
  }
  template <class T>
  void field(const char* name, T& value, const char* unit, const char* meaning) {
    field(name, value, Bounds{}, unit, meaning);
  }
  template <class T>
  void setting(const char* name, T& value, Bounds bounds, const char* unit, const char* meaning) {
    add(name, value_text(value), field_comment(unit, bounds, meaning));
  }
  template <class T>
  void setting(const char* name, T& value, const char* unit, const char* meaning) {
    setting(name, value, Bounds{}, unit, meaning);
  }
  template <class Config>
  void group(const char* name, Config& child, const char* meaning) {
    if (left_out(child)) return;
    add(name, "", comment_of(child, meaning));
    ConfigSaver inner(written_inside(child), depth() + 1);
    child.visit(inner);
    text_ += inner.text_;
  }
  template <class Config>
  void list(const char* name, std::vector<Config>& children, const char* meaning) {
    Entries<Config> entries{children};
    if (left_out(entries)) return;
    add(name, children.empty() ? "[]" : "", comment_of(entries, meaning));
    for (Config& child : children) {
      ConfigSaver inner(written_inside(child), depth() + 2);
      inner.comments_ = &child == &children.front();
      child.visit(inner);
      text_ += inner.as_list_entry();
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class Config>
  struct Entries {
    std::vector<Config>& children;
    void visit(SettingFinder& finder) { finder.list("", children, ""); }
  };

  template <class Config>
  [[nodiscard]] static bool has_setting(Config& config) {
    SettingFinder finder;
    config.visit(finder);
    return finder.found();
  }
  template <class Config>
  [[nodiscard]] bool left_out(Config& config) const {
    return written_ == Written::settings && !has_setting(config);
  }
  template <class Config>
  [[nodiscard]] std::string comment_of(Config& config, const char* meaning) const {
    return has_setting(config) ? meaning : marked(meaning);
  }
  template <class Config>
  [[nodiscard]] Written written_inside(Config& config) const {
    return written_ == Written::all_marked && !has_setting(config) ? Written::all : written_;
  }
  [[nodiscard]] std::string marked(const std::string& comment) const {
    return written_ == Written::all_marked ? "~ " + comment : comment;
  }
  [[nodiscard]] int depth() const { return static_cast<int>(indent_.size() / 2); }
  void add(const char* name, const std::string& value, const std::string& comment);
  [[nodiscard]] std::string as_list_entry() const;

  Written written_;
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

/// Keys that a file or a --set of an earlier version may name, and who is told of each that did.
struct ConfigHistory {
  std::span<const MovedKey> moved;
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// A map of keys over `config`: those that moved go to their new places first.
template <class Config>
[[nodiscard]] Config config_from_node(YAML::Node node, const std::string& source,
                                      ConfigPlace::Lines lines, Config config,
                                      const ConfigHistory& history) {
  const std::vector<std::string> keys = config_keys(config);
  for (const std::string& line : move_keys(node, history.moved)) {
    history.say(source + ": " + line);
  }
  ConfigLoader::load(ConfigPlace(source, keys, lines), node, config);
  return config;
}

/// The text of a YAML file over `config`; `source` is how messages call it.
template <class Config>
[[nodiscard]] Config config_from_yaml(const std::string& text, const std::string& source,
                                      Config config = {}, const ConfigHistory& history = {}) {
  return config_from_node(parse_yaml(text, source), source, ConfigPlace::Lines::shown,
                          std::move(config), history);
}

/// `a.b=value` or `a.list[2].b=value` over `config`.
template <class Config>
[[nodiscard]] Config config_with_setting(const std::string& setting, Config config,
                                         const ConfigHistory& history = {}) {
  return config_from_node(setting_as_yaml(setting), "--set " + setting, ConfigPlace::Lines::hidden,
                          std::move(config), history);
}

/// `config`, then `file` over it (none when empty), then the settings in their order.
template <class Config>
[[nodiscard]] Config load_config(const std::filesystem::path& file,
                                 const std::vector<std::string>& settings, Config config = {},
                                 const ConfigHistory& history = {}) {
  if (!file.empty()) {
    config = config_from_yaml(read_file(file), file.string(), std::move(config), history);
  }
  for (const std::string& setting : settings) {
    config = config_with_setting(setting, std::move(config), history);
  }
  return config;
}

template <class Config>
[[nodiscard]] std::string config_to_yaml(Config config, Written written = Written::all) {
  ConfigSaver saver(written);
  config.visit(saver);
  return saver.text();
}

}  // namespace saker::core
