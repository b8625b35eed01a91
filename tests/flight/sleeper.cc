#include <charconv>
#include <csignal>
#include <cstring>
#include <iostream>
#include <thread>

#include "flight/executive/loop.h"
#include "flight/process/loop_report.h"

namespace {

volatile std::sig_atomic_t stopped = 0;

}  // namespace

/// What the machine alone makes late: loops of the rate and priority of guidance and safety that
/// only sleep.
///   sleeper SECONDS FILE
/// For so long, or until SIGTERM. Leaves loops.json in FILE, as saker-flight does. Status 2: no
/// real-time priority, or usage.
int main(int argc, char** argv) {
  using namespace saker::flight;
  int seconds = 0;
  if (argc != 3 ||
      std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), seconds).ec != std::errc()) {
    std::cerr << "sleeper SECONDS FILE" << std::endl;
    return 2;
  }
  std::signal(SIGTERM, [](int) { stopped = 1; });
  (void)lock_memory();
  const auto nothing = [] { return LoopStatus{}; };
  Loop guidance("guidance", 50, 65, nothing), safety("safety", 50, 70, nothing);
  for (Loop* loop : {&guidance, &safety}) {
    loop->start();
    if (loop->priority_granted()) continue;
    std::cerr << "sleeper: no real-time priority (limit rtprio)" << std::endl;
    return 2;
  }
  const auto begin = Loop::Steady::now();
  while (!stopped && Loop::Steady::now() - begin < std::chrono::seconds(seconds))
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  for (Loop* loop : {&guidance, &safety}) loop->stop();
  const double slept_s = std::chrono::duration<double>(Loop::Steady::now() - begin).count();
  write_loops(argv[2], slept_s, process_seconds(),
              {{guidance.name(), guidance.totals()}, {safety.name(), safety.totals()}});
  return 0;
}
