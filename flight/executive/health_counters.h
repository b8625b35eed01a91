#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "saker/counter_t.hpp"

namespace saker::flight {

/// Names and values, as the parts of the executive count.
using Counters = std::vector<std::pair<std::string, long>>;

/// What the executive counts, the most important first.
struct HealthFigures {
  Counters faults;    ///< of loops: few, and where they are many the others give way
  Counters orders;    ///< of an operator
  Counters sensor;    ///< what the gate refused: health_of, kMostSensor
  Counters drops;     ///< of queues and messages; told of where there are any
  Counters exchange;  ///< with the base
  Counters team;      ///< of the set-up

  /// All that was refused, and its three most frequent causes: so the team's figures have room,
  /// too.
  static constexpr std::size_t kMostSensor = 4;
};

/// For `_HEALTH`, which has room for health_t::MAX_COUNTERS: what comes last gives way.
[[nodiscard]] std::vector<counter_t> health_counters(const HealthFigures& figures);

}  // namespace saker::flight
