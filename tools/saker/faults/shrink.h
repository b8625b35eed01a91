#pragma once

#include <functional>

#include "tools/saker/faults/fault.h"

namespace saker::tools {

/// The fewest and shortest faults that still break what the whole schedule broke: each fault is
/// left out in turn, then each that is left is made shorter and weaker by halves. Greedy, as
/// Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input", TSE 2002, with
/// subsets of one: schedules are short.
/// \param breaks  whether a schedule breaks it; called `most_calls` times at most
[[nodiscard]] FaultSchedule shrunk(FaultSchedule schedule,
                                   const std::function<bool(const FaultSchedule&)>& breaks,
                                   int most_calls);

}  // namespace saker::tools
