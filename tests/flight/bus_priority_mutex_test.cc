#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "flight/bus/mailbox.h"
#include "flight/bus/priority.h"

namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kHeld{20};   // beyond the preemption, while the lock is held
constexpr milliseconds kBusy{400};  // of the one between, which wants no lock
constexpr milliseconds kPatient{150};

void spin(milliseconds time) {
  for (const auto end = Steady::now() + time; Steady::now() < end;) {
  }
}

void stay_on_one_processor() {
  cpu_set_t all, one;
  sched_getaffinity(0, sizeof all, &all);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &all)) continue;
    CPU_SET(cpu, &one);
    break;
  }
  sched_setaffinity(0, sizeof one, &one);
}

struct Inversion {
  std::atomic<bool> held = false;  // by the ordinary thread
  std::atomic<bool> busy = false;  // the one between, which preempts it

  /// However slow the machine is, the one between comes while the lock is held.
  void hold() {
    held = true;
    while (!busy) {
    }
    spin(kHeld);
  }
};

/// On one processor: an ordinary thread takes what another of priority 10 then wants, and is
/// preempted by a busy one of priority 5. How long the one of priority 10 waits.
template <class Hold, class Want>
Steady::duration waited(const Hold& hold, const Want& want, Inversion& inversion) {
  auto& [held, busy] = inversion;
  Steady::duration longest{};
  std::thread low([&] {
    stay_on_one_processor();
    hold();
  });
  std::atomic<bool> ready = false;
  std::thread high([&] {
    EXPECT_EQ(take_priority(10), "");
    stay_on_one_processor();
    ready = true;
    while (!busy) std::this_thread::sleep_for(milliseconds(1));
    const auto begin = Steady::now();
    want();
    longest = Steady::now() - begin;
  });
  while (!held || !ready) std::this_thread::sleep_for(milliseconds(1));
  std::thread middle([&] {
    EXPECT_EQ(take_priority(5), "");
    stay_on_one_processor();
    busy = true;
    spin(kBusy);
  });
  for (std::thread* thread : {&low, &middle, &high}) thread->join();
  return longest;
}

template <class Mutex>
Steady::duration waited_for() {
  Mutex mutex;
  Inversion inversion;
  return waited(
      [&] {
        const std::lock_guard lock(mutex);
        inversion.hold();
      },
      [&] { const std::lock_guard lock(mutex); }, inversion);
}

/// A value whose copy takes long, and says that it is under way.
struct Slow {
  Inversion* inversion = nullptr;
  Slow() = default;
  explicit Slow(Inversion& its) : inversion(&its) {}
  Slow(const Slow&) = default;
  Slow& operator=(const Slow& other) {
    if (other.inversion != nullptr) other.inversion->hold();
    return *this;
  }
};

class BusPriorityMutex : public testing::Test {
 protected:
  void SetUp() override {
    const RaisedPriority raised(10);
    if (!raised.granted()) GTEST_SKIP() << "real-time priorities are not allowed here";
  }
};

TEST_F(BusPriorityMutex, APlainOneWaitsForWhoeverIsBusyBetween) {
  EXPECT_GT(waited_for<std::mutex>(), kPatient);
}

TEST_F(BusPriorityMutex, WaitsForItsHolderAlone) {
  EXPECT_LT(waited_for<PriorityMutex>(), kPatient);
}

TEST_F(BusPriorityMutex, SoDoesWhoReadsAValue) {
  ValueBox<Slow> box;
  Inversion inversion;
  box.put(Slow());
  EXPECT_LT(waited([&] { box.put(Slow(inversion)); }, [&] { (void)box.latest(); }, inversion),
            kPatient);
}

TEST_F(BusPriorityMutex, IsLockedOnceAtATime) {
  PriorityMutex mutex;
  const std::lock_guard lock(mutex);
  std::thread([&] { EXPECT_FALSE(mutex.try_lock()); }).join();
}

}  // namespace
}  // namespace saker::flight
