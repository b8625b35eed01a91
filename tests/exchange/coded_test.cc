#include "saker/exchange/coded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "saker/core/rng.h"

namespace saker::exchange {
namespace {

/// Two kinds of messages, each of three numbers.
struct CodedMessage {
  bool far = false;
  std::int64_t x = 0;
  std::uint8_t kind = 0;
  std::uint64_t count = 0;
};

CodedMessage some_message(core::Rng& rng) {
  const bool far = rng.chance(0.5);
  return {far, std::lround(rng.normal(0, far ? 1e6 : 3)),
          static_cast<std::uint8_t>(rng.chance(0.9) ? 7 : rng.index(256)),
          static_cast<std::uint64_t>(rng.index(3))};
}

std::string coded(const CodedMessage& message, Statistics& statistics) {
  CodedWriter out(statistics);
  out.part(message.far ? 1 : 0);
  out.signed_varint(message.x);
  out.byte(message.kind);
  out.varint(message.count);
  return out.finish();
}

TEST(Coded, MessageAfterMessageIsReadAsItWasWritten) {
  core::Rng rng(1);
  Statistics writers, readers;
  for (int i = 0; i < 20'000; ++i) {
    const CodedMessage message = some_message(rng);
    const std::string bytes = coded(message, writers);
    CodedReader in(bytes, readers);
    in.part(message.far ? 1 : 0);
    ASSERT_EQ(in.signed_varint(), message.x) << i;
    ASSERT_EQ(in.byte(), message.kind) << i;
    ASSERT_EQ(in.varint(), message.count) << i;
    ASSERT_TRUE(in.done()) << i;
  }
}

TEST(Coded, TheGreatestAndTheLeastNumbersAreReadAsTheyWereWritten) {
  Statistics writers, readers;
  CodedWriter out(writers);
  const std::vector<std::int64_t> extremes = {0, -1, 1, INT64_MAX, INT64_MIN, 127, -64, 64};
  for (const std::int64_t value : extremes) out.signed_varint(value);
  out.varint(UINT64_MAX);
  const std::string bytes = out.finish();
  CodedReader in(bytes, readers);
  for (const std::int64_t value : extremes) EXPECT_EQ(in.signed_varint(), value);
  EXPECT_EQ(in.varint(), UINT64_MAX);
  EXPECT_TRUE(in.done());
}

/// A coin that falls on one side nine times of ten tells 0.469 bit (Shannon's entropy).
TEST(Coded, WhatIsUsualCostsLittleMoreThanItTells) {
  core::Rng rng(2);
  Statistics statistics;
  CodedWriter out(statistics);
  constexpr int kThrows = 50'000;
  for (int i = 0; i < kThrows; ++i) {
    out.part(0);
    out.byte(rng.chance(0.9) ? 1 : 0);
  }
  const double bits = 8.0 * static_cast<double>(out.finish().size()) / kThrows;
  EXPECT_GT(bits, 0.469);
  EXPECT_LT(bits, 0.56);
}

TEST(Coded, AMessageThatIsCutFailsOrIsNotDone) {
  Statistics writers;
  CodedWriter out(writers);
  for (int i = 0; i < 40; ++i) out.varint(static_cast<std::uint64_t>(1000 * i));
  const std::string whole = out.finish();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Statistics readers;
    CodedReader in(std::string_view(whole).substr(0, size), readers);
    for (int i = 0; i < 40; ++i) (void)in.varint();
    EXPECT_FALSE(in.done()) << size;
  }
}

TEST(Coded, ReadingPastTheEndFails) {
  core::Rng rng(3);
  for (int round = 0; round < 1000; ++round) {
    std::string bytes(static_cast<std::size_t>(rng.index(30)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(rng.index(256));
    Statistics statistics;
    CodedReader in(bytes, statistics);
    int numbers = 0;
    while (!in.failed() && numbers < 1000) {
      (void)in.varint();
      ++numbers;
    }
    EXPECT_TRUE(in.failed());
  }
}

}  // namespace
}  // namespace saker::exchange
