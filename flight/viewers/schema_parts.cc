#include "flight/viewers/schema_parts.h"

namespace saker::flight::viewers::schema {
namespace {

Json plain(const char* type, const char* meaning) {
  Json part = {{"type", type}};
  if (*meaning != '\0') part["description"] = meaning;
  return part;
}

}  // namespace

Json number(const char* meaning) { return plain("number", meaning); }
Json integer(const char* meaning) { return plain("integer", meaning); }
Json text(const char* meaning) { return plain("string", meaning); }
Json flag(const char* meaning) { return plain("boolean", meaning); }

Json list(Json items, const char* meaning) {
  Json part = plain("array", meaning);
  part["items"] = std::move(items);
  return part;
}

Json numbers(const char* meaning) { return list(number(), meaning); }

Json object(std::initializer_list<std::pair<std::string, Json>> parts, const char* title) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& [name, part] : parts) {
    const bool optional = name.ends_with('?');
    const std::string key = optional ? name.substr(0, name.size() - 1) : name;
    properties[key] = part;
    if (!optional) required.push_back(key);
  }
  Json result = {{"type", "object"}, {"properties", properties}, {"required", required}};
  if (*title != '\0') result["title"] = title;
  return result;
}

Json time() { return object({{"sec", integer()}, {"nsec", integer()}}, "time"); }
Json vector() { return object({{"x", number()}, {"y", number()}, {"z", number()}}); }
Json quaternion() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() { return object({{"position", vector()}, {"orientation", quaternion()}}); }
Json colour() {
  return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

namespace {

Json duration() { return object({{"sec", integer()}, {"nsec", integer()}}, "duration"); }

Json line() {
  return object({{"type", integer("0 strip, 1 loop, 2 pairs")},
                 {"pose", pose()},
                 {"thickness", number()},
                 {"scale_invariant", flag()},
                 {"points", list(vector())},
                 {"color", colour()},
                 {"colors", list(colour())},
                 {"indices", list(integer())}});
}

Json entity() {
  const Json solid = object({{"pose", pose()}, {"size", vector()}, {"color", colour()}});
  const Json cylinder = object({{"pose", pose()},
                                {"size", vector()},
                                {"bottom_scale", number()},
                                {"top_scale", number()},
                                {"color", colour()}});
  const Json arrow = object({{"pose", pose()},
                             {"shaft_length", number()},
                             {"shaft_diameter", number()},
                             {"head_length", number()},
                             {"head_diameter", number()},
                             {"color", colour()}});
  const Json none = object({});
  return object({{"timestamp", time()},
                 {"frame_id", text()},
                 {"id", text()},
                 {"lifetime", duration()},
                 {"frame_locked", flag()},
                 {"metadata", list(object({{"key", text()}, {"value", text()}}))},
                 {"arrows", list(arrow)},
                 {"cubes", list(solid)},
                 {"spheres", list(solid)},
                 {"cylinders", list(cylinder)},
                 {"lines", list(line())},
                 {"triangles", list(none)},
                 {"texts", list(none)},
                 {"models", list(none)}});
}

}  // namespace

Json scene_update() {
  const Json deletion = object({{"timestamp", time()}, {"type", integer()}, {"id", text()}});
  return object({{"deletions", list(deletion)}, {"entities", list(entity())}},
                "foxglove.SceneUpdate");
}

Json frame_transforms() {
  const Json transform = object({{"timestamp", time()},
                                 {"parent_frame_id", text()},
                                 {"child_frame_id", text()},
                                 {"translation", vector()},
                                 {"rotation", quaternion()}});
  return object({{"transforms", list(transform)}}, "foxglove.FrameTransforms");
}

Json location_fix() {
  return object({{"timestamp", time()},
                 {"frame_id", text()},
                 {"latitude", number("degrees")},
                 {"longitude", number("degrees")},
                 {"altitude", number("metres")},
                 {"position_covariance", numbers("east, north, up; m^2")},
                 {"position_covariance_type", integer("0 unknown, 1 approximated")}},
                "foxglove.LocationFix");
}

Json log() {
  return object({{"timestamp", time()},
                 {"level", integer("2 info, 3 warning, 4 error")},
                 {"message", text()},
                 {"name", text()},
                 {"file", text()},
                 {"line", integer()}},
                "foxglove.Log");
}

Json point_cloud() {
  Json data = text("packed points");
  data["contentEncoding"] = "base64";
  const Json field = object({{"name", text()}, {"offset", integer()}, {"type", integer()}});
  return object({{"timestamp", time()},
                 {"frame_id", text()},
                 {"pose", pose()},
                 {"point_stride", integer()},
                 {"fields", list(field)},
                 {"data", data},
                 {"resolution_m?", number("edge of a cell of occupancy")}},
                "foxglove.PointCloud");
}

}  // namespace saker::flight::viewers::schema
