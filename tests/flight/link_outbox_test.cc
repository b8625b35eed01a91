#include <gtest/gtest.h>

#include <tuple>

#include "flight/link/fragments.h"
#include "flight/link/outbox.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using Steady = Outbox::Steady;

const std::vector<LinkedChannel> kChannels = {
    {"_STATE", 10, 1}, {"_TRAJECTORY", 1, 1}, {"_EXCHANGE", 1000, 4}};

class AnOutbox : public testing::Test {
 protected:
  /// What goes out in this moment.
  std::vector<Fragment> sent(int at_ms) {
    std::vector<Fragment> pieces;
    while (const auto piece = outbox.next(begin + milliseconds(at_ms)))
      pieces.push_back(fragment_of(*piece).value());
    return pieces;
  }

  Outbox outbox{kChannels, 500};
  const Steady::time_point begin = Steady::now();
};

TEST_F(AnOutbox, SendsTheNewestOfAChannelAtItsRate) {
  std::vector<std::string> said;
  for (int i = 0; i < 100; ++i) {  // 100 Hz for a second
    outbox.put("_STATE", std::to_string(i));
    for (const Fragment& piece : sent(10 * i)) said.push_back(piece.bytes);
  }
  ASSERT_GE(said.size(), 10u);
  ASSERT_LE(said.size(), 12u);
  EXPECT_EQ(said[1], "10");
  EXPECT_GE(outbox.counters().replaced, 87);
}

TEST_F(AnOutbox, KeepsAsManyAsItsChannelSaysAndDropsTheOldest) {
  for (int i = 0; i < 10; ++i) outbox.put("_EXCHANGE", std::to_string(i));
  std::string said;
  for (int ms = 0; ms < 10; ++ms)
    for (const Fragment& piece : sent(ms)) said += piece.bytes;
  EXPECT_EQ(said, "6789");
  EXPECT_EQ(outbox.counters().replaced, 6);
}

TEST_F(AnOutbox, CutsALargeMessageAndLetsOthersPassBetween) {
  outbox.put("_TRAJECTORY", std::string(20 * kFragmentBytes + 1, 't'));
  outbox.put("_STATE", "s");
  const std::vector<Fragment> pieces = sent(0);
  ASSERT_GE(pieces.size(), 2u);
  EXPECT_TRUE(pieces[0].channel == "_STATE" || pieces[1].channel == "_STATE");
  EXPECT_EQ(pieces.back().count, 21);
}

TEST_F(AnOutbox, KeepsToTheRateOfTheLink) {
  long bytes = 0;
  for (int ms = 0; ms <= 1000; ++ms) {
    outbox.put("_TRAJECTORY", std::string(200'000, 't'));
    for (const LinkedChannel& channel : kChannels) outbox.put(channel.channel, "x");
    for (const Fragment& piece : sent(ms)) bytes += static_cast<long>(piece.bytes.size());
  }
  EXPECT_LT(bytes, 512'000);
}

TEST_F(AnOutbox, IsAskedAgainWhenSomethingIsDueAndNotBefore) {
  EXPECT_EQ(outbox.next_due(), Steady::time_point::max());
  outbox.put("_STATE", "a");
  EXPECT_LE(outbox.next_due(), begin);
  (void)sent(0);
  EXPECT_EQ(outbox.next_due(), Steady::time_point::max());
  outbox.put("_STATE", "b");
  EXPECT_GT(outbox.next_due(), begin + milliseconds(75));
  EXPECT_LE(outbox.next_due(), begin + milliseconds(100));
}

TEST_F(AnOutbox, WaitsForTheRateAfterALargeBurst) {
  outbox.put("_TRAJECTORY", std::string(100'000, 't'));
  (void)sent(0);
  EXPECT_GT(outbox.next_due(), begin);
  EXPECT_LT(outbox.next_due(), begin + milliseconds(10));
}

TEST_F(AnOutbox, ForgetsEventsAndPartsButNoNewestValue) {
  outbox.put("_EXCHANGE", "an event");
  outbox.put("_TRAJECTORY", std::string(100'000, 't'));
  (void)outbox.next(begin);
  (void)outbox.next(begin);
  outbox.put("_EXCHANGE", "another");
  outbox.put("_STATE", "the newest");
  outbox.forget_events();
  const std::vector<Fragment> pieces = sent(1000);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].bytes, "the newest");
}

/// A message of `count` pieces; piece k is the digit k.
Fragment piece_of(std::uint32_t number, int index, int count) {
  return {"_STATE", number, static_cast<std::uint16_t>(index), static_cast<std::uint16_t>(count),
          std::to_string(index)};
}

TEST(AFragment, ComesOutAsItWentIn) {
  const Fragment in{"_TRAJECTORY", 77, 3, 9, std::string("a\0b", 3)};
  const Fragment out = fragment_of(to_bytes(in)).value();
  EXPECT_EQ(std::tie(out.channel, out.number, out.index, out.count, out.bytes),
            std::tie(in.channel, in.number, in.index, in.count, in.bytes));
}

TEST(AFragment, CutOrContradictoryIsNone) {
  const std::string whole = to_bytes(Fragment{"_STATE", 1, 0, 1, ""});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(fragment_of(whole.substr(0, size))) << size;
  EXPECT_FALSE(fragment_of(to_bytes(piece_of(1, 2, 2))));
  EXPECT_FALSE(fragment_of(to_bytes(piece_of(1, 0, 0))));
}

TEST(AJoiner, PutsPiecesTogetherInAnyOrderAndOnce) {
  FragmentJoiner joiner(false);
  for (const int index : {2, 0, 2}) EXPECT_FALSE(joiner.add(piece_of(1, index, 3)));
  EXPECT_EQ(joiner.add(piece_of(1, 1, 3)), "012");
  for (const int index : {0, 1, 2}) EXPECT_FALSE(joiner.add(piece_of(1, index, 3)));
}

TEST(AJoiner, GivesUpAnOlderMessageForANewerOne) {
  FragmentJoiner joiner(false);
  EXPECT_FALSE(joiner.add(piece_of(1, 0, 2)));
  EXPECT_EQ(joiner.add(piece_of(2, 0, 1)), "0");
  EXPECT_FALSE(joiner.add(piece_of(1, 1, 2)));
  EXPECT_EQ(joiner.incomplete(), 2);
}

TEST(AJoiner, TakesNoPieceThatContradictsTheOthers) {
  FragmentJoiner joiner(false);
  EXPECT_FALSE(joiner.add(piece_of(1, 0, 2)));
  EXPECT_FALSE(joiner.add(piece_of(1, 2, 3)));
  EXPECT_EQ(joiner.add(piece_of(1, 1, 2)), "01");
}

TEST(AJoiner, OfEventsTakesEachInWhateverOrder) {
  FragmentJoiner joiner(true);
  EXPECT_EQ(joiner.add(piece_of(2, 0, 1)), "0");
  EXPECT_EQ(joiner.add(piece_of(1, 0, 1)), "0");
}

}  // namespace
}  // namespace saker::flight
