#include "saker/segmentation/sidecar.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "saker/core/error.h"
#include "saker/core/sha256.h"
#include "saker/segmentation/features.h"

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

/// Weights of one kind, in the order of the family's features.
PieceFeatures read_weights(const YAML::Node& block, const PieceFamilyInfo& family,
                           const std::string& kind, const std::filesystem::path& file) {
  const auto weights = read_key<std::map<std::string, float>>(block, kind, file);
  const std::string where = file.string() + ": " + family.name + ", " + kind + ": ";
  PieceFeatures read(static_cast<Eigen::Index>(family.features.size()));
  for (std::size_t k = 0; k < family.features.size(); ++k) {
    const auto found = weights.find(family.features[k]);
    if (found == weights.end() || !std::isfinite(found->second))
      throw Error(where + "expected a number for " + family.features[k]);
    read[static_cast<Eigen::Index>(k)] = found->second;
  }
  if (weights.size() == family.features.size()) return read;
  throw Error(where + std::to_string(weights.size()) + " weights, expected " +
              std::to_string(family.features.size()));
}

std::optional<PieceModel> read_pieces(const YAML::Node& root, PieceFamily family,
                                      const std::filesystem::path& file) {
  const PieceFamilyInfo& info = info_of(family);
  const YAML::Node block = root[info.name];
  if (!block) return std::nullopt;
  PieceModel model;
  for (const char* kind : info.kinds) model.kinds.push_back(read_weights(block, info, kind, file));
  return model;
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
  Sidecar sidecar;
  sidecar.classes = read_key<std::vector<std::string>>(root, "classes", file);
  sidecar.outputs =
      root["outputs"] ? read_key<std::vector<std::string>>(root, "outputs", file) : sidecar.classes;
  sidecar.channels = read_key<std::vector<std::string>>(root, "channels", file);
  sidecar.sha256 = read_key<std::string>(root, "sha256", file);
  sidecar.cylinders = read_pieces(root, PieceFamily::cylinders, file);
  sidecar.vehicles = read_pieces(root, PieceFamily::vehicles, file);
  return sidecar;
}

std::vector<int> check_sidecar(const Sidecar& sidecar, const std::filesystem::path& file,
                               const objects::ClassTable& table, const std::string& weights) {
  if (sidecar.outputs.size() != sidecar.classes.size()) {
    throw Error(file.string() + ": " + std::to_string(sidecar.classes.size()) +
                " classes, expected " + std::to_string(sidecar.outputs.size()) + ", one an output");
  }
  std::vector<std::string> names;
  for (const objects::ObjectClass& c : table.classes) names.push_back(c.name);
  std::vector<int> class_of;
  for (const std::string& name : sidecar.classes) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw Error(file.string() + ": " + name + " in classes, expected one of " + joined(names));
    class_of.push_back(static_cast<int>(found - names.begin()));
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (std::find(class_of.begin(), class_of.end(), static_cast<int>(k)) == class_of.end())
      throw Error(file.string() + ": classes " + joined(sidecar.classes) + ", expected one for " +
                  names[k]);
  }
  expect_same(sidecar.channels, {kChannels.begin(), kChannels.end()}, "channels", file);
  const std::string found = core::sha256(weights);
  if (found == sidecar.sha256) return class_of;
  throw Error(file.string() + ": sha256 " + sidecar.sha256 + ", but the weights beside it have " +
              found);
}

}  // namespace saker::segmentation
