#include "flight/executive/health_counters.h"

#include "flight/bus/counter.h"
#include "saker/health_t.hpp"

namespace saker::flight {

std::vector<counter_t> health_counters(const HealthFigures& figures) {
  std::vector<counter_t> counters;
  for (const Counters* group : {&figures.faults, &figures.orders, &figures.sensor, &figures.drops,
                                &figures.exchange, &figures.team}) {
    for (const auto& [name, value] : *group) {
      if (counters.size() == health_t::MAX_COUNTERS) return counters;
      if (group == &figures.drops && value == 0) continue;
      counters.push_back(counter(name, value));
    }
  }
  return counters;
}

}  // namespace saker::flight
