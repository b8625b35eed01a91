#pragma once

#include <array>
#include <span>
#include <string_view>

/// Sizes of vehicles by kind: what is known of a vehicle before it is seen.
///
/// Small, medium and large cars are segments B, C and D to E of the European Commission's market
/// definition; the others are sport utility vehicles, vans and pickups, rigid trucks, buses. Means
/// and standard deviations are those of makers' published dimensions without mirrors; weights are
/// rough shares of parked vehicles. The last two are no vehicle but what is as long or as wide as a
/// truck and no higher than a car: two cars behind each other, or a car and a bush beside it.
namespace saker::detection {

struct Normal {
  double mean = 0;  ///< m
  double sd = 0;    ///< m
};

struct VehicleKind {
  std::string_view name;
  double weight;               ///< of all vehicles
  std::array<Normal, 2> plan;  ///< length, width
  Normal height;
  bool one_vehicle = true;  ///< false: what is to be split
};

[[nodiscard]] std::span<const VehicleKind> vehicle_kinds();

/// Whether some kind of vehicle is as long and wide as was measured, within `most_sd` standard
/// deviations of the kind and of the measurement together.
[[nodiscard]] bool is_of_some_kind(const std::array<Normal, 2>& plan, double most_sd);

/// Log-likelihood of the highest points of a vehicle of that kind. They lie at its top or, of a
/// higher one, where points end (censored: Tobin, Econometrica 1958), or, rarely, anywhere below:
/// something hides it.
/// \param top      m above the ground
/// \param highest  m, above which points are not kept
/// \param noise    m, standard deviation of `top`
[[nodiscard]] double log_likelihood_of_top(double top, const VehicleKind& kind, double highest,
                                           double noise);

}  // namespace saker::detection
