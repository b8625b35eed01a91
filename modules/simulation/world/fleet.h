#pragma once

#include <span>
#include <string>

#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {

/// What drives and stands in the streets of training worlds. Flights, missions and spirals have the
/// smaller fleet of vehicle.h.
enum class FleetKind {
  city_car,
  hatchback,
  estate,
  sedan,
  coupe,
  compact_suv,
  suv,
  large_suv,
  mpv,
  pickup_midsize,
  pickup_fullsize,
  small_van,
  van,
  large_van,
  step_van,
  box_van,
  box_truck,
  flatbed_truck,
  tipper_truck,
  refuse_truck,
  mixer_truck,
  semi_trailer,
  long_nose_semi,
  city_bus,
  articulated_bus,
  coach,
  school_bus,
  minibus,
  excavator,
  wheel_loader,
  roller,
  forklift,
  trailer,
  caravan,
};

/// What kind of street a world is: which vehicles are in it.
enum class FleetTheme { none, european, american, industrial, bus_road, construction };
inline constexpr int kFleetThemes = 5;  ///< without `none`

struct Range {
  double low, high;
};

/// One row of the fleet. Sizes are those published for models that docs/training_worlds.md names,
/// without mirrors.
struct FleetEntry {
  FleetKind kind;
  const char* name;
  std::uint16_t label;
  Range length, width, height;             ///< m
  std::array<double, kFleetThemes> share;  ///< parts of the vehicles of each theme
};

[[nodiscard]] std::span<const FleetEntry> fleet_table();
[[nodiscard]] const FleetEntry& entry_of(FleetKind kind);

/// A vehicle to be: the outline that its mesh fills, without mirrors.
struct FleetShape {
  FleetKind kind = FleetKind::sedan;
  double length = 4.6, width = 1.8, height = 1.45;
};

[[nodiscard]] FleetKind random_kind(FleetTheme theme, core::Rng& rng);
[[nodiscard]] FleetShape random_shape(FleetKind kind, core::Rng& rng);

/// Puts a vehicle on the ground at `T_world_ground` (origin under its middle, x to its front) and
/// into the world's truth.
void add_fleet_vehicle(World& world, const Palette& palette, const FleetShape& shape,
                       const SE3& T_world_ground, bool moving, core::Rng& rng);

// By family; the pen is in the vehicle's frame.
void draw_light(const FleetShape& shape, const Palette& palette, const Parts& parts, const Pen& pen,
                core::Rng& rng);
void draw_truck(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng);
void draw_bus(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng);
void draw_machine(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng);
void draw_trailer(const FleetShape& shape, const Parts& parts, const Pen& pen, core::Rng& rng);

}  // namespace saker::simulation
