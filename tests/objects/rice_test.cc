#include "saker/objects/rice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::objects {
namespace {

using Column = std::vector<std::int64_t>;

std::string written(const Column& values) {
  BitWriter out;
  write_column(out, values);
  return out.finish();
}

Column read_back(const Column& values) {
  BitReader in(written(values));
  return read_column(in, values.size());
}

TEST(Rice, BitsComeBackAsTheyWerePut) {
  core::Rng rng(1);
  std::vector<std::pair<std::uint64_t, int>> put;
  BitWriter out;
  for (int i = 0; i < 5000; ++i) {
    const int bits = rng.index(65);
    const auto value = static_cast<std::uint64_t>(rng.uniform() * 1.8e19);
    put.emplace_back(bits < 64 ? value & ((std::uint64_t{1} << bits) - 1) : value, bits);
    out.put(value, bits);
  }
  BitReader in(out.finish());
  for (const auto& [value, bits] : put) ASSERT_EQ(in.take(bits), value);
  EXPECT_LT(in.bits_left(), 8U);
}

TEST(Rice, TextsAndNumbersComeBack) {
  BitWriter out;
  out.put(true, 1);
  out.put(-0.02);
  out.put(std::string_view("trunk"));
  BitReader in(out.finish());
  EXPECT_EQ(in.take(1), 1U);
  EXPECT_EQ(in.take_double(), -0.02);
  EXPECT_EQ(in.take_text(), "trunk");
}

TEST(Rice, EveryColumnComesBack) {
  core::Rng rng(2);
  for (const double scale : {0.0, 1.0, 30.0, 1e5, 1e15}) {
    Column values;
    for (int i = 0; i < 300; ++i) values.push_back(std::llround(scale * rng.normal(1, 1)));
    values[17] = std::llround(1e18);  // one that lies far out
    EXPECT_EQ(read_back(values), values) << scale;
  }
  const Column extremes = {INT64_MIN, INT64_MAX, 0, -1, 1};
  EXPECT_EQ(read_back(extremes), extremes);
  EXPECT_EQ(read_back({}), Column());
}

/// Geometric numbers of mean m with k low bits, r = 2^k / m: k + 1 / (1 − e^−r) bits, log2(e m) of
/// entropy.
TEST(Rice, GapsBetweenRandomPlacesCostAnEighthOfABitMoreThanTheirEntropyAtMost) {
  core::Rng rng(3);
  for (const double mean : {25000.0, 30000.0, 35000.0, 40000.0, 45000.0}) {
    Column gaps;
    for (int i = 0; i < 50000; ++i) {
      gaps.push_back(std::llround(-mean * std::log(1 - rng.uniform())));
    }
    const double entropy = std::log2(mean * std::exp(1.0));
    const double bits = 8.0 * static_cast<double>(written(gaps).size()) / 50000;
    EXPECT_GT(bits, entropy);
    EXPECT_LT(bits, entropy + 0.125 + 0.015) << mean;  // and what the sample's own mean differs
  }
}

TEST(Rice, SymmetricNumbersCostLessThanTheirRangeWould) {
  core::Rng rng(4);
  Column values;
  for (int i = 0; i < 20000; ++i) values.push_back(std::llround(rng.normal(5000, 10)));
  const double entropy = std::log2(10 * std::sqrt(2 * M_PI * std::exp(1.0)));
  const double bits = 8.0 * static_cast<double>(written(values).size()) / 20000;
  EXPECT_LT(bits, entropy + 0.4);
}

TEST(Rice, WhatEndsTooEarlyIsRefused) {
  const std::string good = written(Column(100, 12345));
  for (std::size_t size = 0; size + 1 < good.size(); ++size) {
    BitReader in(good.substr(0, size));
    EXPECT_THROW((void)read_column(in, 100), Error) << size;
  }
}

TEST(Rice, ACountThatCannotBeThereClaimsNoMemory) {
  BitReader in(std::string(8, '\xFF'));
  EXPECT_THROW((void)read_column(in, std::size_t{1} << 60), Error);
  BitReader text(std::string(8, '\xFF'));
  EXPECT_THROW((void)text.take_text(), Error);
}

}  // namespace
}  // namespace saker::objects
