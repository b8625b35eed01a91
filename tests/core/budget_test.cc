#include "saker/core/budget.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace saker::core {
namespace {

using namespace std::chrono_literals;

TEST(Budget, OfIterationsIsUsedUpByThemAlone) {
  const Budget budget = Budget::iterations(3);
  EXPECT_EQ(budget.most_iterations(), 3);
  EXPECT_FALSE(budget.used_up(0));
  EXPECT_FALSE(budget.used_up(2));
  EXPECT_TRUE(budget.used_up(3));
  EXPECT_TRUE(budget.used_up(4));
  EXPECT_TRUE(std::isinf(budget.seconds_left())) << "in lockstep no clock is read";
}

TEST(Budget, OfNoIterationsIsUsedUpAtOnce) { EXPECT_TRUE(Budget::iterations(0).used_up(0)); }

TEST(Budget, WhoseDeadlineHasPassedIsUsedUpWhateverWasDone) {
  const Budget budget = Budget::until(Budget::Clock::now() - 1ms, 1000);
  EXPECT_TRUE(budget.used_up(0));
  EXPECT_LE(budget.seconds_left(), 0);
}

TEST(Budget, WithADeadlineEndsAtItsIterationsToo) {
  const Budget budget = Budget::until(Budget::Clock::now() + 1h, 5);
  EXPECT_FALSE(budget.used_up(4));
  EXPECT_TRUE(budget.used_up(5));
}

TEST(Budget, SecondsLeftAreThoseToTheDeadline) {
  const Budget budget = Budget::until(Budget::Clock::now() + 1h, 5);
  EXPECT_GT(budget.seconds_left(), 3500);
  EXPECT_LE(budget.seconds_left(), 3600);
}

TEST(Budget, SecondsLeftOnlyBecomeFewer) {
  const Budget budget = Budget::until(Budget::Clock::now() + 1h, 5);
  const double first = budget.seconds_left();
  EXPECT_LE(budget.seconds_left(), first);
}

}  // namespace
}  // namespace saker::core
