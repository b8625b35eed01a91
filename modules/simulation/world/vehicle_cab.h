#pragma once

#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {

/// A driver's cab, over the engine (a short nose) or behind a bonnet. Lengths run backwards from
/// its front end, heights up from the ground, m.
struct CabShape {
  double front = 0;     ///< x of its front end
  double length = 1.9;  ///< to its back wall
  double half_width = 1.2;
  double nose = 0.03;  ///< of the bonnet
  double nose_half_width = 1.2;
  double rake = 0.12;    ///< run of the windscreen along x
  double window = 0.9;   ///< length of the side windows
  double low = 0.45;     ///< of the bumper
  double bonnet = 1.4;   ///< of its front edge
  double belt = 1.55;    ///< of the windows' lower edge
  double lintel = 2.35;  ///< and of the upper one
  double height = 2.7;
  bool back_wall = true;  ///< without it one sees into what follows
};

/// Walls, windows, bonnet, seats, mirrors and number plate; wheels are not part of it.
void draw_cab(const Pen& pen, const CabShape& cab, const Parts& parts);

}  // namespace saker::simulation
