#include "saker/detection/size_prior.h"

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"

namespace saker::detection {
namespace {

Normal normal_of(const std::vector<double>& mean_and_sd, const std::string& name) {
  if (mean_and_sd.size() != 2) {
    throw Error("objects.classes, kind \"" + name + "\": " + std::to_string(mean_and_sd.size()) +
                " numbers for a size, expected mean and standard deviation");
  }
  return {mean_and_sd[0], mean_and_sd[1]};
}

void append_cuboids(const std::vector<objects::ObjectClass>& classes, VehicleKinds& kinds) {
  for (const objects::ObjectClass& c : classes) {
    if (c.shape != objects::Shape::cuboid) continue;
    for (const objects::ObjectKind& kind : c.kinds) {
      kinds.push_back({kind.name,
                       kind.share,
                       {normal_of(kind.length_m, kind.name), normal_of(kind.width_m, kind.name)},
                       normal_of(kind.height_m, kind.name),
                       kind.single});
    }
  }
}

}  // namespace

VehicleKinds vehicle_kinds(const objects::ClassTable& table) {
  VehicleKinds kinds;
  append_cuboids(table.classes, kinds);
  if (kinds.empty()) append_cuboids(objects::shipped_classes(), kinds);
  return kinds;
}

bool is_of_some_kind(const std::array<Normal, 2>& plan, double most_sd, const VehicleKinds& kinds) {
  const auto fits = [&](const Normal& measured, const Normal& kind) {
    return std::abs(measured.mean - kind.mean) < most_sd * std::hypot(measured.sd, kind.sd);
  };
  return std::ranges::any_of(kinds, [&](const VehicleKind& kind) {
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
