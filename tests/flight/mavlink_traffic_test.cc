#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mavlink_autopilot.h"

namespace saker::flight::mavlink {
namespace {

constexpr double kBytes = 230400 / 10.0;  // a second: start bit, eight bits, stop bit
constexpr int kSignature = 13;            // bytes a frame
constexpr double kShare = 0.8;            // of the line, so that nothing waits long

class MavlinkTraffic : public ::testing::TestWithParam<Autopilot> {};

/// With all that the bridge asks for and says, signed, in flight.
TEST_P(MavlinkTraffic, AMinuteOfFlightFits230400Baud) {
  Flown flown(GetParam());
  flown.take_off();
  flown.setpoints_run = true;
  flown.run(2000 * kMs);
  const long frames = flown.sent_frames, bytes = flown.sent_bytes;
  const long came_frames = flown.received_frames, came_bytes = flown.received_bytes;
  const int odometry = flown.sent<Odometry>(), targets = flown.sent<SetPositionTargetLocalNed>();
  flown.run(60'000 * kMs);
  const auto a_second = [](long b, long f) { return static_cast<double>(b + kSignature * f) / 60; };
  const double out = a_second(flown.sent_bytes - bytes, flown.sent_frames - frames);
  const double in =
      a_second(flown.received_bytes - came_bytes, flown.received_frames - came_frames);
  fmt::print("{}: {:.0f} bytes a second out, {:.0f} in, of {:.0f}\n", to_string(GetParam()), out,
             in, kBytes);
  EXPECT_GE(flown.sent<Odometry>() - odometry, 60 * 30);
  EXPECT_GE(flown.sent<SetPositionTargetLocalNed>() - targets, 60 * 49);
  EXPECT_LT(out, kShare * kBytes);
  EXPECT_LT(in, kShare * kBytes);
  EXPECT_GT(in, 50 * 12);  // it speaks
}

INSTANTIATE_TEST_SUITE_P(Both, MavlinkTraffic,
                         ::testing::Values(Autopilot::ardupilot, Autopilot::px4),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

}  // namespace
}  // namespace saker::flight::mavlink
