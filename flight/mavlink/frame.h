#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/signing.h"

/// Messages ↔ bytes of a line: MAVLink 2, and MAVLink 1 for reading.
///
/// Reads and makes: bytes, as they come and go; no socket, no clock. Source: the MAVLink developer
/// guide, "Packet serialization". Cost: one pass of the CRC a frame; 600 bytes a reader, nothing
/// allocated.
namespace saker::flight::mavlink {

inline constexpr std::size_t kMostFrame = 280;  ///< header 10, payload 255, CRC 2, signature 13

/// CRC-16/MCRF4XX, continued from `value`.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes,
                                  std::uint16_t value = 0xFFFF);

/// The definition of a message, null where the bridge has none.
[[nodiscard]] const Definition* definition_of(std::uint32_t id);

/// One message as it came.
struct Frame {
  int version = 2;
  std::uint8_t sequence = 0;
  std::uint8_t system = 0, component = 0;  ///< of the sender
  std::uint32_t id = 0;
  bool is_signed = false;
  Payload payload;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {payload.bytes.data(), payload.length};
  }
};

/// One frame's bytes.
struct FrameBytes {
  std::array<std::uint8_t, kMostFrame> bytes{};
  std::size_t length = 0;

  [[nodiscard]] std::span<const std::uint8_t> span() const { return {bytes.data(), length}; }
};

/// What signs and checks the frames of one line.
struct Signing {
  SigningKey key{};
  std::uint8_t link = 0;
  SigningClock clock;
};

/// Frames what we send, MAVLink 2, trailing zeros of the payload cut.
class FrameWriter {
 public:
  FrameWriter(std::uint8_t system, std::uint8_t component)
      : system_(system), component_(component) {}

  /// Nothing where a field is NaN or infinite.
  /// \param signing  null: not signed
  template <class Message>
  [[nodiscard]] std::optional<FrameBytes> write(const Message& message, Signing* signing = nullptr,
                                                SigningTime now = 0) {
    const std::optional<Payload> payload = encode(message);
    if (!payload) return std::nullopt;
    return frame(Message::kId, Message::kCrcExtra, *payload, signing, now);
  }

 private:
  FrameBytes frame(std::uint32_t id, std::uint8_t crc_extra, const Payload& payload,
                   Signing* signing, SigningTime now);

  std::uint8_t system_, component_;
  std::uint8_t sequence_ = 0;
};

/// Finds the frames in a stream of bytes. Whatever is in the stream, a frame that is whole is
/// found: a damaged one before it is given up byte by byte, and a false beginning that waits for
/// bytes is given up as soon as two whole frames follow it.
class FrameReader {
 public:
  struct Counters {
    long frames = 0;     ///< given out
    long damaged = 0;    ///< wrong CRC
    long unknown = 0;    ///< of a message that the bridge has no definition of, skipped
    long unsigned_ = 0;  ///< dropped: not signed where signatures are asked for
    long forged = 0;     ///< dropped: wrong signature, or one that was there before
    long skipped = 0;    ///< bytes between frames
  };

  /// \param signing  not null: what is not signed with its key is dropped. It has to outlive this.
  explicit FrameReader(Signing* signing = nullptr) : signing_(signing) {}

  /// Takes bytes, as many as there is room for; how many. Take all frames out by `next` between
  /// calls: then there is room for at least one byte.
  std::size_t push(std::span<const std::uint8_t> bytes);

  /// The next frame, if one is whole.
  [[nodiscard]] std::optional<Frame> next(SigningTime now = 0);

  /// Nothing more comes for what was pushed (the end of a datagram, a pause of the line): what is
  /// not whole by now is no frame. Call `next` again after it.
  void settle() { settled_ = true; }

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  enum class Look { none, more, damaged, unknown, whole };
  struct Found {
    Look look = Look::none;
    std::size_t length = 0;  // of the frame
  };

  [[nodiscard]] Found look_at(std::size_t begin) const;
  [[nodiscard]] bool whole_frame_begins_within(std::size_t length) const;
  [[nodiscard]] bool two_whole_frames_follow() const;
  [[nodiscard]] std::optional<Frame> taken(std::size_t length, SigningTime now);
  [[nodiscard]] bool believed(std::span<const std::uint8_t> frame, const Frame& read,
                              SigningTime now);
  void drop(std::size_t count);

  Signing* signing_;
  std::array<std::uint8_t, 2 * kMostFrame> buffer_{};
  std::size_t size_ = 0;
  bool settled_ = false;
  Counters counters_;
};

}  // namespace saker::flight::mavlink
