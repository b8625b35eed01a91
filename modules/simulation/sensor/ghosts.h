#pragma once

#include "saker/simulation/sensor/scan_effects.h"

namespace saker::simulation {

/// Beams that came back from nowhere because glass, polished paint or wet ground mirrored them
/// away: a share answers over the mirror, and seems to lie behind it. They are labelled as
/// outliers. Casts the lost beams again and follows each over one mirror, which is flat where it is
/// met.
void add_ghosts(double share, const ScanSetting& setting, core::Rng& rng, CastScan& scan);

}  // namespace saker::simulation
