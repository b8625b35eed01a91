#include "saker/core/rng.h"

#include <cmath>
#include <numbers>

namespace saker::core {
namespace {

/// SplitMix64 (Steele et al., OOPSLA 2014): spreads neighbouring seeds over all bits.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

}  // namespace

Rng::Rng(std::uint64_t seed) : seed_(seed), engine_(mix(seed)) {}

Rng Rng::fork(std::uint64_t index) const { return Rng(mix(seed_) ^ mix(index + 1)); }

double Rng::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Rng::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));  // Box–Muller; 1 − u is never 0
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

double Rng::normal(double mean, double sd) { return mean + sd * normal(); }

int Rng::index(int count) { return static_cast<int>(uniform() * count); }

bool Rng::chance(double probability) { return uniform() < probability; }

}  // namespace saker::core
