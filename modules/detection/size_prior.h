#pragma once

#include <array>
#include <string>
#include <vector>

#include "saker/objects/class_table.h"

/// Sizes of vehicles by kind: what is known of a vehicle before it is seen.
///
/// They are those of the class table (objects/class_table.h). Some are no vehicle but what is as
/// long or as wide as a truck and no higher than a car: two cars behind each other, or a car and a
/// bush beside it.
namespace saker::detection {

struct Normal {
  double mean = 0;  ///< m
  double sd = 0;    ///< m
};

struct VehicleKind {
  std::string name;
  double weight = 0;           ///< of all vehicles
  std::array<Normal, 2> plan;  ///< length, width
  Normal height;
  bool one_vehicle = true;  ///< false: what is to be split
};

using VehicleKinds = std::vector<VehicleKind>;

/// Those of all cuboid classes; where none has kinds, those of shipped vehicles. Throws Error on
/// one without mean and standard deviation of each size.
[[nodiscard]] VehicleKinds vehicle_kinds(const objects::ClassTable& table);

/// Whether some kind of vehicle is as long and wide as was measured, within `most_sd` standard
/// deviations of the kind and of the measurement together.
[[nodiscard]] bool is_of_some_kind(const std::array<Normal, 2>& plan, double most_sd,
                                   const VehicleKinds& kinds);

/// Log-likelihood of the highest points of a vehicle of that kind. They lie at its top or, of a
/// higher one, where points end (censored: Tobin, Econometrica 1958), or, rarely, anywhere below:
/// something hides it.
/// \param top      m above the ground
/// \param highest  m, above which points are not kept
/// \param noise    m, standard deviation of `top`
[[nodiscard]] double log_likelihood_of_top(double top, const VehicleKind& kind, double highest,
                                           double noise);

}  // namespace saker::detection
