#include "saker/exchange/bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "saker/core/rng.h"

namespace saker::exchange {
namespace {

using namespace std::string_literals;

std::string varint(std::uint64_t value) {
  ByteWriter out;
  out.varint(value);
  return out.bytes();
}

std::string signed_varint(std::int64_t value) {
  ByteWriter out;
  out.signed_varint(value);
  return out.bytes();
}

/// The examples of DWARF 4 (7.6) and of Protocol Buffers' encoding.
TEST(Bytes, AreThoseOfTheStandards) {
  EXPECT_EQ(varint(2), "\x02"s);
  EXPECT_EQ(varint(127), "\x7F"s);
  EXPECT_EQ(varint(128), "\x80\x01"s);
  EXPECT_EQ(varint(12857), "\xB9\x64"s);
  EXPECT_EQ(signed_varint(-1), "\x01"s);
  EXPECT_EQ(signed_varint(1), "\x02"s);
  EXPECT_EQ(signed_varint(-2), "\x03"s);
}

TEST(Bytes, FixedNumbersAreLittleEndian) {
  ByteWriter out;
  out.fixed(std::uint32_t{0x01020304});
  out.fixed(std::uint16_t{0xABCD});
  EXPECT_EQ(out.bytes(), "\x04\x03\x02\x01\xCD\xAB"s);
}

TEST(Bytes, EveryNumberIsReadAsItWasWritten) {
  core::Rng rng(1);
  std::vector<std::int64_t> numbers = {0, 1, -1, 63, -64, 64, INT64_MAX, INT64_MIN};
  for (int i = 0; i < 1000; ++i) {
    numbers.push_back(static_cast<std::int64_t>(rng.normal() * std::exp2(rng.uniform(0, 60))));
  }
  ByteWriter out;
  for (const std::int64_t number : numbers) {
    out.signed_varint(number);
    out.varint(static_cast<std::uint64_t>(number));
    out.fixed(static_cast<std::uint64_t>(number));
  }
  ByteReader in(out.bytes());
  for (const std::int64_t number : numbers) {
    ASSERT_EQ(in.signed_varint(), number);
    ASSERT_EQ(in.varint(), static_cast<std::uint64_t>(number));
    ASSERT_EQ(in.fixed<std::uint64_t>(), static_cast<std::uint64_t>(number));
  }
  EXPECT_TRUE(in.done());
}

TEST(Bytes, TextsAreReadAsTheyWereWritten) {
  ByteWriter out;
  out.text("");
  out.text("a\0b"s);
  out.text(std::string(300, 'x'));
  out.raw("tail");
  ByteReader in(out.bytes());
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.text(), "a\0b"s);
  EXPECT_EQ(in.text(), std::string(300, 'x'));
  EXPECT_EQ(in.rest(), 4u);
  EXPECT_EQ(in.raw(4), "tail");
  EXPECT_TRUE(in.done());
}

TEST(Bytes, ReadingPastTheEndGivesZerosForGood) {
  ByteReader in("\x05");
  EXPECT_EQ(in.fixed<std::uint32_t>(), 5u);
  EXPECT_TRUE(in.failed());
  EXPECT_EQ(in.byte(), 0);
  EXPECT_EQ(in.varint(), 0u);
  EXPECT_EQ(in.text(), "");
  EXPECT_FALSE(in.done());
  EXPECT_EQ(in.rest(), 0u);
}

TEST(Bytes, ATextLongerThanWhatIsLeftFails) {
  ByteWriter out;
  out.varint(UINT64_MAX);
  out.raw("abc");
  ByteReader in(out.bytes());
  EXPECT_EQ(in.text(), "");
  EXPECT_TRUE(in.failed());
}

TEST(Bytes, ANumberWithoutAnEndFails) {
  ByteReader in(std::string_view("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"));
  EXPECT_EQ(in.varint(), 0u);
  EXPECT_TRUE(in.failed());
}

TEST(Bytes, ThatAreLeftAreNotDone) {
  ByteReader in("ab");
  EXPECT_EQ(in.byte(), 'a');
  EXPECT_FALSE(in.done());
  EXPECT_FALSE(in.failed());
  EXPECT_EQ(in.at(), 1u);
}

}  // namespace
}  // namespace saker::exchange
