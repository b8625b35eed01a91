#include "tools/saker/soak/soak_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

/// Fifty samples in an hour: 200 MB and what it grows, 20 handles and so many more.
std::vector<SoakSample> made(double percent_an_hour, int more_handles = 0) {
  std::vector<SoakSample> samples;
  for (int i = 0; i < 50; ++i) {
    const double t_h = i / 49.0, ripple = 0.2 * (i % 3);
    samples.push_back({.process = "saker-flight",
                       .t_h = t_h,
                       .memory_mb = 200 * (1 + 0.01 * percent_an_hour * t_h) + ripple,
                       .handles = 20 + i % 2 + more_handles * i / 49,
                       .threads = 12,
                       .waiting = static_cast<double>(i % 4),
                       .work = 0.5});
  }
  return samples;
}

std::string shortfall(const std::vector<SoakSample>& samples) {
  return figures_of(samples).at(0).shortfall();
}

TEST(SoakReport, MemoryThatStaysIsWell) { EXPECT_EQ(shortfall(made(0)), ""); }

TEST(SoakReport, AFifthOfThePermittedSlopeIsWell) { EXPECT_EQ(shortfall(made(0.1)), ""); }

TEST(SoakReport, ALeakFallsShortAndIsSaidInWords) {
  EXPECT_EQ(shortfall(made(3)).find("saker-flight: memory grows by "), 0u);
}

TEST(SoakReport, GrowthOfTheFirstMinutesIsNoLeak) {
  std::vector<SoakSample> samples = made(0);
  for (int i = 0; i < 8; ++i) samples[i].memory_mb -= 60 - 7 * i;
  EXPECT_EQ(shortfall(samples), "");
}

TEST(SoakReport, HandlesThatAreNotClosedFallShort) {
  EXPECT_EQ(shortfall(made(0, 5)).find("saker-flight: open handles grow, 20 at first"), 0u);
}

TEST(SoakReport, EachProcessIsJudgedByItself) {
  std::vector<SoakSample> samples = made(0), other = made(4);
  for (SoakSample& sample : other) sample.process = "saker-sim";
  samples.insert(samples.end(), other.begin(), other.end());
  const auto figures = figures_of(samples);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].shortfall(), "");
  EXPECT_NE(figures[1].shortfall(), "");
  EXPECT_NEAR(figures[1].memory.in_percent(figures[1].memory.slope), 4, 0.3);
  EXPECT_EQ(figures[0].waiting_most, 3);
}

TEST(SoakReport, TheTableHasARowAProcess) {
  const std::string table = soak_table(figures_of(made(0)));
  EXPECT_EQ(std::ranges::count(table, '\n'), 2);
  EXPECT_NE(table.find("saker-flight"), std::string::npos);
}

TEST(SoakSamples, AreReadAsTheyWereWritten) {
  const auto file = std::filesystem::path(testing::TempDir()) / "soak_samples.jsonl";
  std::vector<SoakSample> before = made(1);
  before[3].work = NAN;
  std::string lines;
  for (const SoakSample& sample : before) lines += to_line(sample);
  core::write_file(file, lines);
  const std::vector<SoakSample> after = read_samples(file);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after[7].memory_mb, before[7].memory_mb);
  EXPECT_EQ(after[7].handles, before[7].handles);
  EXPECT_TRUE(std::isnan(after[3].work));
}

TEST(SoakSamples, ALineThatIsNoneIsRefusedByItsNumber) {
  const auto file = std::filesystem::path(testing::TempDir()) / "soak_wrong.jsonl";
  core::write_file(file, to_line(made(0)[0]) + "{\"process\": 3}\n");
  try {
    (void)read_samples(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("soak_wrong.jsonl:2: "), std::string::npos);
  }
}

TEST(SoakSamples, AnOpenFileIsAHandleAndItsMemoryIsResident) {
  const SoakSample before = sample_of_this_process(0);
  const std::ifstream open("/dev/null");
  std::vector<char> held(40'000'000, 1);
  const SoakSample after = sample_of_this_process(0);
  EXPECT_EQ(std::ranges::count(held, 1), std::ssize(held));
  EXPECT_EQ(after.handles, before.handles + 1);
  EXPECT_NEAR(after.memory_mb - before.memory_mb, 40, 5);
  std::vector<char>().swap(held);  // `held = {}` would keep its memory
  EXPECT_NEAR(sample_of_this_process(0).memory_mb, before.memory_mb, 5);
}

}  // namespace
}  // namespace saker::tools
