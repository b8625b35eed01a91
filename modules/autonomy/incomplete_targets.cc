#include "saker/autonomy/incomplete_targets.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace saker::autonomy {

void add_incomplete_targets(objects::ObjectMap& map, std::span<const active::Target> targets) {
  const auto is_target = [&](const objects::MapObject& object) {
    return std::ranges::find(targets, object.id, &active::Target::incomplete_id) != targets.end();
  };
  const auto rest = std::ranges::stable_partition(map.incomplete, std::not_fn(is_target));
  std::ranges::move(rest, std::back_inserter(map.objects));
  map.incomplete.erase(rest.begin(), rest.end());
  std::ranges::sort(map.objects, {}, &objects::MapObject::id);
}

}  // namespace saker::autonomy
