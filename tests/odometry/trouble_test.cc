#include "trouble.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>

namespace saker::odometry {
namespace {

using testing::Outcome;
using testing::Trouble;

struct Kind {
  Trouble trouble;
  bool with_imu;

  friend std::ostream& operator<<(std::ostream& out, const Kind& kind) {
    return out << to_string(kind.trouble) << (kind.with_imu ? ", IMU" : "");
  }
};

constexpr double kMost_m = 0.3, kMostUnsaid_s = 0.2, kMostDeviation_sd = 5, kMostRecovery_s = 3;

/// Two seeds of each kind; SAKER_TROUBLE_SEEDS=200 flies more, and says what came of them.
int seeds() {
  const char* said = std::getenv("SAKER_TROUBLE_SEEDS");
  return said == nullptr ? 2 : std::atoi(said);
}

void print(const Kind& kind, const std::vector<Outcome>& outcomes) {
  const auto count = [&](auto fails) {
    return std::count_if(outcomes.begin(), outcomes.end(), fails);
  };
  double nees = 0, worst_m = 0;
  int nees_count = 0, clean = 0, clean_good = 0;
  for (const Outcome& o : outcomes) {
    nees += o.nees_sum;
    nees_count += o.nees_count;
    clean += o.clean;
    clean_good += o.clean_good;
    worst_m = std::max(worst_m, o.worst_good_m);
  }
  fmt::print(
      "{:11} {:3} {:3} flights: {} off with status ok, {} beyond 5 sd, {} slow; clean scans ok "
      "{:.4f}, NEES {:.2f}; worst {:.2f} m\n",
      to_string(kind.trouble), kind.with_imu ? "IMU" : "", outcomes.size(),
      count(
          [](const Outcome& o) { return o.worst_good_m > kMost_m && o.unsaid_s > kMostUnsaid_s; }),
      count([](const Outcome& o) { return o.worst_deviation_sd > kMostDeviation_sd; }),
      count([](const Outcome& o) { return o.recovered_s > kMostRecovery_s; }),
      static_cast<double>(clean_good) / clean, nees / std::max(nees_count, 1), worst_m);
}

std::vector<Outcome> flown(const Kind& kind) {
  std::vector<Outcome> outcomes;
  for (int seed = 0; seed < seeds(); ++seed)
    outcomes.push_back(
        testing::fly({kind.trouble, static_cast<std::uint64_t>(seed), kind.with_imu}, {}));
  if (std::getenv("SAKER_TROUBLE_SEEDS") != nullptr) print(kind, outcomes);
  return outcomes;
}

class InTrouble : public ::testing::TestWithParam<Kind> {};

TEST_P(InTrouble, APoseIsRightOrItsStatusSaysSo) {
  for (const Outcome& o : flown(GetParam())) {
    EXPECT_TRUE(o.worst_good_m <= kMost_m || o.unsaid_s <= kMostUnsaid_s) << o.worst_good_m;
    EXPECT_LE(o.worst_deviation_sd, kMostDeviation_sd);
    EXPECT_LE(o.recovered_s, kMostRecovery_s);
    EXPECT_GE(o.clean_good, 0.99 * o.clean);
  }
}

INSTANTIATE_TEST_SUITE_P(WithImu, InTrouble,
                         ::testing::Values(Kind{Trouble::none, true}, Kind{Trouble::gap, true},
                                           Kind{Trouble::covered, true}, Kind{Trouble::half, true},
                                           Kind{Trouble::kidnapped, true},
                                           Kind{Trouble::late, true}));
INSTANTIATE_TEST_SUITE_P(WithoutImu, InTrouble,
                         ::testing::Values(Kind{Trouble::none, false}, Kind{Trouble::late, false}));

/// Without an inertial unit seconds leave tens of metres open: it finds itself in its own map.
class FoundAgain : public ::testing::TestWithParam<Kind> {};

TEST_P(FoundAgain, WhereItIsOrItsStatusSaysThatItIsNot) {
  for (const Outcome& o : flown(GetParam())) {
    EXPECT_TRUE(o.worst_good_m <= kMost_m || o.unsaid_s <= kMostUnsaid_s) << o.worst_good_m;
    EXPECT_LE(o.worst_deviation_sd, kMostDeviation_sd);
    EXPECT_LE(o.recovered_s, kMostRecovery_s);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FoundAgain,
                         ::testing::Values(Kind{Trouble::gap, false},
                                           Kind{Trouble::covered, false}));

/// What odometry without an inertial unit does not always state to 5 sd.
class BeyondIt : public ::testing::TestWithParam<Kind> {};

TEST_P(BeyondIt, GoesOnAndIsGoodAgain) {
  for (const Outcome& o : flown(GetParam())) EXPECT_LE(o.recovered_s, kMostRecovery_s);
}

class AlongSmoothWalls : public ::testing::TestWithParam<Kind> {};

TEST_P(AlongSmoothWalls, TheStatusSaysThatNothingHoldsThePose) {
  for (const Outcome& o : flown(GetParam())) {
    EXPECT_TRUE(o.worst_good_m <= kMost_m || o.unsaid_s <= kMostUnsaid_s) << o.worst_good_m;
    EXPECT_LE(o.worst_deviation_sd, kMostDeviation_sd);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AlongSmoothWalls,
                         ::testing::Values(Kind{Trouble::featureless, true},
                                           Kind{Trouble::featureless, false}));

INSTANTIATE_TEST_SUITE_P(Kinds, BeyondIt,
                         ::testing::Values(Kind{Trouble::half, false},
                                           Kind{Trouble::kidnapped, false}));

}  // namespace
}  // namespace saker::odometry
