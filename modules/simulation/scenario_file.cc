#include "simulation/scenario_file.h"

#include <yaml-cpp/yaml.h>

#include <set>
#include <vector>

#include "core/error.h"

namespace saker::simulation {
namespace {

/// Fills a config's fields from a map and remembers which keys it knows.
class Reader {
 public:
  Reader(YAML::Node node, std::string file, std::string prefix)
      : node_(std::move(node)), file_(std::move(file)), prefix_(std::move(prefix)) {
    if (node_ && !node_.IsNull() && !node_.IsMap())
      fail(node_, prefix_, "expected keys and values");
  }

  template <class T>
  void field(const char* name, T& value, core::Bounds, const char*, const char*) {
    read(name, value);
  }
  template <class T>
  void field(const char* name, T& value, const char*, const char*) {
    read(name, value);
  }
  template <class Config>
  void group(const char* name, Config& child, const char*) {
    known_.insert(name);
    Reader inner(node_ && node_.IsMap() ? node_[name] : YAML::Node(), file_, prefix_ + name + ".");
    child.visit(inner);
    inner.refuse_unknown();
  }

  void refuse_unknown() const {
    if (!node_ || !node_.IsMap()) return;
    for (const auto& entry : node_) {
      const auto key = entry.first.as<std::string>();
      if (!known_.contains(key)) fail(entry.first, prefix_ + key, "unknown key");
    }
  }

 private:
  [[noreturn]] void fail(const YAML::Node& at, const std::string& key,
                         const std::string& what) const {
    throw Error(file_ + ":" + std::to_string(at.Mark().line + 1) + ": " + key + ": " + what);
  }

  template <class T>
  void read(const char* name, T& value) {
    known_.insert(name);
    if (!node_ || !node_.IsMap() || !node_[name]) return;
    const YAML::Node found = node_[name];
    try {
      if constexpr (std::is_enum_v<T>) {
        value = enum_value<T>(found, name);
      } else {
        value = found.as<T>();
      }
    } catch (const YAML::Exception&) {
      fail(found, prefix_ + name, "a value of another type");
    }
  }

  template <class T>
  T enum_value(const YAML::Node& found, const char* name) const {
    const std::vector<std::string> names = enum_names(T{});
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (found.as<std::string>() == names[i]) return static_cast<T>(i);
      list += (i > 0 ? ", " : "") + names[i];
    }
    fail(found, prefix_ + name, found.as<std::string>() + ", expected one of " + list);
  }

  YAML::Node node_;
  std::string file_;
  std::string prefix_;
  std::set<std::string> known_;
};

}  // namespace

Scenario load_scenario(const std::string& file) {
  Scenario scenario;
  YAML::Node root;
  try {
    root = YAML::LoadFile(file);
  } catch (const YAML::BadFile&) {
    throw Error("cannot read " + file);
  } catch (const YAML::Exception& e) {
    throw Error(file + ":" + std::to_string(e.mark.line + 1) + ": " + e.msg);
  }
  Reader reader(root, file, "");
  scenario.visit(reader);
  reader.refuse_unknown();
  return core::checked(scenario, file);
}

}  // namespace saker::simulation
