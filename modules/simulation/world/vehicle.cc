#include "saker/simulation/world/vehicle.h"

#include <algorithm>

#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {
namespace {

std::uint16_t label_of(VehicleKind kind) {
  switch (kind) {
    case VehicleKind::truck:
      return kTruck;
    case VehicleKind::bus:
      return kBus;
    case VehicleKind::trailer:
      return kOtherVehicle;
    default:
      return kCar;
  }
}

Material black_paint(std::uint16_t label, core::Rng& rng) {
  const double reflectivity = rng.uniform(0.02, 0.05);
  const double gloss = rng.uniform(0.6, 0.95);
  return {label, static_cast<float>(reflectivity), 0.02F, static_cast<float>(gloss), 0, 0};
}

Material random_paint(std::uint16_t label, Paint paint, core::Rng& rng) {
  return paint == Paint::black ? black_paint(label, rng) : any_paint(label, 0.3, rng);
}

Material vehicle_glass(std::uint16_t label, core::Rng& rng) {
  const float transmission = static_cast<float>(rng.uniform(0.02, 0.3));  // there and back
  return {label, 0.05F, 0.03F, 0.998F, transmission, 0};
}

void draw_wheel_pair(const VehicleShape& s, const Palette& palette, double x, const Pen& pen) {
  Pen draw = pen;
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (s.width / 2 - 0.03);
    draw.tube({{x, y - side * 0.28, s.wheel_radius}, {x, y, s.wheel_radius}},
              {s.wheel_radius, s.wheel_radius}, 18, palette.rubber);
  }
}

/// A row of panes along both sides, let into the wall.
void draw_panes(const VehicleShape& s, double low, double high, MaterialId glass, const Pen& pen) {
  Pen draw = pen;
  for (double x = -s.length / 2 + 0.3; x + 1.3 < s.length / 2; x += 1.45) {
    for (const double side : {-1.0, 1.0}) {
      const double y = side * s.width / 2;
      draw.box({x, y - 0.004, low}, {x + 1.3, y + 0.004, high}, glass);
    }
  }
}

void draw_heavy(const VehicleShape& s, const Palette& palette, MaterialId paint, MaterialId glass,
                const Pen& pen) {
  Pen draw = pen;
  const double front = s.length / 2;
  const double w = s.width / 2;
  const bool truck = s.kind == VehicleKind::truck;
  const double box_front = truck ? front - 1.9 : front;
  const double floor = truck ? 0.95 : s.clearance;
  draw.box({-front, -w, floor}, {box_front, w, s.height}, paint);
  if (truck) {
    const double cab = std::min(s.height, 2.5);
    draw.box({front - 1.75, -w + 0.08, 0.45}, {front, w - 0.08, cab}, paint);
    draw.box({front - 0.01, -w + 0.2, 1.5}, {front + 0.01, w - 0.2, cab - 0.2}, glass);
    draw.box({-front + 0.2, -0.5, 0.6}, {front - 1.8, 0.5, 0.95}, palette.dark);
  }
  if (s.kind == VehicleKind::bus) draw_panes(s, 1.1, s.height - 0.6, glass, pen);
  draw_wheel_pair(s, palette, -front + s.rear_axle, pen);
  if (s.kind != VehicleKind::trailer) draw_wheel_pair(s, palette, front - s.front_axle, pen);
}

}  // namespace

VehicleShape add_vehicle(World& world, const Palette& palette, VehicleKind kind,
                         const SE3& T_world_ground, bool moving, core::Rng& rng) {
  return add_vehicle(world, palette, random_shape(kind, rng), T_world_ground, moving, rng);
}

namespace {

void draw(World& world, const Palette& palette, const VehicleShape& shape, const Pen& pen,
          core::Rng& rng) {
  const std::uint16_t label = label_of(shape.kind);
  const MaterialId paint = world.add(random_paint(label, palette.paint, rng));
  const MaterialId glass = world.add(vehicle_glass(label, rng));
  if (label == kCar) {
    draw_vehicle(shape, palette, paint, glass, pen);
  } else {
    draw_heavy(shape, palette, paint, glass, pen);
  }
}

TrueObject true_vehicle(const VehicleShape& shape, const SE3& T_world_ground, bool moving) {
  objects::Cuboid cuboid;
  cuboid.pose = T_world_ground * placed(0, 0, shape.height / 2);
  cuboid.size = {shape.length, shape.width, shape.height};
  return {"vehicle", name_of(shape.kind), cuboid, moving};
}

}  // namespace

VehicleShape add_vehicle(World& world, const Palette& palette, const VehicleShape& shape,
                         const SE3& T_world_ground, bool moving, core::Rng& rng) {
  const ObjectId id = world.add(true_vehicle(shape, T_world_ground, moving));
  draw(world, palette, shape, Pen(world.mesh, T_world_ground, id), rng);
  return shape;
}

std::size_t add_mover(World& world, const Palette& palette, const VehicleShape& shape,
                      const SE3& T_world_ground, core::Rng& rng) {
  const ObjectId id = world.add(true_vehicle(shape, T_world_ground, true));
  Mesh mesh;
  draw(world, palette, shape, Pen(mesh), rng);
  world.prototypes.push_back(std::move(mesh));
  const Eigen::Affine3d T(T_world_ground.matrix());
  world.movers.push_back({world.prototypes.size() - 1, T.cast<float>(), id});
  return world.movers.size() - 1;
}

}  // namespace saker::simulation
