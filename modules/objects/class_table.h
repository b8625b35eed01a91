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

/// A kind within a class, as vans are of vehicles: detection/size_prior.h fits boxes by them.
struct ObjectKind {
  std::string name;
  double share = 1;
  std::vector<double> length_m, width_m, height_m;
  bool single = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "of the kind");
    v.field("share", share, {1e-6, 1}, "", "of all objects of the class");
    v.field("length_m", length_m, {0.001, 100}, "m", "mean and standard deviation of the length");
    v.field("width_m", width_m, {0.001, 100}, "m", "the same of the width");
    v.field("height_m", height_m, {0.001, 100}, "m", "the same of the height");
    v.field("single", single, "", "whether it is one object; else it is to be split");
  }
};

/// A class, and what its objects are like before they are seen; of one that does not say, as of a
/// vehicle.
struct ObjectClass {
  std::string name;
  Shape shape = Shape::none;
  bool target = false;            ///< guides active mapping; the others only hold the pose
  std::vector<double> label_ids;  ///< SemanticKITTI ids that it merges; the first one is written
  bool crowned = false;           ///< leaves stand around its upper part
  std::vector<double> size_m = {4.5, 1.9, 1.6};  ///< a car's
  double length_sd_m = 0.45;                     ///< of makers' dimensions, small to large cars
  double width_sd_m = 0.12;                      ///< the same, vans included
  double footprint_m = 5;  ///< of a parked car, with what errors of single windows add
  std::vector<ObjectKind> kinds;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "name in maps, messages and files");
    v.field("shape", shape, "", "model of an object: cuboid, cylinder, plane or none");
    v.field("target", target, "", "whether it is mapped actively");
    v.field("label_ids", label_ids, {0, 65535}, "SemanticKITTI id",
            "ids merged into the class; the first is written");
    v.field("crowned", crowned, "",
            "whether leaves stand around its upper part: tells trunks from poles");
    v.field("size_m", size_m, {0.1, 30}, "m",
            "length, width and height of one of which nothing else is known");
    v.field("length_sd_m", length_sd_m, {0.01, 10}, "m", "standard deviation of lengths");
    v.field("width_sd_m", width_sd_m, {0.01, 10}, "m", "standard deviation of widths");
    v.field("footprint_m", footprint_m, {0.1, 20}, "m",
            "length that footprints of one that stands cover together, seen from all sides");
    v.list("kinds", kinds, "of a cuboid class, by size");
  }
};

/// The classes of configs/models/classes.yaml, which is built into the library.
[[nodiscard]] const std::vector<ObjectClass>& shipped_classes();

/// The classes in the order of the network's output.
struct ClassTable {
  std::vector<ObjectClass> classes = shipped_classes();

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
  [[nodiscard]] ClassId first_target() const;  ///< of those mapped as cuboids; 0 where none is
};

}  // namespace saker::objects
