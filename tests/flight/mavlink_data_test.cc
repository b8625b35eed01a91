#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "flight/mavlink/commands.h"
#include "flight/mavlink/frames.h"
#include "flight/mavlink/state_in.h"
#include "mavlink_records.h"

/// Against what an autopilot did: ArduCopter 4.6 in its simulator, ../shared/data/mavlink.
namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;

std::vector<Frame> frames_of(FrameReader& reader, std::span<const std::uint8_t> stream,
                             std::size_t piece) {
  std::vector<Frame> frames;
  while (!stream.empty()) {
    stream = stream.subspan(reader.push(stream.first(std::min(piece, stream.size()))));
    while (auto frame = reader.next()) frames.push_back(*frame);
  }
  reader.settle();
  while (auto frame = reader.next()) frames.push_back(*frame);
  return frames;
}

TEST(MavlinkRecord, OfTheAutopilotIsReadWhole) {
  const auto bytes = recorded("from_fc.mavlink");
  if (!bytes) GTEST_SKIP() << kNoRecords;
  FrameReader reader;
  const auto frames = frames_of(reader, *bytes, 11);
  EXPECT_EQ(frames.size(), 231u);
  EXPECT_EQ(reader.counters().skipped, 0);
  for (const Frame& frame : frames) EXPECT_EQ(frame.system, 1);
}

/// Decoded and encoded again, every frame has the same payload, cut at the same byte.
TEST(MavlinkRecord, OfTheBridgeIsWrittenAgainAsItWas) {
  const auto bytes = recorded("bridge.mavlink");
  if (!bytes) GTEST_SKIP() << kNoRecords;
  FrameReader reader, again;
  const auto frames = frames_of(reader, *bytes, 100);
  ASSERT_EQ(frames.size(), 4443u);
  FrameWriter writer(255, 191);
  std::vector<std::uint8_t> stream;
  const auto write = [&](const auto& message) {
    const auto frame = writer.write(message);
    stream.insert(stream.end(), frame->span().begin(), frame->span().end());
  };
  const auto write_if = [&]<class Message>(const Frame& frame, Message) {
    if (frame.id == Message::kId) write(decode<Message>(frame.bytes()));
  };
  for (const Frame& frame : frames)
    std::apply([&](auto... messages) { (write_if(frame, messages), ...); }, AllMessages{});
  ASSERT_EQ(stream.size(), bytes->size());
  const auto written = frames_of(again, stream, 100);
  ASSERT_EQ(written.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(written[i].bytes(), frames[i].bytes())) << i;
}

TEST(MavlinkRecord, ItsTwentyDamagedFramesCostNoGoodOne) {
  const auto bytes = recorded("corrupt.mavlink");
  if (!bytes) GTEST_SKIP() << kNoRecords;
  for (const std::size_t piece : {1, 17, 200}) {
    FrameReader reader;
    EXPECT_EQ(frames_of(reader, *bytes, piece).size(), 180u);
    EXPECT_GE(reader.counters().damaged, 20);
  }
}

TEST(MavlinkRecord, OdometryThatFlewHasTheFramesOfOurs) {
  const auto bytes = recorded("bridge.mavlink");
  if (!bytes) GTEST_SKIP() << kNoRecords;
  FrameReader reader;
  int checked = 0;
  for (const Frame& frame : frames_of(reader, *bytes, 280)) {
    if (frame.id != Odometry::kId) continue;
    const auto m = decode<Odometry>(frame.bytes());
    EXPECT_EQ(m.frame_id, 20);
    EXPECT_EQ(m.child_frame_id, 12);
    EXPECT_EQ(m.estimator_type, 3);
    EXPECT_TRUE(rotation_of(m.q[0], m.q[1], m.q[2], m.q[3]).valid);
    EXPECT_LE(m.z, 0.2F);  // z is down: it flew
    ++checked;
  }
  EXPECT_EQ(checked, 2799);
}

TEST(MavlinkRecord, TheAutopilotsStateIsUnderstood) {
  const auto bytes = recorded("from_fc.mavlink");
  if (!bytes) GTEST_SKIP() << kNoRecords;
  FrameReader reader;
  StateIn state(dialect_of(Autopilot::ardupilot), 0);
  for (const Frame& frame : frames_of(reader, *bytes, 280)) (void)state.hear(frame, kMs);
  EXPECT_TRUE(state.connected(kMs));
  EXPECT_EQ(state.refusal(), "");
  EXPECT_EQ(state.system(), 1);
  EXPECT_TRUE(state.estimator_good());
  EXPECT_GT(state.state().battery_share, 0.5);
  EXPECT_TRUE(state.state().position.allFinite());
  EXPECT_NE(state.state().landed, Landed::unknown);
}

/// The arming of a whole flight: its answers and texts, at their times. The script asked every two
/// seconds, and so do we.
TEST(MavlinkRecord, ArmingComesOutAsItDidThen) {
  std::ifstream record(records() / "behaviour" / "basic_50_50.txt");
  if (!record) GTEST_SKIP() << kNoRecords;
  const std::regex event(R"(\s*([0-9.]+) (TEXT (\d+) (.*)|ACK cmd 400 result (\d+).*|CMD 400 .*))");
  Commander commander;
  std::smatch m;
  int refusals = 0;
  std::vector<saker::CommandAck> done;
  for (std::string line; std::getline(record, line) && done.empty();) {
    if (!std::regex_match(line, m, event)) continue;
    const Time now = from_seconds(std::stod(m[1]));
    if (m[3].matched) {
      commander.hear_text(std::stoi(m[3]), m[4], now);
    } else if (m[5].matched) {
      EXPECT_TRUE(commander.hear(
          {.command = 400, .result = static_cast<std::uint8_t>(std::stoi(m[5]))}, now));
      refusals += m[5] != "0";
      EXPECT_FALSE(commander.due(now + 250 * kMs)) << line;
      done = commander.take_done(now + 250 * kMs);
    } else {
      if (!commander.busy()) commander.begin(5, {{kArmDisarm, {1}}}, now);
      EXPECT_TRUE(commander.due(now)) << line;
    }
  }
  EXPECT_EQ(refusals, 9);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_TRUE(done[0].accepted);
}

}  // namespace
}  // namespace saker::flight::mavlink
