#pragma once

#include "saker/core/rng.h"
#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {

/// The room behind a cab, above the frame.
struct BodyRoom {
  double rear, front, half_width, floor, top;
};

// What trucks carry, drawn into the room: each reaches its top, except flat beds and tanks.
void draw_box_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);
void draw_flat_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);
void draw_tipper_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);
void draw_refuse_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);
void draw_mixer_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);
/// A trailer's: box or curtain, container on a frame, tank, or flat with a load.
void draw_semi_body(const Pen& pen, const BodyRoom& room, const Parts& parts, core::Rng& rng);

}  // namespace saker::simulation
