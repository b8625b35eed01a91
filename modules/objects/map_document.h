#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

/// The tree of values behind both forms of a map's file.
namespace saker::objects {

using Document = nlohmann::ordered_json;

[[nodiscard]] Document to_document(const ObjectMap& map, const ClassTable& table);

/// Throws Error("FILE: FIELD: …") on what is missing, of a wrong type or not a valid model.
[[nodiscard]] ObjectMap from_document(const Document& document, const ClassTable& table,
                                      const std::string& file);

}  // namespace saker::objects
