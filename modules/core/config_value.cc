#include "saker/core/config_value.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "saker/core/error.h"

namespace saker::core {
namespace {

/// Levenshtein's distance.
int edits(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string found(const YAML::Node& node) {
  if (node.IsScalar()) return fmt::format("\"{}\"", node.Scalar());
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a group" : "nothing";
}

template <class T>
void read_number(const YAML::Node& node, const ConfigPlace& place, T& value, const char* expected) {
  if (!node.IsScalar() || !YAML::convert<T>::decode(node, value)) place.fail(node, expected);
}

/// Text that YAML reads as this string and as nothing else.
bool is_plain(const std::string& text) {
  static const std::vector<std::string> kWords = {"true", "false", "yes", "no", "on",
                                                  "off",  "null",  "y",   "n"};
  std::string lower = text;
  std::transform(text.begin(), text.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto inner = [&](char c) {
    return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '/' || c == '.' || c == '-';
  };
  return !lower.empty() && letter(lower[0]) && std::all_of(lower.begin(), lower.end(), inner) &&
         std::find(kWords.begin(), kWords.end(), lower) == kWords.end();
}

/// Counts what stands in a document, an alias as all that it stands for: one within itself never
/// ends. Throws Error where it is more than any file of ours has.
void refuse_endless(const YAML::Node& node, const std::string& source, int depth, long& nodes) {
  constexpr int kDeepest = 50;
  constexpr long kMostNodes = 1'000'000;
  if (depth > kDeepest || ++nodes > kMostNodes) {
    throw Error(fmt::format("{}:{}: nested without end, expected at most {} levels", source,
                            node.Mark().line + 1, kDeepest));
  }
  for (const auto& entry : node) {
    if (node.IsMap()) {
      refuse_endless(entry.first, source, depth + 1, nodes);
      refuse_endless(entry.second, source, depth + 1, nodes);
    } else {
      refuse_endless(entry, source, depth + 1, nodes);
    }
  }
}

}  // namespace

std::string nearest_key(const std::string& key, const std::vector<std::string>& known) {
  std::string nearest;
  for (const std::string& candidate : known) {
    if (nearest.empty() || edits(key, candidate) < edits(key, nearest)) nearest = candidate;
  }
  return nearest;
}

std::string ConfigPlace::key(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

std::string ConfigPlace::at(const YAML::Mark& mark) const {
  if (lines_ == Lines::hidden || mark.is_null()) return source_;
  return fmt::format("{}:{}", source_, mark.line + 1);
}

ConfigPlace ConfigPlace::inside(const std::string& name, const YAML::Node& map) const {
  ConfigPlace place = *this;
  place.key_ = key(name);
  for (const auto& entry : map) {
    if (map.IsMap() && entry.first.IsScalar() && entry.first.Scalar() == name) {
      place.key_mark_ = entry.first.Mark();
    }
  }
  return place;
}

void ConfigPlace::fail(const YAML::Node& node, const std::string& expected) const {
  const std::string name = key_.empty() ? "" : key_ + ": ";
  const YAML::Mark mark =
      node.IsNull() ? key_mark_ : node.Mark();  // of nothing: where the next key is
  throw Error(fmt::format("{}: {}{}, expected {}", at(mark), name, found(node), expected));
}

void ConfigPlace::expect_map(const YAML::Node& node) const {
  if (!node.IsMap() && !node.IsNull()) fail(node, "a group of keys");
}

void ConfigPlace::expect_sequence(const YAML::Node& node) const {
  if (!node.IsSequence()) fail(node, "a list");
}

void ConfigPlace::check_number(const YAML::Node& node, double value, Bounds bounds,
                               const char* unit) const {
  if (value >= bounds.low && value <= bounds.high) return;
  fail(node, fmt::format("{} … {}{}{}", bounds.low, bounds.high, *unit != 0 ? " " : "", unit));
}

void ConfigPlace::refuse_unknown(const YAML::Node& map,
                                 const std::vector<std::string>& known) const {
  std::vector<std::string> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) fail(entry.first, "a key");
    const std::string name = entry.first.Scalar();
    const std::string where = at(entry.first.Mark());
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(fmt::format("{}: {}: unknown key, the nearest is {}", where, key(name),
                              nearest_key(key(name), *keys_)));
    }
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
      throw Error(fmt::format("{}: {}: named twice", where, key(name)));
    }
    seen.push_back(name);
  }
}

YAML::Node parse_yaml(const std::string& text, const std::string& source) {
  try {
    YAML::Node root = YAML::Load(text);
    long nodes = 0;
    refuse_endless(root, source, 0, nodes);
    return root;
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}:{}: not YAML: {}", source, error.mark.line + 1, error.msg));
  }
}

YAML::Node setting_as_yaml(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(fmt::format("--set {}: expected KEY=VALUE", setting));
  }
  YAML::Node node = parse_yaml(setting.substr(equals + 1), "--set " + setting);
  std::string path = setting.substr(0, equals);
  while (true) {
    const std::size_t dot = path.rfind('.');
    YAML::Node outer;
    outer[dot == std::string::npos ? path : path.substr(dot + 1)] = node;
    if (dot == std::string::npos) return outer;
    path.resize(dot);
    node = outer;
  }
}

void read_value(const YAML::Node& node, const ConfigPlace& place, bool& value) {
  read_number(node, place, value, "true or false");
}

void read_value(const YAML::Node& node, const ConfigPlace& place, int& value) {
  read_number(node, place, value, "an integer");
}

void read_value(const YAML::Node& node, const ConfigPlace& place, double& value) {
  read_number(node, place, value, "a number");
  if (std::isnan(value)) place.fail(node, "a number");
}

void read_value(const YAML::Node& node, const ConfigPlace& place, std::string& value) {
  if (!node.IsScalar()) place.fail(node, "a text");
  value = node.Scalar();
}

std::string value_text(bool value) { return value ? "true" : "false"; }

std::string value_text(int value) { return std::to_string(value); }

std::string value_text(double value) {
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return std::isnan(value) ? ".nan" : fmt::format("{}", value);
}

std::string value_text(const std::string& value) {
  if (is_plain(value)) return value;
  std::string quoted = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    const bool control = byte < ' ' || byte == 0x7F;
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += control ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return quoted + '"';
}

std::string field_comment(const std::string& unit, Bounds bounds, const std::string& meaning) {
  std::string head = unit;
  if (std::isfinite(bounds.low) || std::isfinite(bounds.high)) {
    head += fmt::format("{}{} … {}", head.empty() ? "" : ", ", bounds.low, bounds.high);
  }
  return head.empty() ? meaning : head + ": " + meaning;
}

}  // namespace saker::core
