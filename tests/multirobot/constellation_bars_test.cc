/// The bars of aligning maps with unknown take-off poses, on all seeds; prints the figures.
#include <gtest/gtest.h>

#include <cstdio>

#include "made_maps.h"

namespace saker::multirobot {
namespace {

using namespace slam;
using namespace made;

constexpr double kRadian = std::numbers::pi / 180;

/// Largest shift that a wrong transform gives to an object of b, and the turn.
struct Error {
  double place_m, turn_deg;
};

Error error(const PairOfMaps& maps, const SE3& T_a_b) {
  Error worst{0, 0};
  for (const auto& object : maps.b.map.objects) {
    const Eigen::Vector3d place = objects::place(object.model);
    worst.place_m = std::max(worst.place_m, (T_a_b * place - maps.T_a_b * place).norm());
  }
  worst.turn_deg = core::so3_log(maps.T_a_b.linear().transpose() * T_a_b.linear()).norm() / kRadian;
  return worst;
}

TEST(ConstellationBars, MapsThatShareFortyPercentAlign) {
  int aligned = 0, wrong = 0;
  double worst_place = 0, worst_turn = 0, least_evidence = 1e9;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const PairOfMaps maps = overlapping(seed);
    const Alignment found = align(maps.a, maps.b, {});
    const auto [place_m, turn_deg] = error(maps, found.T_a_b.pose);
    const bool right = place_m < 0.3 && turn_deg < 1;
    if (found.status != AlignmentStatus::accepted) {
      std::printf("seed %d: %s, %s, wrong with %.1e, %zu matches, odds %.1f and %.1f\n",
                  static_cast<int>(seed), to_string(found.status).c_str(),
                  right ? "right" : "wrong", found.probability_wrong, found.matches.size(),
                  found.evidence, found.next_evidence);
      continue;
    }
    least_evidence = std::min(least_evidence, found.evidence - std::max(0.0, found.next_evidence));
    worst_place = std::max(worst_place, place_m);
    worst_turn = std::max(worst_turn, turn_deg);
    ++(right ? aligned : wrong);
  }
  std::printf(
      "of 100: %d within 0.3 m and 1 degree, %d accepted beyond; worst %.3f m, %.3f degree; "
      "least margin of log odds %.1f\n",
      aligned, wrong, worst_place, worst_turn, least_evidence);
  EXPECT_GE(aligned, 95);
  EXPECT_EQ(wrong, 0);
}

class Apart : public testing::TestWithParam<int> {};

TEST_P(Apart, MapsOfTwoTownsAreNeverAligned) {
  int accepted = 0, searched = 0;
  double highest = -1e9, least_wrong = 1;
  for (int i = 0; i < 125; ++i) {
    const PairOfMaps maps = apart(static_cast<std::uint64_t>(125 * GetParam() + i));
    const Alignment found = align(maps.a, maps.b, {});
    accepted += found.status == AlignmentStatus::accepted ? 1 : 0;
    searched += found.status != AlignmentStatus::too_large ? 1 : 0;
    highest = std::max(highest, found.evidence);
    least_wrong = std::min(least_wrong, found.probability_wrong);
  }
  std::printf(
      "of 125: %d accepted, %d searched to the end; highest log odds %.1f, least "
      "probability of being wrong %.2e\n",
      accepted, searched, highest, least_wrong);
  EXPECT_EQ(accepted, 0);
}
INSTANTIATE_TEST_SUITE_P(ConstellationBars, Apart, testing::Range(0, 8));

}  // namespace
}  // namespace saker::multirobot
