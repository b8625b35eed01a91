#include <gtest/gtest.h>

#include "made_flight.h"
#include "saker/active/active.h"
#include "saker/core/error.h"

/// What `make_policy` refuses.
namespace saker::active {
namespace {

using made::everywhere;

const objects::ClassTable kTable;

TEST(Policy, ConfigurationThatCannotBeIsRefused) {
  const ActiveConfig valid{.policy = PolicyName::visit};
  EXPECT_NO_THROW((void)make_policy(valid, kTable, {}, everywhere));
  ActiveConfig crowded = valid;
  crowded.visit_policy.sides = 3;  // and 120° apart: the third may find no room
  EXPECT_THROW((void)make_policy(crowded, kTable, {}, everywhere), Error);
  ActiveConfig hasty = valid;
  hasty.goals.standing_s = hasty.visit_policy.dwell_s;
  EXPECT_THROW((void)make_policy(hasty, kTable, {}, everywhere), Error);
  ActiveConfig blind = valid;
  blind.view.nearest_m = blind.view.farthest_m;
  EXPECT_THROW((void)make_policy(blind, kTable, {}, everywhere), Error);
  ActiveConfig out_of_bounds = valid;
  out_of_bounds.viewpoints.bearings = 0;
  EXPECT_THROW((void)make_policy(out_of_bounds, kTable, {}, everywhere), Error);
}

TEST(Policy, ByInformationGainIsRefusedWithoutAModelOrWithOneThatLacksATargetClass) {
  ActiveConfig config;
  for (const PolicyName policy : {PolicyName::paper, PolicyName::saker}) {
    config.policy = policy;
    EXPECT_THROW((void)make_policy(config, kTable, {}, everywhere), Error);
    const auto ignorant = std::make_shared<const uncertainty::Model>();
    EXPECT_THROW((void)make_policy(config, kTable, {}, everywhere, ignorant), Error);
  }
}

TEST(Policy, ThatWouldNeverLookIsRefused) {
  ActiveConfig config{.policy = PolicyName::visit};
  config.paper.enough_entropy = 0;
  EXPECT_THROW((void)make_policy(config, kTable, {}, everywhere), Error);
}

}  // namespace
}  // namespace saker::active
