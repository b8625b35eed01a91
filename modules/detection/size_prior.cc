#include "saker/detection/size_prior.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

constexpr std::array<VehicleKind, 9> kKinds = {{
    {"small car", 0.21, {{{3.85, 0.25}, {1.69, 0.06}}}, {1.48, 0.06}},
    {"medium car", 0.21, {{{4.35, 0.20}, {1.79, 0.05}}}, {1.47, 0.05}},
    {"large car", 0.12, {{{4.80, 0.20}, {1.85, 0.05}}}, {1.46, 0.05}},
    {"suv", 0.21, {{{4.60, 0.25}, {1.87, 0.07}}}, {1.70, 0.08}},
    {"van", 0.08, {{{5.10, 0.50}, {1.96, 0.10}}}, {2.05, 0.25}},
    {"truck", 0.05, {{{7.00, 1.50}, {2.40, 0.20}}}, {3.00, 0.40}},
    {"bus", 0.03, {{{12.0, 1.20}, {2.55, 0.05}}}, {3.10, 0.20}},
    {"two cars", 0.05, {{{9.20, 1.00}, {1.85, 0.10}}}, {1.55, 0.13}, false},
    {"car and more beside it", 0.04, {{{4.60, 0.60}, {2.90, 0.60}}}, {1.60, 0.20}, false},
}};

}  // namespace

std::span<const VehicleKind> vehicle_kinds() { return kKinds; }

bool is_of_some_kind(const std::array<Normal, 2>& plan, double most_sd) {
  const auto fits = [&](const Normal& measured, const Normal& kind) {
    return std::abs(measured.mean - kind.mean) < most_sd * std::hypot(measured.sd, kind.sd);
  };
  return std::ranges::any_of(vehicle_kinds(), [&](const VehicleKind& kind) {
    return kind.one_vehicle && fits(plan[0], kind.plan[0]) && fits(plan[1], kind.plan[1]);
  });
}

double log_likelihood_of_top(double top, const VehicleKind& kind, double highest, double noise) {
  const auto normal = [](double off, double sd) {
    return std::exp(-0.5 * off * off / (sd * sd)) / (sd * std::sqrt(2 * M_PI));
  };
  const auto cumulative = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  const double sd = std::hypot(kind.height.sd, noise);
  const double at_limit = cumulative((kind.height.mean - highest) / kind.height.sd);
  const double seen = normal(top - kind.height.mean, sd) * cumulative((highest - top) / noise) +
                      at_limit * normal(top - highest, noise);
  const double height = std::min(kind.height.mean, highest);
  const double below = top < height ? 1 / height : 0;
  constexpr double kHidden = 0.02, kLeast = 1e-9;
  return std::log((1 - kHidden) * seen + kHidden * below + kLeast);
}

}  // namespace saker::detection
