#pragma once

#include <span>

#include "saker/active/tour/targets.h"
#include "saker/objects/object_map.h"

namespace saker::autonomy {

/// Takes the targets of which nobody saw how long they are into the map: windows alone could have
/// taken a part of something else for a vehicle, but here the prior map says that one stands there,
/// or, without one, it was flown to and looked at.
/// Its length is what its class's is like, its covariance says how little that tells.
void add_incomplete_targets(objects::ObjectMap& map, std::span<const active::Target> targets);

}  // namespace saker::autonomy
