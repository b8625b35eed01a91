#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <vector>

#include "flight/mavlink/frame.h"

namespace saker::flight::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Fills every field with its least, its greatest or a random value.
template <class Message>
Message filled(int how, std::mt19937& random) {
  const auto value = [&]<class T>(T& field) {
    using Limits = std::numeric_limits<T>;
    if (how == 0) field = Limits::lowest();
    if (how == 1) field = Limits::max();
    if (how == 2) field = static_cast<T>(random() % 100);
  };
  Message message;
  Message::visit(message, [&](const char*, auto& field) {
    if constexpr (codec::IsArray<std::decay_t<decltype(field)>>::value)
      for (auto& element : field) value(element);
    else
      value(field);
  });
  return message;
}

template <class Message>
bool same(const Message& a, const Message& b) {
  return encode(a)->bytes == encode(b)->bytes;
}

/// Calls f(Message{}) for every message of the table.
template <class F>
void for_all_messages(F f) {
  std::apply([&](auto... messages) { (f(messages), ...); }, AllMessages{});
}

void append(Bytes& stream, const std::optional<FrameBytes>& frame) {
  ASSERT_TRUE(frame);
  stream.insert(stream.end(), frame->span().begin(), frame->span().end());
}

/// All frames of a stream that comes in pieces of `piece` bytes.
std::vector<Frame> read_all(FrameReader& reader, std::span<const std::uint8_t> stream,
                            std::size_t piece, SigningTime now = 0) {
  std::vector<Frame> frames;
  while (!stream.empty()) {
    const std::size_t taken = reader.push(stream.first(std::min(piece, stream.size())));
    EXPECT_GT(taken, 0u);
    if (taken == 0) return frames;
    stream = stream.subspan(taken);
    while (auto frame = reader.next(now)) frames.push_back(*frame);
  }
  reader.settle();
  while (auto frame = reader.next(now)) frames.push_back(*frame);
  return frames;
}

Heartbeat heartbeat(std::uint32_t mode) {
  Heartbeat message;
  message.custom_mode = mode;
  message.mavlink_version = 3;
  return message;
}

TEST(MavlinkWire, TheChecksumIsThatOfTheCatalogue) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc16({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0x6F91);
}

TEST(MavlinkWire, EveryMessageComesBackWithItsLeastGreatestAndAnyValues) {
  std::mt19937 random(1);
  for_all_messages([&]<class Message>(Message) {
    FrameWriter writer(1, 191);
    FrameReader reader;
    for (int how = 0; how < 3; ++how) {
      const Message message = filled<Message>(how, random);
      Bytes stream;
      append(stream, writer.write(message));
      const std::vector<Frame> frames = read_all(reader, stream, 7);
      ASSERT_EQ(frames.size(), 1u) << Message::kName;
      EXPECT_EQ(frames[0].id, Message::kId);
      EXPECT_EQ(frames[0].system, 1);
      EXPECT_EQ(frames[0].component, 191);
      EXPECT_EQ(frames[0].sequence, how);
      EXPECT_TRUE(same(decode<Message>(frames[0].bytes()), message)) << Message::kName;
    }
  });
}

TEST(MavlinkWire, NoNotANumberGoesOut) {
  FrameWriter writer(1, 191);
  Odometry odometry;
  EXPECT_TRUE(writer.write(odometry));
  odometry.pose_covariance[20] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(writer.write(odometry));
  odometry.pose_covariance[20] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(writer.write(odometry));
}

TEST(MavlinkWire, TrailingZerosAreCutAndOneByteStays) {
  FrameWriter writer(1, 191);
  EXPECT_EQ(writer.write(Odometry{})->length, 10u + 1 + 2);
  EXPECT_EQ(writer.write(heartbeat(0))->length, 10u + 9 + 2);
}

TEST(MavlinkWire, AFrameOfVersionOneIsRead) {
  Bytes frame = {0xFE, 9, 4, 1, 1, 0, 4, 0, 0, 0, 2, 3, 0x51, 3, 3};
  const std::uint8_t extra = Heartbeat::kCrcExtra;
  const std::uint16_t crc = crc16({&extra, 1}, crc16({frame.data() + 1, frame.size() - 1}));
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  FrameReader reader;
  const auto frames = read_all(reader, frame, 1);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].version, 1);
  EXPECT_EQ(decode<Heartbeat>(frames[0].bytes()).base_mode, 0x51);
}

TEST(MavlinkWire, AMessageWithoutADefinitionIsSkippedWhole) {
  Bytes stream = {0xFD, 4, 0, 0, 0, 1, 1, 0x10, 0x27, 0, 0xFD, 0xFE, 0xFD, 9, 1, 2};
  FrameWriter writer(1, 1);
  append(stream, writer.write(heartbeat(7)));
  FrameReader reader;
  EXPECT_EQ(read_all(reader, stream, stream.size()).size(), 1u);
  EXPECT_EQ(reader.counters().unknown, 1);
  EXPECT_EQ(reader.counters().skipped, 0);
}

TEST(MavlinkWire, AFalseBeginningIsGivenUpTwoFramesLater) {
  Bytes stream = {0xFD, 255, 0, 0};  // would wait for 263 bytes more
  FrameWriter writer(1, 1);
  append(stream, writer.write(heartbeat(7)));
  FrameReader reader;
  reader.push(stream);
  EXPECT_FALSE(reader.next());
  stream.clear();
  append(stream, writer.write(heartbeat(8)));
  reader.push(stream);
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(decode<Heartbeat>(first->bytes()).custom_mode, 7u);
  EXPECT_TRUE(reader.next());
}

TEST(MavlinkWire, AtTheEndOfADatagramAFalseBeginningIsGivenUpAtOnce) {
  Bytes stream = {0xFD, 255, 0, 0};
  FrameWriter writer(1, 1);
  append(stream, writer.write(heartbeat(7)));
  FrameReader reader;
  EXPECT_EQ(read_all(reader, stream, stream.size()).size(), 1u);
}

/// Every frame that was not touched is read, whatever became of the others.
TEST(MavlinkWire, DamagedFramesCostNoOther) {
  std::mt19937 random(7);
  FrameWriter writer(1, 1);
  Bytes stream;
  std::vector<std::uint32_t> good;
  for (std::uint32_t i = 1; i < 4000; ++i) {
    Bytes frame;
    append(frame, writer.write(heartbeat(i)));
    if (random() % 4 == 0) {
      switch (random() % 3) {
        case 0:
          frame[random() % frame.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
          break;
        case 1:
          frame.resize(random() % frame.size());
          break;
        default:
          frame.insert(frame.begin() + static_cast<long>(1 + random() % (frame.size() - 1)),
                       static_cast<std::uint8_t>(random()));
      }
    } else {
      good.push_back(i);
    }
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  FrameReader reader;
  std::vector<std::uint32_t> read;
  for (const Frame& frame : read_all(reader, stream, 13))
    read.push_back(decode<Heartbeat>(frame.bytes()).custom_mode);
  std::vector<std::uint32_t> missed;
  std::set_difference(good.begin(), good.end(), read.begin(), read.end(),
                      std::back_inserter(missed));
  // A frame whose id was changed into one without a definition may take its neighbour with it.
  EXPECT_LE(missed.size(), 2u);
  EXPECT_LE(read.size(), good.size() + 1);
}

TEST(MavlinkWire, RandomBytesGiveAlmostNoFrameAndLeaveTheReaderUsable) {
  std::mt19937 random(3);
  FrameReader reader;
  Bytes noise(2'000'000);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random() % 8 ? random() : 0xFD);
  EXPECT_LE(read_all(reader, noise, 200).size(), 20u);
  FrameWriter writer(1, 1);
  Bytes stream;
  append(stream, writer.write(heartbeat(1)));
  append(stream, writer.write(heartbeat(2)));
  EXPECT_EQ(read_all(reader, stream, 5).size(), 2u);
}

class MavlinkSigning : public ::testing::Test {
 protected:
  MavlinkSigning() {
    for (std::size_t i = 0; i < ours_.key.size(); ++i)
      ours_.key[i] = static_cast<std::uint8_t>(i * 7);
    theirs_.key = ours_.key;
    theirs_.link = 3;
  }

  Bytes signed_by_them(SigningTime now) {
    Bytes stream;
    append(stream, writer_.write(heartbeat(4), &theirs_, now));
    return stream;
  }

  static constexpr SigningTime kNow = 1'000'000'000;
  Signing ours_, theirs_;
  FrameWriter writer_{1, 1};
  FrameReader reader_{&ours_};
};

TEST_F(MavlinkSigning, WhatTheKeySignedIsReadOnce) {
  const Bytes stream = signed_by_them(kNow);
  EXPECT_EQ(read_all(reader_, stream, 4, kNow).size(), 1u);
  EXPECT_EQ(read_all(reader_, stream, 4, kNow).size(), 0u);
  EXPECT_EQ(reader_.counters().forged, 1);
}

TEST_F(MavlinkSigning, StampsAscendThoughTheClockStands) {
  const Bytes first = signed_by_them(kNow), second = signed_by_them(kNow);
  EXPECT_EQ(read_all(reader_, first, 4, kNow).size(), 1u);
  EXPECT_EQ(read_all(reader_, second, 4, kNow).size(), 1u);
}

TEST_F(MavlinkSigning, UnsignedForeignAndOldFramesAreDropped) {
  Bytes plain;
  append(plain, writer_.write(heartbeat(4)));
  EXPECT_EQ(read_all(reader_, plain, 4, kNow).size(), 0u);
  EXPECT_EQ(reader_.counters().unsigned_, 1);
  const Bytes old = signed_by_them(kNow - SigningClock::kOldest - 2);
  EXPECT_EQ(read_all(reader_, old, 4, kNow).size(), 0u);
  theirs_.key[0] ^= 1;
  EXPECT_EQ(read_all(reader_, signed_by_them(kNow), 4, kNow).size(), 0u);
  EXPECT_EQ(reader_.counters().forged, 2);
}

TEST_F(MavlinkSigning, NoBitOfASignedFrameCanBeChanged) {
  for (std::size_t bit = 8; bit < 8 * (10 + 9 + 2 + 13); ++bit) {
    Bytes stream = signed_by_them(kNow + bit);
    ASSERT_EQ(stream.size(), 10u + 9 + 2 + 13);
    stream[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    EXPECT_EQ(read_all(reader_, stream, 300, kNow).size(), 0u) << bit;
  }
}

TEST_F(MavlinkSigning, SendersAreLimited) {
  SigningClock clock;
  for (int link = 0; link < 300; ++link)
    EXPECT_EQ(clock.accept({1, 1, static_cast<std::uint8_t>(link % 256), kNow}, kNow),
              link < static_cast<int>(SigningClock::kMostStreams));
}

TEST(MavlinkSigningKey, IsReadFromAFileThatOthersCannotRead) {
  const auto file =
      std::filesystem::temp_directory_path() / ("mavlink_key_" + std::to_string(::getpid()));
  const auto write = [&](const std::string& text) {
    std::filesystem::remove(file);
    std::ofstream(file) << text;
    std::filesystem::permissions(
        file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  };
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += "0a";
  write(digits + "\n");
  EXPECT_EQ(read_signing_key(file)[31], 0x0A);
  std::filesystem::permissions(file, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW((void)read_signing_key(file), std::runtime_error);
  write(digits.substr(1));
  EXPECT_THROW((void)read_signing_key(file), std::runtime_error);
  digits[5] = 'x';
  write(digits);
  EXPECT_THROW((void)read_signing_key(file), std::runtime_error);
  std::filesystem::remove(file);
  EXPECT_THROW((void)read_signing_key(file), std::runtime_error);
}

TEST(MavlinkSigningTime, CountsFrom2015) {
  EXPECT_EQ(signing_time(1'420'070'400'000'000 + 1'000'000), 100'000u);
  EXPECT_EQ(signing_time(0), 0u);
}

}  // namespace
}  // namespace saker::flight::mavlink
