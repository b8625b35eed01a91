#include "saker/simulation/world/fleet.h"

#include <algorithm>

namespace saker::simulation {
namespace {

using enum FleetKind;

// kind, name, label, length, width, height, share: European, American, industrial, bus road,
// construction
constexpr FleetEntry kFleet[] = {
    {city_car, "city_car", kCar, {2.7, 3.75}, {1.58, 1.68}, {1.46, 1.56}, {9, 1, 2, 4, 2}},
    {hatchback, "hatchback", kCar, {3.9, 4.4}, {1.68, 1.82}, {1.42, 1.55}, {22, 6, 8, 10, 6}},
    {estate, "estate", kCar, {4.5, 4.95}, {1.78, 1.88}, {1.44, 1.54}, {13, 2, 5, 6, 5}},
    {sedan, "sedan", kCar, {4.4, 5.4}, {1.74, 2.0}, {1.4, 1.5}, {10, 24, 6, 9, 5}},
    {coupe, "coupe", kCar, {4.1, 5.05}, {1.77, 1.95}, {1.26, 1.45}, {4, 4, 1, 2, 1}},
    {compact_suv, "compact_suv", kCar, {4.1, 4.65}, {1.77, 1.87}, {1.58, 1.7}, {12, 12, 5, 7, 4}},
    {suv, "suv", kCar, {4.6, 5.05}, {1.86, 2.0}, {1.68, 1.8}, {7, 14, 4, 5, 4}},
    {large_suv, "large_suv", kCar, {5.1, 5.75}, {2.0, 2.08}, {1.88, 1.97}, {0.5, 9, 2, 2, 2}},
    {mpv, "mpv", kCar, {4.4, 5.2}, {1.8, 2.0}, {1.64, 1.79}, {6, 5, 3, 5, 3}},
    {pickup_midsize,
     "pickup_midsize",
     kCar,
     {5.25, 5.73},
     {1.85, 1.92},
     {1.77, 1.87},
     {1.5, 4, 4, 1, 6}},
    {pickup_fullsize,
     "pickup_fullsize",
     kCar,
     {5.7, 6.4},
     {2.0, 2.09},
     {1.89, 2.04},
     {0.5, 11, 6, 3, 8}},
    {small_van, "small_van", kVan, {4.35, 4.9}, {1.78, 1.87}, {1.79, 1.92}, {5, 1, 5, 3, 4}},
    {van, "van", kVan, {4.9, 5.55}, {1.89, 2.0}, {1.9, 2.5}, {6, 3, 7, 4, 7}},
    {large_van, "large_van", kVan, {5.3, 7.37}, {1.99, 2.07}, {2.25, 2.85}, {6, 5, 10, 6, 10}},
    {step_van, "step_van", kTruck, {6.5, 8.3}, {2.2, 2.45}, {2.85, 3.2}, {0.6, 3.5, 4, 2, 1}},
    {box_van, "box_van", kTruck, {6.0, 7.4}, {2.12, 2.35}, {2.9, 3.35}, {2.5, 3, 6, 3, 3}},
    {box_truck, "box_truck", kTruck, {7.0, 10.2}, {2.45, 2.6}, {3.2, 3.95}, {3, 4, 14, 4, 4}},
    {flatbed_truck, "flatbed_truck", kTruck, {6.0, 10.0}, {2.3, 2.55}, {2.5, 3.2}, {1, 2, 7, 1, 8}},
    {tipper_truck,
     "tipper_truck",
     kTruck,
     {7.0, 9.2},
     {2.45, 2.55},
     {2.9, 3.4},
     {0.8, 1, 6, 1, 14}},
    {refuse_truck, "refuse_truck", kTruck, {8.5, 10.2}, {2.5, 2.55}, {3.3, 3.75}, {1, 1, 3, 1, 1}},
    {mixer_truck,
     "mixer_truck",
     kTruck,
     {8.2, 9.6},
     {2.45, 2.55},
     {3.55, 3.95},
     {0.4, 0.6, 4, 1, 10}},
    {semi_trailer,
     "semi_trailer",
     kTruck,
     {15.5, 16.5},
     {2.5, 2.6},
     {3.8, 4.1},
     {1, 0.6, 12, 2, 3}},
    {long_nose_semi,
     "long_nose_semi",
     kTruck,
     {18.5, 22.0},
     {2.5, 2.6},
     {3.9, 4.15},
     {0, 2, 4, 1, 1}},
    {city_bus, "city_bus", kBus, {10.5, 12.5}, {2.5, 2.6}, {2.85, 3.3}, {4, 4, 3, 14, 2}},
    {articulated_bus,
     "articulated_bus",
     kBus,
     {17.8, 18.75},
     {2.5, 2.6},
     {2.95, 3.35},
     {1.5, 1, 0.5, 7, 0.5}},
    {coach, "coach", kBus, {12.0, 14.0}, {2.5, 2.6}, {3.4, 3.9}, {2, 2, 2, 6, 1}},
    {school_bus, "school_bus", kBus, {9.5, 12.2}, {2.38, 2.46}, {3.0, 3.25}, {0.3, 2.5, 1, 4, 0.5}},
    {minibus, "minibus", kBus, {5.9, 8.7}, {2.0, 2.42}, {2.6, 3.1}, {1.2, 1.5, 1.5, 5, 1}},
    {excavator,
     "excavator",
     kOtherVehicle,
     {5.5, 9.6},
     {1.9, 3.0},
     {2.5, 3.3},
     {0.6, 0.5, 3, 0.4, 14}},
    {wheel_loader,
     "wheel_loader",
     kOtherVehicle,
     {5.3, 8.3},
     {1.75, 2.9},
     {2.45, 3.45},
     {0.5, 0.4, 3, 0.3, 10}},
    {roller, "roller", kOtherVehicle, {4.6, 6.0}, {2.1, 2.35}, {2.85, 3.1}, {0.2, 0.2, 1, 0.2, 6}},
    {forklift,
     "forklift",
     kOtherVehicle,
     {3.5, 3.9},
     {1.12, 1.3},
     {2.05, 2.25},
     {0.2, 0.2, 6, 0.1, 3}},
    {trailer, "trailer", kOtherVehicle, {2.2, 5.0}, {1.3, 2.0}, {0.75, 2.2}, {2, 1.5, 4, 0.5, 5}},
    {caravan, "caravan", kOtherVehicle, {5.5, 7.5}, {2.1, 2.5}, {2.5, 2.72}, {1.5, 1, 1, 0.5, 0.5}},
};

std::size_t index_of(FleetKind kind) { return static_cast<std::size_t>(kind); }

void draw_member(const FleetShape& shape, const Palette& palette, const Parts& parts,
                 const Pen& pen, core::Rng& rng) {
  if (shape.kind <= large_van) return draw_light(shape, palette, parts, pen, rng);
  if (shape.kind <= long_nose_semi) return draw_truck(shape, parts, pen, rng);
  if (shape.kind <= minibus) return draw_bus(shape, parts, pen, rng);
  if (shape.kind <= forklift) return draw_machine(shape, parts, pen, rng);
  draw_trailer(shape, parts, pen, rng);
}

}  // namespace

std::span<const FleetEntry> fleet_table() { return kFleet; }

const FleetEntry& entry_of(FleetKind kind) { return kFleet[index_of(kind)]; }

FleetKind random_kind(FleetTheme theme, core::Rng& rng) {
  const std::size_t column = static_cast<std::size_t>(theme) - 1;
  double total = 0;
  for (const FleetEntry& entry : kFleet) total += entry.share[column];
  double draw = rng.uniform(0, total);
  for (const FleetEntry& entry : kFleet) {
    draw -= entry.share[column];
    if (draw < 0) return entry.kind;
  }
  return hatchback;
}

FleetShape random_shape(FleetKind kind, core::Rng& rng) {
  const FleetEntry& entry = entry_of(kind);
  const double big = rng.uniform();  // a long one is wide and high, too
  const auto within = [&](const Range& range) {
    return range.low + (range.high - range.low) * (0.5 * big + 0.5 * rng.uniform());
  };
  FleetShape shape{kind};
  shape.length = within(entry.length);
  shape.width = within(entry.width);
  shape.height = within(entry.height);
  return shape;
}

void add_fleet_vehicle(World& world, const Palette& palette, const FleetShape& shape,
                       const SE3& T_world_ground, bool moving, core::Rng& rng) {
  const FleetEntry& entry = entry_of(shape.kind);
  objects::Cuboid cuboid;
  cuboid.pose = T_world_ground * placed(0, 0, shape.height / 2);
  cuboid.size = {shape.length, shape.width, shape.height};
  const ObjectId id = world.add({"vehicle", entry.name, cuboid, moving});
  const Parts parts = make_parts(world, palette, entry.label, rng);
  draw_member(shape, palette, parts, Pen(world.mesh, T_world_ground, id), rng);
}

}  // namespace saker::simulation
