#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "flight/mavlink/bridge.h"
#include "saker/core/rng.h"

/// Frames that are damaged in every way. SAKER_MUTATIONS of them are made (200,000 where it says
/// nothing; ten millions under sanitisers are the bar), from SAKER_MUTATION_SEED.
namespace saker::flight::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr Time kNow = 100 * kNanosecondsPerSecond;
constexpr SigningTime kSigningNow = 1'000'000'000;

std::int64_t from_environment(const char* name, std::int64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoll(text) : otherwise;
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : rng_(seed) {}

  [[nodiscard]] std::size_t below(std::size_t most) {
    return most == 0 ? 0 : static_cast<std::size_t>(rng_.index(static_cast<int>(most)));
  }
  [[nodiscard]] std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }

  /// A frame of any message, its fields any bytes that are finite numbers.
  [[nodiscard]] Bytes frame() {
    const std::size_t wanted = below(kDefinitions.size());
    std::size_t at = 0;
    Bytes bytes;
    std::apply(
        [&](auto... messages) { ((at++ == wanted ? bytes = written(messages) : bytes), ...); },
        AllMessages{});
    return bytes;
  }

  /// Changes, cuts, doubles, swaps and puts in: one to four times.
  [[nodiscard]] Bytes mutated(Bytes bytes) {
    for (std::size_t times = 1 + below(4); times > 0; --times) {
      if (bytes.empty()) return bytes;
      const std::size_t at = below(bytes.size());
      const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      switch (below(8)) {
        case 0:
          bytes[at] ^= static_cast<std::uint8_t>(1U << below(8));
          break;
        case 1:
          bytes[at] = byte();
          break;
        case 2:
          bytes.resize(at);
          break;
        case 3:
          bytes.insert(place, byte());
          break;
        case 4:
          bytes.erase(place);
          break;
        case 5:
          bytes[below(std::min<std::size_t>(bytes.size(), 10))] = byte();
          break;  // its header
        case 6:
          bytes.insert(place, below(2) == 0 ? 0xFD : 0xFE);
          break;
        case 7: {
          const Bytes other = frame();
          bytes.insert(place, other.begin(),
                       other.begin() + static_cast<std::ptrdiff_t>(below(other.size())));
          break;
        }
        default:
          break;
      }
    }
    return bytes;
  }

 private:
  template <class Message>
  [[nodiscard]] Bytes written(Message message) {
    const auto fill = [&]<class T>(T& value) {
      if constexpr (std::is_floating_point_v<T>)
        value = static_cast<T>(rng_.uniform(-1e3, 1e3));
      else
        value =
            static_cast<T>(below(2) == 0 ? below(256) : std::numeric_limits<std::uint32_t>::max());
    };
    Message::visit(message, [&](const char*, auto& field) {
      if constexpr (codec::IsArray<std::decay_t<decltype(field)>>::value)
        for (auto& element : field) fill(element);
      else
        fill(field);
    });
    const auto frame = writer_.write(message);
    return frame ? Bytes(frame->span().begin(), frame->span().end()) : Bytes{};
  }

  core::Rng rng_;
  FrameWriter writer_{1, 1};
};

/// What a reader finds in bytes that come in pieces.
template <class Take>
void read_all(FrameReader& reader, std::span<const std::uint8_t> bytes, std::size_t piece,
              const Take& take) {
  while (!bytes.empty()) {
    const std::size_t taken = reader.push(bytes.first(std::min(piece, bytes.size())));
    ASSERT_GT(taken, 0U);
    bytes = bytes.subspan(taken);
    while (const auto frame = reader.next(kSigningNow)) take(*frame);
  }
}

Heartbeat numbered(std::uint32_t number) {
  Heartbeat message;
  message.custom_mode = number;
  message.autopilot = 3;
  message.mavlink_version = 3;
  return message;
}

class MavlinkMutations : public ::testing::Test {
 protected:
  const std::int64_t count_ = from_environment("SAKER_MUTATIONS", 200'000);
  const std::uint64_t seed_ =
      static_cast<std::uint64_t>(from_environment("SAKER_MUTATION_SEED", 1));
  Mutator mutator_{seed_};
  FrameWriter writer_{1, 1};
};

/// Behind each damaged frame come three that are whole. At most the first of them is lost, whatever
/// the damaged one said of its length: where a changed id has no definition, no CRC says that it is
/// damaged. The others are read when the last byte of the third is there. A CRC of 16 bits takes
/// one of 65,536 false frames for a true one.
TEST_F(MavlinkMutations, AfterWhatIsDamagedAtMostOneFrameIsLost) {
  FrameReader reader;
  std::int64_t first_lost = 0, more_lost = 0;
  for (std::int64_t i = 0; i < count_; ++i) {
    const auto first = static_cast<std::uint32_t>(3 * i);
    Bytes stream = mutator_.mutated(mutator_.frame());
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto frame = writer_.write(numbered(first + k));
      stream.insert(stream.end(), frame->span().begin(), frame->span().end());
    }
    std::array<bool, 3> read{};
    read_all(reader, stream, 1 + mutator_.below(64), [&](const Frame& frame) {
      if (frame.id != Heartbeat::kId) return;
      const std::uint32_t k = decode<Heartbeat>(frame.bytes()).custom_mode - first;
      if (k < read.size()) read[k] = true;
    });
    first_lost += !read[0];
    more_lost += !read[1] || !read[2];
  }
  std::printf("behind %lld damaged frames %lld were lost, and %lld times more than one\n",
              static_cast<long long>(count_), static_cast<long long>(first_lost),
              static_cast<long long>(more_lost));
  EXPECT_LE(first_lost, 3 + count_ / 1000);
  EXPECT_LE(more_lost, 3 + count_ / 65'536);
}

/// Neither the bridge nor what it says is moved by them: nothing throws, nothing that moves goes
/// out, and the autopilot that was there is still heard.
TEST_F(MavlinkMutations, ABridgeHearsThemAndStillHearsItsAutopilot) {
  Bridge bridge(BridgeConfig{});
  int targets = 0;
  Time now = kNow;
  FrameReader sent;
  for (std::int64_t i = 0; i < count_; ++i) {
    bridge.hear_bytes(mutator_.mutated(mutator_.frame()), now, kSigningNow);
    if (i % 10 != 0) continue;
    now += kNanosecondsPerSecond / 100;
    bridge.settle(now, kSigningNow);
    bridge.step(now, kSigningNow);
    (void)bridge.take_answers(now);
    for (const FrameBytes& frame : bridge.take_frames()) {
      ASSERT_EQ(sent.push(frame.span()), frame.length);
      while (const auto read = sent.next()) targets += read->id == SetPositionTargetLocalNed::kId;
    }
  }
  EXPECT_EQ(targets, 0);
  EXPECT_EQ(bridge.counters().not_finite, 0);
  bridge.hear_bytes(writer_.write(numbered(4))->span(), now, kSigningNow);
  bridge.settle(now, kSigningNow);
  EXPECT_TRUE(bridge.autopilot().connected(now));
}

/// With a key: none of them gets in that nobody signed.
TEST_F(MavlinkMutations, NoneOfThemHasASignature) {
  Signing theirs, ours;
  theirs.key[0] = ours.key[0] = 7;
  FrameReader reader(&ours);
  std::int64_t read = 0;
  const std::int64_t most = count_ / 10;
  for (std::int64_t i = 0; i < most; ++i) {
    const auto frame = writer_.write(numbered(7), &theirs, kSigningNow);
    Bytes whole(frame->span().begin(), frame->span().end());
    const Bytes changed = mutator_.mutated(whole);
    const bool holds =
        std::search(changed.begin(), changed.end(), whole.begin(), whole.end()) != changed.end();
    const auto take = [&](const Frame&) { read += !holds; };
    read_all(reader, changed, changed.size(), take);
    reader.settle();
    while (const auto found = reader.next(kSigningNow)) take(*found);
  }
  EXPECT_EQ(read, 0);
}

}  // namespace
}  // namespace saker::flight::mavlink
