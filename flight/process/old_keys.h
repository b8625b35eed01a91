#pragma once

#include <array>

#include "saker/core/moved_keys.h"

namespace saker::flight {

/// Keys of earlier versions that an installed configuration may name: where each is now, or why it
/// is gone. A key that moves or goes is added here.
extern const std::array<core::MovedKey, 28> kOldKeys;

}  // namespace saker::flight
