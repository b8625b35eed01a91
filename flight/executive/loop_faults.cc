#include "flight/executive/loop_faults.h"

#include <spdlog/spdlog.h>

#include <chrono>

namespace saker::flight {
namespace {

constexpr std::chrono::seconds kAgain{10};  // the same exception is said

}  // namespace

void LoopFaultLog::say(const Loops& loops, Loop::Steady::time_point now) {
  said_.resize(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    say_hang(*loops[i], now, said_[i]);
    say_throws(*loops[i], now, said_[i]);
  }
}

void LoopFaultLog::say_hang(const Loop& loop, Loop::Steady::time_point now, Said& said) {
  const bool hangs = loop.hangs(now);
  if (hangs == std::exchange(said.hangs, hangs)) return;
  if (hangs) {
    spdlog::critical("{} hangs: its run does not end", loop.name());
  } else {
    spdlog::warn("{} runs again", loop.name());
  }
}

void LoopFaultLog::say_throws(const Loop& loop, Loop::Steady::time_point now, Said& said) {
  const LoopFaults faults = loop.faults();
  if (faults.throws == said.throws) return;
  if (faults.last != said.what || now - said.at >= kAgain) {
    spdlog::error("{} threw, {} times so far: {}", loop.name(), faults.throws, faults.last);
    said.what = faults.last;
    said.at = now;
  }
  said.throws = faults.throws;
  if (faults.off && !std::exchange(said.off, true))
    spdlog::critical("{} is switched off: it threw again and again", loop.name());
}

std::vector<std::pair<std::string, long>> LoopFaultLog::counters(const Loops& loops,
                                                                 Loop::Steady::time_point now) {
  std::vector<std::pair<std::string, long>> counters;
  for (const auto& loop : loops) {
    const LoopFaults faults = loop->faults();
    if (faults.throws > 0) counters.emplace_back(loop->name() + "_threw", faults.throws);
    if (faults.off) counters.emplace_back(loop->name() + "_off", 1);
    if (loop->hangs(now)) counters.emplace_back(loop->name() + "_hangs", 1);
  }
  return counters;
}

}  // namespace saker::flight
