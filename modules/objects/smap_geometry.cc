#include "saker/objects/smap_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/core/error.h"
#include "saker/objects/object_numbers.h"
#include "saker/objects/rice.h"

namespace saker::objects {
namespace {

/// How many objects back the one is looked for whose ground height is nearest.
constexpr std::size_t kLookBack = 8;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

std::int64_t in_steps(double value, double step, double low, double high) {
  if (!(value >= low && value <= high)) {
    throw Error(fmt::format("object map: {}, expected {} … {}", value, low, high));
  }
  return std::llround(value / step);
}

double from_steps(std::int64_t steps, double step, double low, double high) {
  const double value = static_cast<double>(steps) * step;
  if (!(value >= low && value <= high)) {
    throw Error(fmt::format("{}, expected {} … {}", value, low, high));
  }
  return value;
}

std::int64_t angle_in_steps(double angle, const SmapSteps& steps) {
  if (!std::isfinite(angle)) throw Error("object map: a number is not finite");
  return std::llround(angle / radians(steps.angle_deg));
}

double angle_of(std::int64_t angle, const SmapSteps& steps) {
  return static_cast<double>(angle) * radians(steps.angle_deg);
}

/// The shortest rotation by which z tilts, as a rotation vector in the plane.
Eigen::Quaterniond tilted(const Eigen::Vector2d& tilt) {
  const double half = tilt.norm() / 2;
  const Eigen::Vector2d xy = (half > 0 ? std::sin(half) / half : 1) * tilt / 2;
  return {std::cos(half), xy.x(), xy.y(), 0};
}

struct Turn {
  double heading;        ///< about z, before the tilt
  Eigen::Vector2d tilt;  ///< rad
};

/// Swing and twist: rotation = tilted(tilt) · (heading about z).
Turn turn_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const double in_plane = std::hypot(q.w(), q.z());
  const Eigen::Quaterniond twist =
      in_plane > 0 ? Eigen::Quaterniond(q.w() / in_plane, 0, 0, q.z() / in_plane)
                   : Eigen::Quaterniond::Identity();
  const Eigen::Vector2d swing = (q * twist.conjugate()).vec().head<2>();
  const double size = swing.norm();
  const double angle = 2 * std::atan2(size, in_plane);
  return {2 * std::atan2(twist.z(), twist.w()),
          size > 0 ? Eigen::Vector2d(angle / size * swing) : Eigen::Vector2d::Zero()};
}

Eigen::Vector2d tilt_of(const Eigen::Vector3d& axis) {
  const double size = axis.head<2>().norm();
  const Eigen::Vector2d normal(-axis.y(), axis.x());
  if (size > 0) return std::atan2(size, axis.z()) / size * normal;
  return {axis.z() < 0 ? std::numbers::pi : 0, 0};
}

std::array<std::int64_t, 6> shape_in_steps(const Cuboid& cuboid, const SmapSteps& steps) {
  const auto size = [&](int i) {
    return in_steps(cuboid.size[i], steps.size_m, 0, kLargestObject_m);
  };
  const Turn turn = turn_of(cuboid.pose.linear());
  // One turn of headings, so that those on both sides of the jump are near each other nowhere else.
  const double full = 2 * std::numbers::pi;
  const double heading = turn.heading - full * std::floor(turn.heading / full);
  return {size(0),
          size(1),
          size(2),
          angle_in_steps(heading, steps),
          angle_in_steps(turn.tilt.x(), steps),
          angle_in_steps(turn.tilt.y(), steps)};
}

std::array<std::int64_t, 6> shape_in_steps(const Cylinder& cylinder, const SmapSteps& steps) {
  const Eigen::Vector2d tilt = tilt_of(cylinder.axis);
  return {in_steps(cylinder.radius, steps.radius_m, 0, kLargestObject_m),
          in_steps(cylinder.height, steps.size_m, 0, kLargestObject_m),
          angle_in_steps(tilt.x(), steps), angle_in_steps(tilt.y(), steps)};
}

int columns_of(Shape shape) { return shape == Shape::cuboid ? 6 : 4; }

/// How far the place of a cuboid, its centre, is above the ground, in steps of position.
std::int64_t lift(const CoarseObject& object, Shape shape, const SmapSteps& steps) {
  if (shape != Shape::cuboid) return 0;
  const double height = static_cast<double>(object.shape[2]) * steps.size_m;
  return std::llround(std::clamp(height, 0.0, kLargestObject_m) / 2 / steps.position_m);
}

/// Whole numbers of a damaged file may be anything: sums wrap around.
std::int64_t sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

/// Ground heights along the curve: each is expected where the nearest of those before has it.
class GroundHeights {
 public:
  [[nodiscard]] std::int64_t expected(const CoarseObject& object) const {
    std::int64_t nearest = INT64_MAX, height = 0;
    for (std::size_t i = 0; i < std::min(count_, kLookBack); ++i) {
      const std::int64_t dx = before_[i].x - object.x, dy = before_[i].y - object.y;
      const std::int64_t distance = dx * dx + dy * dy;  // within a tile: at most 49 bits
      if (distance >= nearest) continue;
      nearest = distance;
      height = before_[i].z;
    }
    return height;
  }
  void add(const CoarseObject& object, std::int64_t height) {
    before_[count_++ % kLookBack] = {object.x, object.y, height};
  }

 private:
  struct Known {
    std::int64_t x = 0, y = 0, z = 0;
  };
  std::array<Known, kLookBack> before_{};
  std::size_t count_ = 0;
};

/// The lower bits of both, each on every second bit.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits &= 0xFFFFFFFFU;
  bits = (bits | bits << 16) & 0x0000FFFF0000FFFFU;
  bits = (bits | bits << 8) & 0x00FF00FF00FF00FFU;
  bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0FU;
  bits = (bits | bits << 2) & 0x3333333333333333U;
  return (bits | bits << 1) & 0x5555555555555555U;
}

std::int64_t every_second_bit(std::uint64_t bits) {
  bits &= 0x5555555555555555U;
  bits = (bits | bits >> 1) & 0x3333333333333333U;
  bits = (bits | bits >> 2) & 0x0F0F0F0F0F0F0F0FU;
  bits = (bits | bits >> 4) & 0x00FF00FF00FF00FFU;
  bits = (bits | bits >> 8) & 0x0000FFFF0000FFFFU;
  return static_cast<std::int64_t>((bits | bits >> 16) & 0xFFFFFFFFU);
}

void take_places(BitReader& in, const SmapTile& tile, const SmapSteps& steps,
                 std::vector<CoarseObject>& objects) {
  const std::vector<std::int64_t> gaps = read_column(in, objects.size());
  const std::uint64_t end = std::uint64_t{1} << (2 * steps.tile_bits);
  std::uint64_t at = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto gap = static_cast<std::uint64_t>(gaps[i]);
    if (gap >= end - at) throw Error("an object lies outside of its tile");
    at += gap;
    objects[i].x = (tile.x << steps.tile_bits) + every_second_bit(at);
    objects[i].y = (tile.y << steps.tile_bits) + every_second_bit(at >> 1);
  }
}

void take_heights(BitReader& in, const SmapHead& head, std::vector<CoarseObject>& objects) {
  const std::vector<std::int64_t> steps_up = read_column(in, objects.size());
  GroundHeights heights;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    CoarseObject& object = objects[i];
    const Shape shape = head.classes[static_cast<std::size_t>(object.object_class)].shape;
    const std::int64_t height = sum(heights.expected(object), steps_up[i]);
    heights.add(object, height);
    object.z = sum(height, lift(object, shape, head.steps));
  }
}

}  // namespace

std::uint64_t morton(std::int64_t x, std::int64_t y) {
  return spread_bits(static_cast<std::uint64_t>(x)) | spread_bits(static_cast<std::uint64_t>(y))
                                                          << 1;
}

CoarseObject coarse(const MapObject& object, const ClassTable& table, const SmapSteps& steps) {
  const Shape shape = table[object.class_id].shape;
  const bool cuboid = std::holds_alternative<Cuboid>(object.model);
  if (shape != (cuboid ? Shape::cuboid : Shape::cylinder)) {
    throw Error(fmt::format("object map: object {} has another shape than its class {}", object.id,
                            table[object.class_id].name));
  }
  const Eigen::Vector3d at = place(object.model);
  const auto coordinate = [&](int i) {
    return in_steps(at[i], steps.position_m, -kFarthest_m, kFarthest_m);
  };
  return {
      coordinate(0),
      coordinate(1),
      coordinate(2),
      object.class_id,
      in_steps(probability_of(object), steps.probability, 0, 1),
      std::visit([&](const auto& model) { return shape_in_steps(model, steps); }, object.model)};
}

std::string pack_geometry(std::span<const CoarseObject> objects, std::span<const SmapClass> classes,
                          const SmapSteps& steps) {
  BitWriter out;
  std::vector<std::int64_t> column;
  const auto write = [&] {
    write_column(out, column);
    column.clear();
  };
  const auto shape_of = [&](const CoarseObject& object) {
    return classes[static_cast<std::size_t>(object.object_class)].shape;
  };
  for (const CoarseObject& object : objects) column.push_back(object.object_class);
  write();
  std::uint64_t before = 0;
  const std::int64_t inside = (std::int64_t{1} << steps.tile_bits) - 1;
  for (const CoarseObject& object : objects) {
    const std::uint64_t at = morton(object.x & inside, object.y & inside);
    column.push_back(static_cast<std::int64_t>(at - before));
    before = at;
  }
  write();
  for (const CoarseObject& object : objects) column.push_back(object.probability);
  write();
  for (const Shape shape : {Shape::cuboid, Shape::cylinder}) {
    for (int i = 0; i < columns_of(shape); ++i) {
      for (const CoarseObject& object : objects) {
        if (shape_of(object) == shape) column.push_back(object.shape[static_cast<std::size_t>(i)]);
      }
      write();
    }
  }
  GroundHeights heights;
  for (const CoarseObject& object : objects) {
    const std::int64_t height = object.z - lift(object, shape_of(object), steps);
    column.push_back(height - heights.expected(object));
    heights.add(object, height);
  }
  write();
  return out.finish();
}

std::vector<CoarseObject> unpack_geometry(std::string bytes, const SmapTile& tile,
                                          const SmapHead& head) {
  BitReader in(std::move(bytes));
  const std::vector<std::int64_t> classes = read_column(in, static_cast<std::size_t>(tile.objects));
  std::vector<CoarseObject> objects(classes.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (classes[i] < 0 || classes[i] >= static_cast<std::int64_t>(head.classes.size())) {
      throw Error("an object of no class");
    }
    const Shape shape = head.classes[static_cast<std::size_t>(classes[i])].shape;
    if (shape != Shape::cuboid && shape != Shape::cylinder) throw Error("an object of no shape");
    objects[i].object_class = classes[i];
  }
  take_places(in, tile, head.steps, objects);
  const std::vector<std::int64_t> probabilities = read_column(in, objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i].probability = probabilities[i];
  std::vector<CoarseObject*> alike;
  for (const Shape shape : {Shape::cuboid, Shape::cylinder}) {
    alike.clear();
    for (CoarseObject& object : objects) {
      const auto& object_class = head.classes[static_cast<std::size_t>(object.object_class)];
      if (object_class.shape == shape) alike.push_back(&object);
    }
    for (int i = 0; i < columns_of(shape); ++i) {
      const std::vector<std::int64_t> column = read_column(in, alike.size());
      for (std::size_t k = 0; k < alike.size(); ++k) {
        alike[k]->shape[static_cast<std::size_t>(i)] = column[k];
      }
    }
  }
  take_heights(in, head, objects);
  return objects;
}

double probability_of(const CoarseObject& object, const SmapSteps& steps) {
  // The step need not divide 1: the last one may lie beyond it.
  return std::min(1.0,
                  from_steps(object.probability, steps.probability, 0, 1 + steps.probability / 2));
}

Model model_of(const CoarseObject& object, Shape shape, const SmapSteps& steps) {
  const auto length = [](std::int64_t value, double step) {
    return from_steps(value, step, 0, kLargestObject_m);
  };
  const auto coordinate = [&](std::int64_t value) {
    return from_steps(value, steps.position_m, -kFarthest_m, kFarthest_m);
  };
  const Eigen::Vector3d at(coordinate(object.x), coordinate(object.y), coordinate(object.z));
  const auto& s = object.shape;
  if (shape == Shape::cuboid) {
    const double half = angle_of(s[3], steps) / 2;
    const Eigen::Quaterniond twist(std::cos(half), 0, 0, std::sin(half));
    const Eigen::Vector2d tilt(angle_of(s[4], steps), angle_of(s[5], steps));
    Cuboid cuboid;
    cuboid.pose.linear() = (tilted(tilt) * twist).toRotationMatrix();
    cuboid.pose.translation() = at;
    cuboid.size = {length(s[0], steps.size_m), length(s[1], steps.size_m),
                   length(s[2], steps.size_m)};
    return cuboid;
  }
  const Eigen::Vector2d tilt(angle_of(s[2], steps), angle_of(s[3], steps));
  return Cylinder{at, tilted(tilt) * Eigen::Vector3d::UnitZ(), length(s[0], steps.radius_m),
                  length(s[1], steps.size_m)};
}

}  // namespace saker::objects
