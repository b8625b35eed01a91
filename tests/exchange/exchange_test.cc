#include "saker/exchange/exchange.h"

#include <gtest/gtest.h>

#include "two_ends.h"

namespace saker::exchange {
namespace {

const StreamId kFlight{"R1", StreamKind::history, 1};
const StreamId kOther{"R2", StreamKind::history, 4};
const StreamId kPrior{"BASE", StreamKind::prior_map, 1};
constexpr std::size_t kPackedFlight = 190'000;  // of ten minutes

void expect_same_bytes(TwoEnds& ends) {
  ASSERT_EQ(ends.robot.store().extents().size(), ends.base.store().extents().size());
  for (const auto& [id, extent] : ends.robot.store().extents()) {
    EXPECT_EQ(ends.robot.store().bytes(id), ends.base.store().bytes(id)) << to_string(id);
  }
}

/// Of all bytes that both ends sent to those that had to cross.
double ratio(const TwoEnds& ends, std::size_t bytes) {
  return static_cast<double>(ends.robot.sent_bytes() + ends.base.sent_bytes()) /
         static_cast<double>(bytes);
}

TEST(Exchange, BothEndsHoldTheSameAfterwards) {
  TwoEnds ends(test_folder(), {.loss = 0, .repeated = 0, .jitter_s = 0}, 1);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(kPackedFlight, 1)));
  ASSERT_TRUE(ends.base.store().append(kOther, some_bytes(30'000, 2)));
  ASSERT_TRUE(ends.base.store().append(kPrior, some_bytes(5'000, 3)));
  EXPECT_LT(ends.run(20), 5);
  expect_same_bytes(ends);
  EXPECT_EQ(ends.robot.store().size(kPrior), 5'000u);
  EXPECT_LT(ratio(ends, kPackedFlight + 35'000), 1.1);
}

/// The bar: 30 % lost in both directions, repeated and reordered, five kills of either end.
TEST(Exchange, ReachesEqualityUnderLossAndKillsForLessThanOnePointEightTimesTheBytes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TwoEnds ends(test_folder(), {}, seed);
    const std::string flight = some_bytes(kPackedFlight, seed);
    ASSERT_TRUE(ends.robot.store().append(kFlight, flight));
    core::Rng rng(100 + seed);
    for (int kill = 0; kill < 10; ++kill) {
      const int steps = rng.index(40);
      for (int i = 0; i < steps; ++i) ends.step();
      (kill % 2 == 0 ? ends.robot : ends.base).kill_and_start();
    }
    ASSERT_FALSE(ends.equal()) << "the kills came too late to test anything";
    const double took = ends.run(60);
    ASSERT_LT(took, 60) << "seed " << seed;
    EXPECT_EQ(ends.base.store().bytes(kFlight), flight);
    EXPECT_EQ(ends.robot.store().bytes(kFlight), flight);
    EXPECT_LT(ratio(ends, kPackedFlight), 1.8);
    std::printf("seed %d: %.3f times the bytes, %ld chunks sent, %ld repeated, %.1f s\n",
                static_cast<int>(seed), ratio(ends, kPackedFlight), ends.robot.chunks_sent(),
                ends.base.chunks_repeated(), took);
  }
}

TEST(Exchange, WithoutLossNoChunkIsSentTwice) {
  TwoEnds ends(test_folder(), {.loss = 0, .repeated = 0.2}, 2);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(100 * kChunkBytes, 1)));
  ends.run(20);
  EXPECT_EQ(ends.robot.chunks_sent(), 100);
  EXPECT_EQ(ends.base.chunks_repeated(), 0);
}

TEST(Exchange, UnderLossHardlyAnyChunkArrivesTwice) {
  TwoEnds ends(test_folder(), {}, 3);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(200 * kChunkBytes, 1)));
  ends.run(60);
  EXPECT_LE(ends.base.chunks_repeated(), 4);
  EXPECT_LT(ends.robot.chunks_sent(), 330);
}

TEST(Exchange, OnlyTheNewEndOfAStreamThatGrewIsSent) {
  TwoEnds ends(test_folder(), {.loss = 0, .repeated = 0}, 1);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(10'500, 1)));
  ends.run(20);
  const long before = ends.robot.sent_bytes();
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(300, 2)));
  ends.run(20);
  expect_same_bytes(ends);
  EXPECT_EQ(ends.base.store().size(kFlight), 10'800u);
  EXPECT_LT(ends.robot.sent_bytes() - before, 600);
}

TEST(Exchange, GrowsWithAFlightThatGoesOn) {
  TwoEnds ends(test_folder(), {}, 4);
  for (int entry = 0; entry < 200; ++entry) {
    ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(300, entry)));
    for (int i = 0; i < 10; ++i) ends.step();
  }
  ends.run(60);
  expect_same_bytes(ends);
  EXPECT_EQ(ends.base.store().size(kFlight), 60'000u);
}

TEST(Exchange, NothingIsSentAgainAfterARestartOfBothWhenAllIsThere) {
  TwoEnds ends(test_folder(), {}, 5);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(50'000, 1)));
  ends.run(60);
  const long sent = ends.robot.chunks_sent();
  ends.robot.kill_and_start();
  ends.base.kill_and_start();
  EXPECT_LT(ends.run(60), 60);
  EXPECT_EQ(ends.robot.chunks_sent(), sent);
}

TEST(Exchange, GoesOnInTheNextContact) {
  TwoEnds ends(test_folder(), {}, 6);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(kPackedFlight, 1)));
  const auto received = [&] { return ends.base.exchange().counters().peers.chunks_received; };
  for (int i = 0; i < 1000 && received() < 20; ++i) ends.step();
  ends.in_reach = false;
  for (int i = 0; i < 2000; ++i) ends.step();
  EXPECT_FALSE(ends.robot.exchange().contacts(ends.now).front().in_contact);
  EXPECT_GE(received(), 20);
  EXPECT_LT(ends.base.store().size(kFlight), kPackedFlight);
  ends.in_reach = true;
  EXPECT_LT(ends.run(60), 60);
  expect_same_bytes(ends);
}

TEST(Exchange, OutOfReachCostsLessThanAHundredBytesASecond) {
  TwoEnds ends(test_folder(), {}, 7);
  ends.in_reach = false;
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(kPackedFlight, 1)));
  for (int i = 0; i < 6000; ++i) ends.step();
  EXPECT_LT(ends.robot.sent_bytes(), 60 * 100);
  EXPECT_EQ(ends.base.sent_bytes(), 0);
}

TEST(Exchange, KeepsToItsRate) {
  PeerConfig config;
  config.rate_kb_s = 20;
  TwoEnds ends(test_folder(), {.loss = 0, .repeated = 0}, 8, config);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(kPackedFlight, 1)));
  for (int i = 0; i < 500; ++i) ends.step();
  EXPECT_LT(ends.robot.sent_bytes(), 5 * 20'000 + 2'000 + 1'200);
  EXPECT_GT(ends.robot.sent_bytes(), 5 * 20'000 / 2);
}

TEST(Exchange, KeepsToItsBudgetInAContactAndHasANewOneInTheNext) {
  PeerConfig config;
  config.budget_kb = 50;
  TwoEnds ends(test_folder(), {.loss = 0, .repeated = 0}, 9, config);
  ASSERT_TRUE(ends.robot.store().append(kFlight, some_bytes(80'000, 1)));
  ends.run(9);
  EXPECT_LE(ends.robot.sent_bytes(), 50'000 + 1'200);
  EXPECT_FALSE(ends.equal());
  ends.run(60);
  expect_same_bytes(ends);
}

TEST(Exchange, DifferentBytesUnderOneNameAreNotMixed) {
  TwoEnds ends(test_folder(), {}, 10);
  const std::string here = some_bytes(50'000, 1), there = some_bytes(20'000, 2);
  ASSERT_TRUE(ends.robot.store().append(kFlight, here));
  ASSERT_TRUE(ends.base.store().append(kFlight, there));
  ends.run(5);
  EXPECT_EQ(ends.robot.store().bytes(kFlight), here);
  EXPECT_EQ(ends.base.store().bytes(kFlight), there);
  EXPECT_EQ(ends.robot.exchange().counters().peers.conflicts, 1);
}

TEST(Exchange, ASecondCounterpartOnTheChannelIsAStrangerAsLongAsTheFirstIsHeard) {
  const auto folder = test_folder();
  TwoEnds ends(folder, {.loss = 0}, 11);
  MemoryStore empty;
  Exchange second({}, "BASE2", test_key(), folder / "second", empty);
  second.add_link("R1_EXCHANGE", Role::calls);
  const auto counterpart = [&] { return ends.robot.exchange().contacts(ends.now).front(); };
  const auto second_calls = [&] {
    const auto datagram = second.next(ends.now);
    ASSERT_TRUE(datagram);
    ends.robot.exchange().receive(ends.now, "R1_EXCHANGE", datagram->bytes);
  };
  while (!counterpart().in_contact) ends.step();  // `run` ends at once: the stores are empty
  second_calls();
  EXPECT_EQ(ends.robot.exchange().counters().strangers, 1);
  EXPECT_EQ(counterpart().counterpart, "BASE");
  ends.in_reach = false;
  while (counterpart().in_contact) ends.step();
  second_calls();
  EXPECT_EQ(ends.robot.exchange().counters().strangers, 1);
  EXPECT_EQ(counterpart().counterpart, "BASE2");
}

/// A store whose disk is full.
class FullStore : public MemoryStore {
 protected:
  bool keep(const StreamId&, int, std::size_t, std::string_view) override { return false; }
};

TEST(Exchange, ACounterpartWhoseDiskIsFullIsNotFlooded) {
  const auto folder = test_folder();
  FullStore full;
  MemoryStore store;
  ASSERT_TRUE(store.append(kFlight, some_bytes(kPackedFlight, 1)));
  Exchange robot({}, "R1", test_key(), folder / "robot", store);
  Exchange base({}, "BASE", test_key(), folder / "base", full);
  robot.add_link("R1_EXCHANGE", Role::calls);
  base.add_link("R1_EXCHANGE", Role::answers);
  for (Time now = from_seconds(1); now < from_seconds(26); now += from_seconds(0.01)) {
    while (const auto d = robot.next(now)) base.receive(now, d->channel, d->bytes);
    while (const auto d = base.next(now)) robot.receive(now, d->channel, d->bytes);
  }
  EXPECT_EQ(robot.counters().peers.chunks_sent, 64);  // one round
  EXPECT_EQ(base.counters().peers.refused, 64);
}

TEST(Exchange, HealthNamesFitTheirMessage) {
  const auto folder = test_folder();
  MemoryStore store;
  const Exchange exchange({}, "R1", test_key(), folder, store);
  for (const auto& [name, value] : health(exchange)) {
    EXPECT_LE(name.size(), 24u) << name;
    EXPECT_EQ(value, 0) << name;
  }
}

}  // namespace
}  // namespace saker::exchange
