#include "saker/objects/class_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "saker/core/config_io.h"
#include "saker/core/error.h"

namespace saker::objects {
namespace {

constexpr const char* kShippedClasses =
#include "shipped_classes.inc"
    ;

struct ClassFile {
  std::vector<ObjectClass> classes;

  template <class Visitor>
  void visit(Visitor& v) {
    v.list("classes", classes, "in the order of the network's output");
  }
};

}  // namespace

const std::vector<ObjectClass>& shipped_classes() {
  static const std::vector<ObjectClass> classes =
      core::config_from_yaml<ClassFile>(kShippedClasses, "models/classes.yaml").classes;
  return classes;
}

ClassId ClassTable::of_label(std::uint32_t label) const {
  for (std::size_t id = 0; id < classes.size(); ++id) {
    const auto& ids = classes[id].label_ids;
    if (std::find(ids.begin(), ids.end(), static_cast<double>(label)) != ids.end()) {
      return static_cast<ClassId>(id);
    }
  }
  return 0;
}

ClassId ClassTable::first_target() const {
  const auto first = std::ranges::find_if(
      classes, [](const ObjectClass& c) { return c.target && c.shape == Shape::cuboid; });
  return first == classes.end() ? ClassId{0} : static_cast<ClassId>(first - classes.begin());
}

std::uint32_t ClassTable::label_of(ClassId id) const {
  const auto& ids = classes[id].label_ids;
  return ids.empty() ? 0 : static_cast<std::uint32_t>(ids.front());
}

ClassId ClassTable::find(const std::string& name) const {
  std::string known;
  for (std::size_t id = 0; id < classes.size(); ++id) {
    if (classes[id].name == name) return static_cast<ClassId>(id);
    known += (id == 0 ? "" : ", ") + classes[id].name;
  }
  throw Error(
      fmt::format("class \"{}\" is not in the class table, expected one of {}", name, known));
}

}  // namespace saker::objects
