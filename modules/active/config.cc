#include "saker/active/config.h"

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"

namespace saker::active {
namespace {

void check_pams(const PamsConfig& pams, const GoalsConfig& goals, const std::string& name) {
  const double prior = 2 * std::log(pams.prior_place_m) + std::log(pams.prior_length_m) +
                       std::log(pams.prior_width_m);
  if (pams.enough_entropy >= prior) {
    throw Error("active." + name + ".enough_entropy: " + std::to_string(pams.enough_entropy) +
                ", expected less than the prior's " + std::to_string(prior) +
                ", or nothing is ever looked at");
  }
  if (goals.standing_s <= 2 * pams.dwell_s) {
    throw Error("active.goals.standing_s: " + std::to_string(goals.standing_s) +
                ", expected more than two dwells (active." + name +
                ".dwell_s), or no view ever counts");
  }
}

}  // namespace

ActiveConfig checked(const ActiveConfig& config) {
  const ActiveConfig valid = core::checked(config, "active");
  const VisitConfig& visit = valid.visit_policy;
  const int sides = std::max({visit.sides, valid.paper.search.sides, valid.saker.search.sides});
  if (sides > 1 && visit.separation_deg > 180.0 / (sides - 1)) {
    throw Error("active.visit.separation_deg: " + std::to_string(visit.separation_deg) +
                ", expected at most 180 / (sides - 1), or a side may find no room");
  }
  const double dwell_s =
      std::max({visit.dwell_s, valid.paper.search.dwell_s, valid.saker.search.dwell_s});
  if (valid.goals.standing_s <= 2 * dwell_s) {
    throw Error("active.goals.standing_s: " + std::to_string(valid.goals.standing_s) +
                ", expected more than two dwells of a side, or none is ever seen");
  }
  const FieldOfViewConfig& view = valid.view;
  if (view.nearest_m >= view.farthest_m) {
    throw Error("active.view.nearest_m: " + std::to_string(view.nearest_m) +
                ", expected less than farthest_m");
  }
  check_pams(valid.paper, valid.goals, "paper");
  check_pams(valid.saker, valid.goals, "saker");
  return valid;
}

}  // namespace saker::active
