#pragma once

#include <cstdint>
#include <random>

namespace saker::core {

/// The only source of random numbers: the same seed gives the same numbers with every compiler and
/// library.
class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  /// An independent stream for part `index` of a job, whatever was drawn from this one before.
  [[nodiscard]] Rng fork(std::uint64_t index) const;

  [[nodiscard]] double uniform();                         ///< [0, 1)
  [[nodiscard]] double uniform(double low, double high);  ///< [low, high)
  [[nodiscard]] double normal();                          ///< mean 0, standard deviation 1
  [[nodiscard]] double normal(double mean, double sd);
  [[nodiscard]] int index(int count);  ///< 0 … count − 1, count > 0
  [[nodiscard]] bool chance(double probability);

 private:
  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace saker::core
