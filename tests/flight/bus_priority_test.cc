#include <gtest/gtest.h>

#include <thread>

#include "flight/bus/priority.h"

namespace saker::flight {
namespace {

struct Schedule {
  int policy = -1;
  int priority = -1;
};

Schedule mine() {
  Schedule schedule;
  sched_param parameters{};
  pthread_getschedparam(pthread_self(), &schedule.policy, &parameters);
  schedule.priority = parameters.sched_priority;
  return schedule;
}

TEST(BusPriority, AThreadMadeMeanwhileKeepsItAndTheMakerDoesNot) {
  const Schedule before = mine();
  Schedule made;
  bool granted = false;
  {
    const RaisedPriority raised(3);
    granted = raised.granted();
    std::thread([&made] { made = mine(); }).join();
  }
  EXPECT_EQ(mine().policy, before.policy);
  EXPECT_EQ(mine().priority, before.priority);
  if (!granted) GTEST_SKIP() << "real-time priorities are not allowed here";
  EXPECT_EQ(made.policy, SCHED_FIFO);
  EXPECT_EQ(made.priority, 3);
}

TEST(BusPriority, APriorityThatIsNoneIsRefusedWithALine) {
  EXPECT_NE(take_priority(1000), "");
  EXPECT_FALSE(RaisedPriority(1000).granted());
}

}  // namespace
}  // namespace saker::flight
