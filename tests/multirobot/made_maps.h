#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "saker/core/rng.h"
#include "saker/multirobot/constellation.h"

/// Made quarters of a town, and the maps that robots make of parts of them: streets with parked
/// cars at irregular gaps, trees and light poles along the kerbs, parking rows that repeat every
/// 2.5 m, trees in the open. One row in five holds a fleet of equal cars.
namespace saker::multirobot::made {

struct MapNoise {
  double place_m = 0.1, size_m = 0.1, radius_m = 0.03, heading_deg = 2;
  double missed = 0.1, invented = 0.05;
};

class Town {
 public:
  /// \param half_length, half_width of the ground that is built on, m.
  Town(std::uint64_t seed, double half_length, double half_width)
      : rng_(seed), half_length_(half_length), half_width_(half_width) {
    phase_ = rng_.uniform(0, 6);
    for (double y = -half_width_ + rng_.uniform(2, 12); y < half_width_; y += rng_.uniform(24, 34))
      street(y, rng_.uniform(-0.1, 0.1));
    const int rows = 3 + rng_.index(4);
    for (int i = 0; i < rows; ++i) parking_row();
    for (int i = 0; i < half_length_ * half_width_ / 150; ++i)
      tree(rng_.uniform(-half_length_, half_length_), rng_.uniform(-half_width_, half_width_));
  }

  /// The map of a robot whose world frame is at `T_town_world`: what lies near its path, with
  /// noise.
  [[nodiscard]] Survey survey(const std::vector<Eigen::Vector3d>& path, const SE3& T_town_world,
                              std::uint64_t seed, const MapNoise& noise = {}) const {
    core::Rng rng(seed);
    Survey survey;
    const SE3 T_world_town = T_town_world.inverse();
    for (const Eigen::Vector3d& p : path) survey.path.push_back(T_world_town * p);
    for (const objects::MapObject& object : objects_) {
      if (!seen(objects::place(object.model), path, rng) || rng.chance(noise.missed)) continue;
      add(survey.map, measured(object, T_world_town, noise, rng));
    }
    const int invented = static_cast<int>(
        std::lround(noise.invented * static_cast<double>(survey.map.objects.size())));
    for (int i = 0; i < invented; ++i) {
      objects::MapObject copy = survey.map.objects[static_cast<std::size_t>(
          rng.index(static_cast<int>(survey.map.objects.size())))];
      SE3 elsewhere = SE3::Identity();
      elsewhere.translation() << rng.uniform(-30, 30), rng.uniform(-30, 30), 0;
      copy.model = objects::transformed(elsewhere, copy.model);
      add(survey.map, copy);
    }
    return survey;
  }

 private:
  [[nodiscard]] double ground(double x, double y) const {
    return 0.4 * std::sin(x / 25 + phase_) + 0.3 * std::cos(y / 30 + 2 * phase_) + 0.01 * x;
  }

  void add_car(double x, double y, double yaw, const Eigen::Vector3d& size) {
    objects::MapObject object;
    object.class_id = 1;
    if (rng_.chance(0.5)) yaw += std::numbers::pi;
    object.model = objects::Cuboid{pose(x, y, ground(x, y) + size.z() / 2, yaw), size};
    add_true(object);
  }

  void add_cylinder(objects::ClassId id, double x, double y, double radius) {
    objects::MapObject object;
    object.class_id = id;
    object.model = objects::Cylinder{{x, y, ground(x, y)}, Eigen::Vector3d::UnitZ(), radius, 3};
    add_true(object);
  }

  void tree(double x, double y) { add_cylinder(2, x, y, rng_.uniform(0.1, 0.3)); }

  [[nodiscard]] Eigen::Vector3d car_size() {
    return {std::clamp(rng_.normal(4.4, 0.35), 3.5, 5.4), rng_.normal(1.8, 0.08),
            rng_.normal(1.5, 0.12)};
  }

  /// Two kerbs 8 m apart; its heading is `slope` off the x axis.
  void street(double y0, double slope) {
    for (const double side : {-1.0, 1.0}) {
      for (double x = -half_length_; x < half_length_; x += 5.2 + rng_.uniform(0, 3)) {
        if (rng_.chance(0.4)) continue;
        add_car(x, y0 + slope * x + side * 3.2 + rng_.normal(0, 0.15), slope + rng_.normal(0, 0.03),
                car_size());
      }
      for (double x = -half_length_; x < half_length_; x += 8 + rng_.normal(0, 0.8))
        if (rng_.chance(0.7)) tree(x, y0 + slope * x + side * 5.5 + rng_.normal(0, 0.2));
      for (double x = -half_length_ + rng_.uniform(0, 25); x < half_length_; x += 25)
        add_cylinder(3, x, y0 + slope * x + side * 4.8, rng_.uniform(0.08, 0.12));
    }
  }

  void parking_row() {
    const double x0 = rng_.uniform(-half_length_, half_length_ - 15);
    const double y0 = rng_.uniform(-half_width_, half_width_);
    const double along = rng_.chance(0.7) ? 0 : std::numbers::pi / 2;
    const bool fleet = rng_.chance(0.2);
    const Eigen::Vector3d same = car_size();
    const double occupied = rng_.uniform(0.7, 1);
    const int slots = 8 + rng_.index(13);
    for (int i = 0; i < slots; ++i) {
      if (!rng_.chance(occupied)) continue;
      const double s = 2.5 * i;
      add_car(x0 + s * std::cos(along) + rng_.normal(0, 0.05),
              y0 + s * std::sin(along) + rng_.normal(0, 0.15), along + std::numbers::pi / 2,
              fleet ? same : car_size());
    }
  }

  /// Nothing stands in something else.
  void add_true(const objects::MapObject& object) {
    for (const objects::MapObject& other : objects_) {
      const bool cars = object.class_id == 1 && other.class_id == 1;
      const double gap =
          (objects::place(object.model) - objects::place(other.model)).head<2>().norm();
      if (gap < (cars ? 2.2 : 1.2)) return;
    }
    objects_.push_back(object);
  }

  /// For sure within 12 m of the path, half of them up to 16 m.
  [[nodiscard]] static bool seen(const Eigen::Vector3d& place,
                                 const std::vector<Eigen::Vector3d>& path, core::Rng& rng) {
    double nearest = 1e9;
    for (const Eigen::Vector3d& p : path) nearest = std::min(nearest, (p - place).head<2>().norm());
    return nearest < 12 || (nearest < 16 && rng.chance(0.5));
  }

  static SE3 pose(double x, double y, double z, double yaw) {
    SE3 T = SE3::Identity();
    T.linear() = core::so3_exp({0, 0, yaw});
    T.translation() << x, y, z;
    return T;
  }

  static void add(objects::ObjectMap& map, objects::MapObject object) {
    object.id = static_cast<int>(map.objects.size());
    map.objects.push_back(std::move(object));
  }

  static objects::MapObject measured(objects::MapObject object, const SE3& T_world_town,
                                     const MapNoise& noise, core::Rng& rng) {
    object.model = objects::transformed(T_world_town, object.model);
    const auto random = [&](double sd) {
      return Eigen::Vector3d(rng.normal(0, sd), rng.normal(0, sd), rng.normal(0, sd));
    };
    if (auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
      cuboid->pose.translation() += random(noise.place_m);
      const double turn = rng.normal(0, noise.heading_deg * std::numbers::pi / 180);
      cuboid->pose.linear() = cuboid->pose.linear() * core::so3_exp({0, 0, turn});
      cuboid->size += random(noise.size_m);
    } else {
      auto& cylinder = std::get<objects::Cylinder>(object.model);
      cylinder.root += random(noise.place_m);
      cylinder.radius = std::max(0.03, cylinder.radius + rng.normal(0, noise.radius_m));
    }
    return object;
  }

  core::Rng rng_;
  double half_length_, half_width_, phase_ = 0;
  std::vector<objects::MapObject> objects_;
};

/// A flight over a rectangle, to and fro, in the town's frame.
inline std::vector<Eigen::Vector3d> lawn_mower(double x0, double length, double width) {
  std::vector<Eigen::Vector3d> path;
  for (double y = -width / 2 + 10; y <= width / 2 - 9; y += 20) {
    for (double x = 10; x <= length - 10; x += 2) path.emplace_back(x0 + x, y, 3);
  }
  return path;
}

struct PairOfMaps {
  Survey a, b;
  SE3 T_a_b = SE3::Identity();  ///< true
};

constexpr double kLength = 83, kWidth = 60;  // of what a robot maps, m

inline SE3 frame(double x, double y, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp({0, 0, yaw});
  T.translation() << x, y, 1.5;
  return T;
}

/// Two maps whose robots took off 50 m apart, at any heading, and that share 40 % of their ground.
inline PairOfMaps overlapping(std::uint64_t seed) {
  const Town town(seed, 90, 45);
  core::Rng rng(seed + 1000000);
  const SE3 T_town_a = frame(-60, 0, rng.uniform(-3.1, 3.1));
  const SE3 T_town_b = frame(-10, 0, rng.uniform(-3.1, 3.1));
  return {town.survey(lawn_mower(-65, kLength, kWidth), T_town_a, 2 * seed),
          town.survey(lawn_mower(-15, kLength, kWidth), T_town_b, 2 * seed + 1),
          T_town_a.inverse() * T_town_b};
}

/// Maps of two towns.
inline PairOfMaps apart(std::uint64_t seed) {
  core::Rng rng(seed + 2000000);
  const auto survey = [&](std::uint64_t of) {
    return Town(of + 500000, 90, 45)
        .survey(lawn_mower(-40, kLength, kWidth), frame(0, 0, rng.uniform(-3.1, 3.1)), of);
  };
  return {survey(2 * seed), survey(2 * seed + 1)};
}

}  // namespace saker::multirobot::made
