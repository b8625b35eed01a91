#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "saker/core/error.h"
#include "tools/saker/faults/fault.h"

namespace saker::tools {
namespace {

constexpr double kSeconds = 90;

std::vector<Fault> many(int schedules) {
  std::vector<Fault> all;
  for (int seed = 0; seed < schedules; ++seed) {
    core::Rng rng(static_cast<std::uint64_t>(seed));
    const FaultSchedule drawn = draw_faults(rng, kSeconds);
    all.insert(all.end(), drawn.begin(), drawn.end());
  }
  return all;
}

Fault lost_verdicts(double at_s, double lasts_s, double share) {
  Fault fault;
  fault.kind = FaultKind::lose;
  fault.place = FaultPlace::verdict;
  fault.at_s = at_s;
  fault.lasts_s = lasts_s;
  fault.strength = share;
  return fault;
}

TEST(FaultSchedule, EveryKindIsDrawnFiftyTimesInAThousand) {
  std::map<FaultKind, int> drawn;
  for (const Fault& fault : many(1000)) ++drawn[fault.kind];
  for (const FaultKindInfo& info : fault_kinds()) EXPECT_GE(drawn[info.kind], 50) << info.name;
}

TEST(FaultSchedule, EveryPlaceOfAKindIsDrawn) {
  std::set<std::pair<FaultKind, FaultPlace>> drawn;
  for (const Fault& fault : many(4000)) drawn.emplace(fault.kind, fault.place);
  for (const FaultKindInfo& info : fault_kinds()) {
    for (const FaultPlace place : info.places) {
      EXPECT_TRUE(drawn.contains({info.kind, place})) << info.name << " " << to_string(place);
    }
  }
}

TEST(FaultSchedule, WhatIsDrawnLiesWithinItsKind) {
  for (const Fault& fault : many(1000)) {
    const FaultKindInfo& info = fault_kinds()[static_cast<std::size_t>(fault.kind)];
    ASSERT_EQ(info.kind, fault.kind);
    EXPECT_GE(std::abs(fault.strength), info.least) << info.name;
    EXPECT_LE(std::abs(fault.strength), info.most) << info.name;
    EXPECT_TRUE(info.either_sign || fault.strength >= 0) << info.name;
    EXPECT_GE(fault.at_s, 0);
    EXPECT_LT(fault.at_s, kSeconds);
    if (std::isinf(fault.lasts_s)) {
      EXPECT_TRUE(info.may_stay) << info.name;
    } else {
      EXPECT_LE(fault.lasts_s, info.longest_s * (1 + 1e-9)) << info.name;
    }
  }
}

TEST(FaultSchedule, OneToThreeFaultsInTheOrderOfTime) {
  std::set<std::size_t> sizes;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    core::Rng rng(seed);
    const FaultSchedule drawn = draw_faults(rng, kSeconds);
    sizes.insert(drawn.size());
    EXPECT_TRUE(std::ranges::is_sorted(drawn, {}, &Fault::at_s));
  }
  EXPECT_EQ(sizes, (std::set<std::size_t>{1, 2, 3}));
}

TEST(FaultSchedule, AFileGivesItBackToTheBit) {
  core::Rng rng(7);
  for (int i = 0; i < 50; ++i) {
    const FaultSchedule drawn = draw_faults(rng, kSeconds);
    const auto text = to_json(drawn).dump();
    const FaultSchedule read = faults_from_json(nlohmann::ordered_json::parse(text), "file");
    ASSERT_EQ(read.size(), drawn.size());
    EXPECT_EQ(to_json(read).dump(), text);
    for (std::size_t k = 0; k < read.size(); ++k) {
      EXPECT_EQ(read[k].lasts_s, drawn[k].lasts_s);
      EXPECT_EQ(read[k].strength, drawn[k].strength);
    }
  }
}

TEST(FaultSchedule, AnUnknownKindIsNamed) {
  auto json = to_json({lost_verdicts(1, 2, 0.5)});
  json[0]["kind"] = "looses";
  try {
    (void)faults_from_json(json, "a.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.json: fault 1: kind \"looses\", expected a kind of fault");
  }
}

TEST(FaultSchedule, AKindHasItsOwnPlaces) {
  auto json = to_json({lost_verdicts(1, 2, 0.5)});
  json[0]["place"] = "planning";
  EXPECT_THROW((void)faults_from_json(json, "a.json"), Error);
  json[0]["place"] = "nowhere";
  EXPECT_THROW((void)faults_from_json(json, "a.json"), Error);
}

TEST(FaultSchedule, AMissingValueIsAnError) {
  auto json = to_json({lost_verdicts(1, 2, 0.5)});
  json[0].erase("at_s");
  EXPECT_THROW((void)faults_from_json(json, "a.json"), Error);
  EXPECT_THROW((void)faults_from_json(nlohmann::ordered_json::object(), "a.json"), Error);
}

TEST(FaultSchedule, AFaultActsFromItsBeginToBeforeItsEnd) {
  const FaultSchedule schedule = {lost_verdicts(10, 2, 0.5)};
  const auto acts = [&](double t_s) {
    return acting(schedule, FaultKind::lose, FaultPlace::verdict, t_s) != nullptr;
  };
  EXPECT_FALSE(acts(9.99));
  EXPECT_TRUE(acts(10));
  EXPECT_TRUE(acts(11.99));
  EXPECT_FALSE(acts(12));
}

TEST(FaultSchedule, TheStrongestActs) {
  const FaultSchedule schedule = {lost_verdicts(0, 10, 0.2), lost_verdicts(5, 10, 0.9)};
  EXPECT_EQ(acting(schedule, FaultKind::lose, FaultPlace::verdict, 1)->strength, 0.2);
  EXPECT_EQ(acting(schedule, FaultKind::lose, FaultPlace::verdict, 6)->strength, 0.9);
  EXPECT_EQ(acting(schedule, FaultKind::lose, FaultPlace::state, 6), nullptr);
}

TEST(FaultSchedule, AnOrderIsReadBackByItsWord) {
  Fault order;
  order.kind = FaultKind::order;
  order.place = FaultPlace::return_home;
  order.at_s = 5;
  order.lasts_s = 1;
  const auto json = to_json({order});
  EXPECT_EQ(json[0].at("place"), "return");
  EXPECT_EQ(faults_from_json(json, "a.json").front().place, FaultPlace::return_home);
}

TEST(FaultSchedule, ItIsSaidInWords) {
  EXPECT_EQ(text_of(lost_verdicts(12.25, 2, 0.4)),
            "lose verdict, 0.4 share from 12.25 s for 2.00 s");
  EXPECT_EQ(text_of(lost_verdicts(12.25, INFINITY, 1)), "lose verdict, 1 share from 12.25 s on");
}

}  // namespace
}  // namespace saker::tools
