#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saker/core/config.h"

namespace saker::objects {

/// Index into the class table, equal to the place in the network's output; 0 is always `other`.
using ClassId = std::uint8_t;

enum class Shape { none, cuboid, cylinder, plane };

/// Names in the order of the values: what configuration files say.
[[nodiscard]] inline std::vector<std::string> enum_names(Shape) {
  return {"none", "cuboid", "cylinder", "plane"};
}

struct ObjectClass {
  std::string name;
  Shape shape = Shape::none;
  bool target = false;  ///< guides active mapping; the others only hold the pose
  std::vector<double>
      label_ids;         ///< SemanticKITTI ids merged into this class; the first one is written
  bool crowned = false;  ///< leaves stand around its upper part

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "name in maps, messages and files");
    v.field("shape", shape, "", "model of an object: cuboid, cylinder, plane or none");
    v.field("target", target, "", "whether it is mapped actively");
    v.field("label_ids", label_ids, {0, 65535}, "SemanticKITTI id",
            "ids merged into the class; the first is written");
    v.field("crowned", crowned, "",
            "whether leaves stand around its upper part: tells trunks from poles");
  }
};

/// The classes in the order of the network's output.
struct ClassTable {
  std::vector<ObjectClass> classes = {
      {"other", Shape::none, false, {99}},
      {"vehicle", Shape::cuboid, true, {10, 13, 18, 20, 252, 257, 258, 259}},
      {"trunk", Shape::cylinder, false, {71}, true},
      {"pole", Shape::cylinder, false, {80}},
      {"ground", Shape::plane, false, {40, 44, 48, 49, 60, 72}},
  };

  template <class Visitor>
  void visit(Visitor& v) {
    v.list("classes", classes,
           "in the order of the network's output; the first is what belongs to no object");
  }

  [[nodiscard]] int size() const { return static_cast<int>(classes.size()); }
  [[nodiscard]] const ObjectClass& operator[](ClassId id) const { return classes[id]; }
  [[nodiscard]] ClassId of_label(std::uint32_t label) const;  ///< 0 where no class merges it
  [[nodiscard]] std::uint32_t label_of(ClassId id) const;     ///< the id that is written
  [[nodiscard]] ClassId find(const std::string& name) const;  ///< throws Error
};

}  // namespace saker::objects
