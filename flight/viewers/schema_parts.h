#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "flight/viewers/json_value.h"

/// Parts of JSON Schemas, of plain types alone: viewers read no others.
namespace saker::flight::viewers::schema {

[[nodiscard]] Json number(const char* meaning = "");
[[nodiscard]] Json integer(const char* meaning = "");
[[nodiscard]] Json text(const char* meaning = "");
[[nodiscard]] Json flag(const char* meaning = "");
[[nodiscard]] Json list(Json items, const char* meaning = "");
[[nodiscard]] Json numbers(const char* meaning = "");

/// An object of named parts, all required but those whose name ends in '?'.
[[nodiscard]] Json object(std::initializer_list<std::pair<std::string, Json>> parts,
                          const char* title = "");

/// Foxglove's common parts (docs.foxglove.dev, "schemas").
[[nodiscard]] Json time();
[[nodiscard]] Json vector();
[[nodiscard]] Json quaternion();
[[nodiscard]] Json pose();
[[nodiscard]] Json colour();

/// Foxglove's messages, as far as we say them.
[[nodiscard]] Json scene_update();
[[nodiscard]] Json frame_transforms();
[[nodiscard]] Json location_fix();
[[nodiscard]] Json log();
[[nodiscard]] Json point_cloud();

}  // namespace saker::flight::viewers::schema
