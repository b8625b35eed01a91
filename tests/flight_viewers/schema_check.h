#pragma once

#include <fmt/format.h>

#include <string>

#include "flight/viewers/json_value.h"

namespace saker::flight::viewers::testing {

inline bool is_of_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

/// What of `value` is not as the schema says, in one line; empty where all is. Knows what our
/// schemas are made of: type, properties, required, items. Names that no schema has are wrong, too.
inline std::string against_schema(const Json& value, const Json& schema, const std::string& at) {
  const std::string type = schema.at("type");
  if (!is_of_type(value, type)) return fmt::format("{}: {}, expected {}", at, value.dump(), type);
  if (type == "array") {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string wrong =
          against_schema(value[i], schema.at("items"), fmt::format("{}[{}]", at, i));
      if (!wrong.empty()) return wrong;
    }
  }
  if (type != "object") return {};
  for (const Json& name : schema.at("required")) {
    if (!value.contains(name)) return fmt::format("{}: no {}", at, name.dump());
  }
  const Json& properties = schema.at("properties");
  if (properties.empty()) return {};  // of whatever names
  for (const auto& [name, part] : value.items()) {
    if (!properties.contains(name)) return fmt::format("{}: {} is in no schema", at, name);
    const std::string wrong = against_schema(part, properties.at(name), at + "." + name);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace saker::flight::viewers::testing
