#include "flight/executive/health_counters.h"

#include "saker/health_t.hpp"

namespace saker::flight {

std::vector<counter_t> health_counters(const HealthFigures& figures) {
  std::vector<counter_t> counters;
  for (const Counters* group : {&figures.faults, &figures.orders, &figures.sensor, &figures.drops,
                                &figures.exchange, &figures.team}) {
    for (const auto& [name, value] : *group) {
      if (counters.size() == health_t::MAX_COUNTERS) return counters;
      if (group == &figures.drops && value == 0) continue;
      counter_t& counter = counters.emplace_back();
      counter.name = name;
      counter.value = value;
    }
  }
  return counters;
}

}  // namespace saker::flight
