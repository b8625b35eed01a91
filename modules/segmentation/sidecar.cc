#include "segmentation/sidecar.h"

#include <yaml-cpp/yaml.h>

#include "core/error.h"
#include "core/sha256.h"
#include "segmentation/features.h"

namespace saker::segmentation {
namespace {

template <class T>
T read_key(const YAML::Node& root, const std::string& key, const std::filesystem::path& file) {
  try {
    if (root.IsMap() && root[key]) return root[key].as<T>();
  } catch (const YAML::Exception&) {
    throw Error(file.string() + ": key '" + key + "' has the wrong type");
  }
  throw Error(file.string() + ": key '" + key + "' is missing");
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return "[" + text + "]";
}

void expect_same(const std::vector<std::string>& found, const std::vector<std::string>& expected,
                 const std::string& what, const std::filesystem::path& file) {
  if (found == expected) return;
  throw Error(file.string() + ": " + what + " " + joined(found) + ", expected " + joined(expected));
}

}  // namespace

Sidecar read_sidecar(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error("model description not found: " + file.string());
  }
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& error) {
    throw Error(file.string() + ": not YAML: " + error.msg);
  }
  return {read_key<std::vector<std::string>>(root, "classes", file),
          read_key<std::vector<std::string>>(root, "channels", file),
          read_key<std::string>(root, "sha256", file)};
}

void check_sidecar(const Sidecar& sidecar, const std::filesystem::path& file,
                   const objects::ClassTable& table, const std::string& weights) {
  std::vector<std::string> names;
  for (const objects::ObjectClass& c : table.classes) names.push_back(c.name);
  expect_same(sidecar.classes, names, "classes", file);
  expect_same(sidecar.channels, {kChannels.begin(), kChannels.end()}, "channels", file);
  const std::string found = core::sha256(weights);
  if (found == sidecar.sha256) return;
  throw Error(file.string() + ": sha256 " + sidecar.sha256 + ", but the weights beside it have " +
              found);
}

}  // namespace saker::segmentation
