#include "tools/saker/mission/team_division.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saker/autonomy/team_map.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::tools {
namespace {

using Places = std::vector<Eigen::Vector3d>;

const DivisionConfig kByWork{.by_work = true};

/// Targets of each lot.
std::vector<Places> parts(const Places& targets, const std::vector<std::vector<double>>& lots) {
  std::vector<Places> all(lots.size());
  for (std::size_t i = 0; i < lots.size(); ++i) {
    const autonomy::Lot lot(lots[i]);
    std::ranges::copy_if(targets, std::back_inserter(all[i]),
                         [&](const Eigen::Vector3d& p) { return lot.contains(p); });
  }
  return all;
}

double longest(const Places& targets, const Places& takeoffs,
               const std::vector<std::vector<double>>& lots) {
  double most = 0;
  const std::vector<Places> own = parts(targets, lots);
  for (std::size_t i = 0; i < own.size(); ++i) {
    most = std::max(most, expected_work_m(own[i], takeoffs[i], kByWork));
  }
  return most;
}

Places anywhere(int count, std::uint64_t seed) {
  core::Rng rng(seed);
  Places places;
  for (int i = 0; i < count; ++i) places.emplace_back(rng.uniform(-50, 50), rng.uniform(4, 20), 0);
  return places;
}

TEST(ExpectedWork, IsTheWayThereAndBackAndALookAtEach) {
  const Places targets = {{10, 0, 0}, {20, 0, 0}};
  EXPECT_DOUBLE_EQ(expected_work_m(targets, {0, 0, 0}, {.by_work = true, .target_m = 3}), 46);
}

TEST(DividedLots, HoldEveryTargetOnceAndNoneIsEmpty) {
  const Places takeoffs = {{-5, 0, 0}, {0, 0, 0}, {5, 0, 0}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Places targets = anywhere(12, seed);
    std::size_t sum = 0;
    for (const Places& own : parts(targets, divided_lots(targets, takeoffs, kByWork))) {
      EXPECT_FALSE(own.empty());
      sum += own.size();
    }
    EXPECT_EQ(sum, targets.size());
  }
}

TEST(DividedLots, NoOtherBordersMakeTheLongestFlightShorter) {
  const Places takeoffs = {{-5, 0, 0}, {5, 0, 0}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Places targets = anywhere(9, seed);
    const double best = longest(targets, takeoffs, divided_lots(targets, takeoffs, kByWork));
    std::ranges::sort(targets, {}, [](const Eigen::Vector3d& p) { return p.x(); });
    for (auto cut = targets.begin() + 1; cut != targets.end(); ++cut) {
      const double west = expected_work_m({targets.begin(), cut}, takeoffs[0], kByWork);
      const double east = expected_work_m({cut, targets.end()}, takeoffs[1], kByWork);
      EXPECT_LE(best, std::max(west, east) + 1e-9);
    }
  }
}

TEST(DividedLots, BelongToTheRobotsInTheOrderOfTheirTakeOffs) {
  const Places targets = {{-20, 5, 0}, {20, 5, 0}};
  const auto lots = divided_lots(targets, {{3, 0, 0}, {-3, 0, 0}}, kByWork);
  EXPECT_TRUE(autonomy::Lot(lots[0]).contains(targets[1]));
  EXPECT_TRUE(autonomy::Lot(lots[1]).contains(targets[0]));
}

TEST(DividedLots, OfFewerTargetsThanRobotsAreRefused) {
  EXPECT_THROW((void)divided_lots({{1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, kByWork), Error);
}

}  // namespace
}  // namespace saker::tools
