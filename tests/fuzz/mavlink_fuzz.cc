#include <algorithm>
#include <array>

#include "flight/mavlink/bridge.h"
#include "fuzz.h"

/// The line to an autopilot: the first byte chooses which one. Then, again and again, a byte: even,
/// a message of the table that it chooses is framed with the payload that follows, behind a byte of
/// its length; odd, so many bytes of the line as they are.
namespace saker {
namespace {

using namespace flight::mavlink;
using lidar::Cursor;

constexpr Time kStep = 20'000'000;  // ns

std::vector<std::uint8_t> framed(const Definition& definition, lidar::ByteView payload,
                                 std::uint8_t sequence) {
  std::vector<std::uint8_t> frame = {0xFD,
                                     static_cast<std::uint8_t>(payload.size()),
                                     0,
                                     0,
                                     sequence,
                                     1,
                                     1,
                                     static_cast<std::uint8_t>(definition.id),
                                     static_cast<std::uint8_t>(definition.id >> 8),
                                     static_cast<std::uint8_t>(definition.id >> 16)};
  frame.insert(frame.end(), payload.begin(), payload.end());
  const std::uint8_t extra = definition.crc_extra;
  const std::uint16_t crc = crc16({&extra, 1}, crc16(std::span(frame).subspan(1)));
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

/// What the bridge is told meanwhile, so that it flies.
void tell(Bridge& bridge, Time now, int step) {
  VehicleOdometry odometry;
  odometry.stamp = now;
  bridge.hear(odometry, now);
  if (step % 8 != 0) return;
  Command command;
  command.id = step;
  command.kind = static_cast<CommandKind>(step / 8 % 6);
  bridge.hear(command, now);
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Cursor cursor(input);
  BridgeConfig config;
  config.autopilot = cursor.number<std::uint8_t>() % 2 ? Autopilot::px4 : Autopilot::ardupilot;
  Bridge bridge(config);
  Time now = kStep;
  for (int step = 0; cursor.left() > 0; ++step, now += kStep) {
    const auto head = cursor.number<std::uint8_t>();
    if (head % 2 == 0) {
      const Definition& definition = kDefinitions[head / 2 % kDefinitions.size()];
      const ByteView payload = cursor.take_at_most(cursor.number<std::uint8_t>());
      bridge.hear_bytes(framed(definition, payload, static_cast<std::uint8_t>(step)), now, 0);
    } else {
      bridge.hear_bytes(cursor.take_at_most(head / 2), now, 0);
      bridge.settle(now, 0);
    }
    tell(bridge, now, step);
    bridge.step(now, 0);
    (void)bridge.vehicle_state(now);
    (void)bridge.take_answers(now);
    for (const FrameBytes& frame : bridge.take_frames()) expect(frame.length <= kMostFrame);
  }
}

}  // namespace saker
