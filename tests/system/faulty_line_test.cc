#include "tools/saker/faults/faulty_line.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::tools {
namespace {

FaultSchedule one(FaultKind kind, double strength) {
  Fault fault;
  fault.kind = kind;
  fault.place = FaultPlace::state;
  fault.at_s = 10;
  fault.lasts_s = 10;
  fault.strength = strength;
  return {fault};
}

TEST(FaultyLine, WithoutAFaultAllComesAtOnceAndInOrder) {
  const FaultSchedule schedule;
  FaultyLine<int> line(schedule, FaultPlace::state);
  line.put(1, 1);
  line.put(1, 2);
  EXPECT_EQ(line.take(1), (std::vector<int>{1, 2}));
  EXPECT_TRUE(line.take(2).empty());
}

TEST(FaultyLine, AllIsLostWhileEverythingIsLost) {
  const FaultSchedule schedule = one(FaultKind::lose, 1);
  FaultyLine<int> line(schedule, FaultPlace::state);
  line.put(9, 1);
  line.put(11, 2);
  line.put(20, 3);
  EXPECT_EQ(line.take(30), (std::vector<int>{1, 3}));
}

TEST(FaultyLine, AShareIsLost) {
  const FaultSchedule schedule = one(FaultKind::lose, 0.3);
  FaultyLine<int> line(schedule, FaultPlace::state);
  for (int i = 0; i < 1000; ++i) line.put(15, i);
  EXPECT_NEAR(static_cast<double>(line.take(15).size()), 700, 50);
}

TEST(FaultyLine, AnotherChannelLosesNothing) {
  const FaultSchedule schedule = one(FaultKind::lose, 1);
  FaultyLine<int> line(schedule, FaultPlace::verdict);
  line.put(15, 1);
  EXPECT_EQ(line.take(15).size(), 1U);
}

TEST(FaultyLine, WhatIsLateComesLaterAndBehindWhatWasSentAfterIt) {
  const FaultSchedule schedule = one(FaultKind::delay, 0.5);
  FaultyLine<int> line(schedule, FaultPlace::state);
  line.put(19.8, 1);
  EXPECT_TRUE(line.take(19.8).empty());
  line.put(20.1, 2);
  EXPECT_EQ(line.take(20.1), (std::vector<int>{2}));
  EXPECT_EQ(line.take(20.3), (std::vector<int>{1}));
}

TEST(FaultyLine, WhatIsRepeatedComesTwice) {
  const FaultSchedule schedule = one(FaultKind::repeat, 1);
  FaultyLine<int> line(schedule, FaultPlace::state);
  line.put(15, 1);
  EXPECT_EQ(line.take(15.01), (std::vector<int>{1, 1}));
}

}  // namespace
}  // namespace saker::tools
