#include "tools/saker/mission/team_link.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

exchange::StreamId history(const std::string& robot) {
  return {robot, exchange::StreamKind::history, 1};
}

std::string bytes(std::size_t count) {
  std::string text(count, ' ');
  for (std::size_t i = 0; i < count; ++i) text[i] = static_cast<char>(i * 7919 >> 3);
  return text;
}

TEST(TeamLink, BothEndsHoldWhatEitherHadThoughEveryThirdDatagramIsLost) {
  exchange::MemoryStore robot, base;
  ASSERT_TRUE(robot.append(history("R2"), bytes(40000)));
  ASSERT_TRUE(base.append(history("R1"), bytes(25000)));
  const ContactFigures figures = exchange_at_base({.loss = 0.3}, robot, base, core::Rng(1));
  EXPECT_TRUE(figures.complete);
  EXPECT_GT(figures.lost, 0);
  EXPECT_EQ(base.bytes(history("R2")), bytes(40000));
  EXPECT_EQ(robot.bytes(history("R1")), bytes(25000));
  EXPECT_GT(figures.bytes, 65000);
}

TEST(TeamLink, IsAFunctionOfItsSeed) {
  const auto run = [](std::uint64_t seed) {
    exchange::MemoryStore robot, base;
    EXPECT_TRUE(robot.append(history("R1"), bytes(60000)));
    return exchange_at_base({}, robot, base, core::Rng(seed));
  };
  EXPECT_EQ(run(3).bytes, run(3).bytes);
  EXPECT_EQ(run(3).lost, run(3).lost);
  EXPECT_NE(run(3).lost, run(4).lost);
}

TEST(TeamLink, AContactThatIsTooShortSaysSo) {
  exchange::MemoryStore robot, base;
  ASSERT_TRUE(robot.append(history("R1"), bytes(2'000'000)));
  const ContactFigures figures =
      exchange_at_base({.longest_contact_s = 3}, robot, base, core::Rng(1));
  EXPECT_FALSE(figures.complete);
  EXPECT_LT(base.size(history("R1")), 2'000'000u);
}

}  // namespace
}  // namespace saker::tools
