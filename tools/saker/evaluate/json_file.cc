#include "tools/saker/evaluate/json_file.h"

#include <fmt/format.h>

#include <cmath>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {

void JsonNode::fail(const std::string& expected) const {
  constexpr std::size_t kShown = 40;
  std::string found = value_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (found.size() > kShown) found = found.substr(0, kShown) + "...";
  throw Error(fmt::format("{}: {}, expected {}", path_, found, expected));
}

bool JsonNode::has(const std::string& key) const {
  return value_.is_object() && value_.contains(key);
}

JsonNode JsonNode::at(const std::string& key) const {
  if (!value_.is_object()) fail("an object with fields");
  const auto found = value_.find(key);
  const std::string path = fmt::format("{}.{}", path_, key);
  if (found == value_.end()) throw Error(path + ": missing");
  return {*found, path};
}

double JsonNode::number() const {
  if (!value_.is_number() || !std::isfinite(value_.get<double>())) fail("a number");
  return value_.get<double>();
}

bool JsonNode::boolean() const {
  if (!value_.is_boolean()) fail("true or false");
  return value_.get<bool>();
}

std::string JsonNode::text() const {
  if (!value_.is_string()) fail("a text");
  return value_.get<std::string>();
}

std::vector<double> JsonNode::numbers(std::size_t count) const {
  std::vector<double> values;
  if (!value_.is_array() || value_.size() != count) fail(fmt::format("{} numbers", count));
  each_element([&values](const JsonNode& element) { values.push_back(element.number()); });
  return values;
}

void JsonNode::each_element(const std::function<void(const JsonNode&)>& use) const {
  if (!value_.is_array()) fail("a list");
  for (std::size_t i = 0; i < value_.size(); ++i) use({value_[i], fmt::format("{}[{}]", path_, i)});
}

void JsonNode::each_field(
    const std::function<void(const std::string&, const JsonNode&)>& use) const {
  if (!value_.is_object()) fail("an object with fields");
  for (const auto& [key, value] : value_.items()) use(key, {value, path_ + " " + key});
}

nlohmann::json read_json(const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(core::read_file(file));
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace saker::tools
