#pragma once

#include <string>
#include <vector>

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

enum class VehicleKind { sedan, hatchback, suv, van, pickup, truck, bus, trailer };

[[nodiscard]] std::string name_of(VehicleKind kind);

/// Dimensions of a body, m; lengths along x are measured from the front end backwards.
struct VehicleShape {
  VehicleKind kind = VehicleKind::sedan;
  double length = 4.6, width = 1.8, height = 1.45;
  double clearance = 0.18;  ///< of the underbody
  double wheel_radius = 0.32;
  double front_axle = 0.9;   ///< behind the front end
  double rear_axle = 0.95;   ///< before the rear end
  double bonnet = 0.75;      ///< height of its edge
  double belt = 0.92;        ///< height of the windows' lower edge
  double tail = 0.95;        ///< height of the boot lid, bed wall or window sill at the rear
  double screen_base = 1.3;  ///< where the windscreen meets the bonnet
  double roof_front = 1.95;
  double roof_rear = 3.4;
  double rear_base =
      3.95;  ///< where the rear window meets the boot; the length for an upright tail
  double tumblehome = 0.28;  ///< inward lean of the side windows
  double roundness = 0.16;   ///< narrowing of the plan at the ends, of the width
  bool panel_sides = false;  ///< no side windows behind the front doors
  bool open_bed = false;
};

/// A random body of `kind`: dimensions of the European and American fleet.
[[nodiscard]] VehicleShape random_shape(VehicleKind kind, core::Rng& rng);

/// Draws a passenger vehicle: origin on the ground under its centre, x to its front.
void draw_vehicle(const VehicleShape& shape, const Palette& palette, MaterialId paint,
                  MaterialId glass, const Pen& pen);

/// Puts a vehicle of `kind` on the ground at `T_world_ground` and into the world's truth (cars
/// only: trucks, buses and trailers are vehicles too). \return its shape.
VehicleShape add_vehicle(World& world, const Palette& palette, VehicleKind kind,
                         const SE3& T_world_ground, bool moving, core::Rng& rng);
/// A vehicle that drives: a mover of the world (its index is returned), in the truth as moving.
std::size_t add_mover(World& world, const Palette& palette, const VehicleShape& shape,
                      const SE3& T_world_ground, core::Rng& rng);
VehicleShape add_vehicle(World& world, const Palette& palette, const VehicleShape& shape,
                         const SE3& T_world_ground, bool moving, core::Rng& rng);

}  // namespace saker::simulation
