#include "damage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "made_bag.h"
#include "memory_limit.h"
#include "saker/core/error.h"
#include "saker/core/one_line.h"
#include "saker/core/rng.h"

namespace saker::lidar::testing {
namespace {

constexpr std::size_t kCuts = 100, kChanges = 100;
constexpr std::size_t kHead = 1024;
constexpr rlim_t kMostMemory = rlim_t{512} << 20;

bool one_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
}

/// Frames of a recording.
int read_all(const std::filesystem::path& file, const RecordingOptions& options, int most) {
  const auto source = open_recording(file, options);
  EXPECT_GE(source->expected_scans(), 0);
  int frames = 0;
  for (; frames <= most; ++frames) {
    const auto frame = source->next();
    if (!frame) break;
    expect_consistent(*frame);
  }
  EXPECT_TRUE(one_line(source->note())) << source->note();
  EXPECT_TRUE(one_line(source->counters().summary())) << source->counters().summary();
  return frames;
}

}  // namespace

void for_each_damage(const std::vector<std::uint8_t>& whole,
                     const std::function<void(const std::vector<std::uint8_t>&)>& visit) {
  for (std::size_t i = 0; i < kCuts; ++i) {
    const std::size_t near_the_begin = 7 * i, anywhere = whole.size() * i / kCuts;
    const std::size_t size = i % 2 == 0 ? near_the_begin : anywhere;
    visit(
        {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(std::min(size, whole.size()))});
  }
  core::Rng rng(58);
  for (std::size_t i = 0; i < kChanges; ++i) {
    std::vector<std::uint8_t> changed = whole;
    const std::size_t within = i % 2 == 0 ? std::min(whole.size(), kHead) : whole.size();
    for (std::size_t k = 0; k < 1 + i % 8; ++k) {
      const int value = rng.index(4);
      changed[static_cast<std::size_t>(rng.index(static_cast<int>(within)))] =
          static_cast<std::uint8_t>(value == 0   ? 0
                                    : value == 1 ? 255
                                                 : rng.index(256));
    }
    visit(changed);
  }
}

void expect_consistent(const Frame& frame) {
  const Scan& scan = frame.scan;
  EXPECT_TRUE(one_line(frame.fault)) << frame.fault;
  EXPECT_EQ(scan.points.empty(), !frame.fault.empty()) << frame.fault;
  EXPECT_EQ(scan.reflectivity.size(), scan.size());
  EXPECT_EQ(scan.offset_ns.size(), scan.size());
  EXPECT_TRUE(scan.ring.empty() || scan.ring.size() == scan.size()) << scan.ring.size();
  if (scan.organised()) {
    EXPECT_EQ(static_cast<std::size_t>(scan.rows) * static_cast<std::size_t>(scan.columns),
              scan.size());
  }
  for (const float value : scan.reflectivity) ASSERT_TRUE(value >= 0 && value <= 1) << value;
  for (const std::int32_t offset : scan.offset_ns) ASSERT_LE(offset, 0);
  for (const ImuSample& sample : frame.imu) {
    ASSERT_TRUE(sample.acceleration.allFinite() && sample.angular_velocity.allFinite());
  }
}

void expect_survives_damage(const std::vector<std::uint8_t>& whole,
                            const std::filesystem::path& file, const RecordingOptions& options) {
  write_bytes(file, whole);
  const int frames = read_all(file, options, 1000);
  ASSERT_GT(frames, 0);
  int opened = 0;
  for_each_damage(whole, [&](const std::vector<std::uint8_t>& bytes) {
    write_bytes(file, bytes);
    const MemoryLimit limit(kMostMemory);
    try {
      EXPECT_LE(read_all(file, options, 2 * frames), 2 * frames);
      ++opened;
    } catch (const Error& error) {
      EXPECT_TRUE(one_line(error.what())) << error.what();
      EXPECT_NE(std::string(error.what()), "");
    }
  });
  EXPECT_GT(opened, 0);
}

}  // namespace saker::lidar::testing
