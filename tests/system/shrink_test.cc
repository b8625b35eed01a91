#include "tools/saker/faults/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace saker::tools {
namespace {

Fault fault(FaultKind kind, double lasts_s, double strength) {
  Fault made;
  made.kind = kind;
  made.lasts_s = lasts_s;
  made.strength = strength;
  return made;
}

const FaultSchedule kThree = {fault(FaultKind::rain, 8, 0.2), fault(FaultKind::gust, 4, 8),
                              fault(FaultKind::imu_bias, INFINITY, 1)};

bool has(const FaultSchedule& schedule, FaultKind kind) {
  return std::ranges::any_of(schedule, [&](const Fault& f) { return f.kind == kind; });
}

TEST(Shrink, WhatDoesNotMatterIsLeftOut) {
  const auto less = shrunk(
      kThree, [](const FaultSchedule& s) { return has(s, FaultKind::gust); }, 100);
  ASSERT_EQ(less.size(), 1U);
  EXPECT_EQ(less[0].kind, FaultKind::gust);
}

TEST(Shrink, TwoThatMatterTogetherStay) {
  const auto both = [](const FaultSchedule& s) {
    return has(s, FaultKind::gust) && has(s, FaultKind::imu_bias);
  };
  EXPECT_EQ(shrunk(kThree, both, 100).size(), 2U);
}

TEST(Shrink, ItGetsShorterAsLongAsItBreaks) {
  const auto long_gust = [](const FaultSchedule& s) {
    return has(s, FaultKind::gust) && s.front().lasts_s > 1.5;
  };
  const auto less = shrunk({kThree[1]}, long_gust, 100);
  EXPECT_EQ(less[0].lasts_s, 2);
}

TEST(Shrink, ItGetsWeakerAsLongAsItBreaks) {
  const auto strong = [](const FaultSchedule& s) { return s.front().strength >= 3; };
  EXPECT_EQ(shrunk({kThree[1]}, strong, 100)[0].strength, 4);
}

TEST(Shrink, AnEndlessOneGetsAnEnd) {
  const auto less = shrunk(
      {kThree[2]}, [](const FaultSchedule&) { return true; }, 100);
  EXPECT_TRUE(std::isfinite(less[0].lasts_s));
}

TEST(Shrink, WhatIsGivenBackBreaks) {
  const auto odd = [](const FaultSchedule& s) {
    return has(s, FaultKind::rain) && (s.size() > 1 || s[0].strength > 0.15);
  };
  EXPECT_TRUE(odd(shrunk(kThree, odd, 100)));
}

TEST(Shrink, ItAsksNoMoreOftenThanItMay) {
  int calls = 0;
  const auto counted = [&](const FaultSchedule&) {
    ++calls;
    return true;
  };
  (void)shrunk(kThree, counted, 5);
  EXPECT_EQ(calls, 5);
}

}  // namespace
}  // namespace saker::tools
