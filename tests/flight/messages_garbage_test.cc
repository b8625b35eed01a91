#include <gtest/gtest.h>

#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/bus/occupancy_messages.h"
#include "flight/bus/scan_messages.h"
#include "saker/core/rng.h"

// What a network can hand over under the right fingerprint: cut messages and any bytes behind it.
namespace saker::flight {
namespace {

constexpr std::size_t kFingerprint = 8;

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class Message>
int decode(const std::vector<std::uint8_t>& bytes) {
  Message message{};
  return message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
}

template <class Message>
class AnyMessage : public testing::Test {};

using Messages =
    testing::Types<vehicle_state_t, command_t, command_ack_t, setpoint_t, odometry_t, scan_t,
                   trajectory_t, verdict_t, occupancy_t, object_map_t, detections_t, plan_t,
                   mission_t, health_t, exchange_t, order_t, presence_t>;
TYPED_TEST_SUITE(AnyMessage, Messages);

TYPED_TEST(AnyMessage, IsNotDecodedWhenItIsCut) {
  const auto whole = encoded(TypeParam{});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_LT(decode<TypeParam>({whole.begin(), whole.begin() + static_cast<long>(size)}), 0);
  }
}

TYPED_TEST(AnyMessage, IsNotDecodedFromAnotherFingerprint) {
  auto bytes = encoded(TypeParam{});
  bytes[3] ^= 1;
  EXPECT_LT(decode<TypeParam>(bytes), 0);
}

TYPED_TEST(AnyMessage, WhateverFollowsTheFingerprintNeitherThrowsNorTakesMemory) {
  core::Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    auto bytes = encoded(TypeParam{});
    bytes.resize(bytes.size() + 500);
    for (std::size_t b = kFingerprint; b < bytes.size(); ++b) {
      if (rng.chance(i % 2 ? 0.9 : 0.1)) bytes[b] = static_cast<std::uint8_t>(rng.index(256));
    }
    EXPECT_NO_THROW(decode<TypeParam>(bytes));
  }
}

TEST(Garbage, ACountThatTheBytesCannotHoldIsRefused) {
  occupancy_t message{};
  auto bytes = encoded(message);
  for (std::size_t i = 1; i <= 4; ++i) bytes[bytes.size() - i] = 0x7f;  // num_bytes, the last field
  EXPECT_LT(decode<occupancy_t>(bytes), 0);
  for (std::size_t i = 1; i <= 4; ++i) bytes[bytes.size() - i] = 0xff;
  EXPECT_LT(decode<occupancy_t>(bytes), 0);
}

TEST(Garbage, JoinersLiveThroughForgedChunks) {
  core::Rng rng(6);
  ScanJoiner scans;
  OccupancyJoiner grids;
  const auto number = [&] { return static_cast<std::int16_t>(rng.index(70) - 3); };
  for (int i = 0; i < 5000; ++i) {
    scan_t scan{};
    scan.utime = rng.index(5);
    scan.orientation[3] = 1;
    scan.chunk = number();
    scan.num_chunks = number();
    EXPECT_NO_THROW((void)scans.add(scan));
    occupancy_t grid{};
    grid.utime = rng.index(5);
    grid.resolution_m = 0.25;
    for (auto& size : grid.size) size = number();
    grid.first_cell = number();
    grid.num_cells = number();
    grid.chunk = static_cast<std::int16_t>(rng.index(3));
    grid.num_chunks = static_cast<std::int16_t>(rng.index(3));
    for (int b = rng.index(6); b > 0; --b) {
      grid.runs.push_back(static_cast<std::uint8_t>(rng.index(256)));
    }
    EXPECT_NO_THROW((void)grids.add(grid));
  }
}

}  // namespace
}  // namespace saker::flight
