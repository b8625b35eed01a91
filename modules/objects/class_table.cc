#include "saker/objects/class_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "saker/core/error.h"

namespace saker::objects {

ClassId ClassTable::of_label(std::uint32_t label) const {
  for (std::size_t id = 0; id < classes.size(); ++id) {
    const auto& ids = classes[id].label_ids;
    if (std::find(ids.begin(), ids.end(), static_cast<double>(label)) != ids.end()) {
      return static_cast<ClassId>(id);
    }
  }
  return 0;
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
