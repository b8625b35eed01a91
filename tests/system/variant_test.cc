#include "tools/saker/experiment/variant.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

TEST(Variant, IsANameAndItsSettings) {
  const Variant sides = variant_of("sides active.policy=visit  active.visit.sides=2");
  EXPECT_EQ(sides.name, "sides");
  EXPECT_EQ(sides.settings,
            (std::vector<std::string>{"active.policy=visit", "active.visit.sides=2"}));
}

TEST(Variant, OfAPolicyChangesThePolicyAlone) {
  EXPECT_EQ(policy_variant("paper").name, "paper");
  EXPECT_EQ(policy_variant("paper").settings, std::vector<std::string>{"active.policy=paper"});
}

TEST(Variant, WithoutANameThatAFolderMayHaveIsRefused) {
  for (const char* text : {"", "  ", "../out a.b=1", "active.policy=visit"}) {
    EXPECT_THROW((void)variant_of(text), Error) << text;
  }
}

}  // namespace
}  // namespace saker::tools
