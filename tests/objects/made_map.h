#pragma once

#include <vector>

#include "saker/core/rng.h"
#include "saker/objects/object_map.h"
#include "saker/simulation/world/terrain.h"

/// A large made map: what is measured about `.smap` is measured on it.
namespace saker::objects::made {

/// Rough ground: waves of 25 to 90 m with an sd of 1.5 m, of 2.5 to 9 m with one of 5 cm: slopes of
/// 21 % (root mean square).
[[nodiscard]] simulation::Terrain rough_ground(core::Rng& rng);

/// Places in a square, each at least `distance` m from every other, as many as find room: Bridson,
/// "Fast Poisson Disk Sampling in Arbitrary Dimensions", SIGGRAPH 2007. At 5 m a place has
/// some 41 m².
[[nodiscard]] std::vector<Eigen::Vector2d> poisson_disk(double edge, double distance,
                                                        core::Rng& rng);

/// `count` objects 5 m from each other on rough ground: half vehicles, at any heading and tilted
/// with the ground, a quarter trunks and a quarter poles, all with the sizes that the simulator
/// draws; with class probabilities from 0.5 to 1. Without covariances.
[[nodiscard]] ObjectMap large_map(int count, std::uint64_t seed);

}  // namespace saker::objects::made
