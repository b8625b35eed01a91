#pragma once

#include "flight/bus/channels.h"
#include "saker/active/plan.h"

namespace saker::flight {

/// The viewpoints of a plan for PLAN: those that may be flown to and the chosen one first, then of
/// the refused ones as many as still fit, evenly chosen; sets `choice`.
void write_candidates(const active::ActivePlan& plan, plan_t& message);

}  // namespace saker::flight
