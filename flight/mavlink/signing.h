#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

/// Message signing: who does not have the key is neither believed nor heard.
///
/// Source: the MAVLink developer guide, "Message signing". A signature is the first 48 bits of
/// SHA-256 (libsodium) of key, frame, link and time stamp.
namespace saker::flight::mavlink {

using SigningKey = std::array<std::uint8_t, 32>;
using Signature = std::array<std::uint8_t, 6>;

/// Units of 10 µs since 2015-01-01 (UTC), of which 48 bits are sent.
using SigningTime = std::uint64_t;

/// \param unix_us  microseconds of the system clock; what is before 2015 counts as 2015
[[nodiscard]] SigningTime signing_time(std::int64_t unix_us);

/// 32 bytes as 64 hexadecimal digits. Throws Error where the file is none, or others may read it.
[[nodiscard]] SigningKey read_signing_key(const std::filesystem::path& file);

/// \param frame  from the magic byte to the checksum
[[nodiscard]] Signature signature_of(const SigningKey& key, std::span<const std::uint8_t> frame,
                                     std::uint8_t link, SigningTime stamp);

/// What a signed frame says of itself.
struct SignedBy {
  std::uint8_t system = 0, component = 0, link = 0;
  SigningTime stamp = 0;
};

/// The time stamps of one line: ours ascend, and what was signed before is not believed again.
class SigningClock {
 public:
  /// At most so many senders of so many links are known at once; further ones are refused.
  static constexpr std::size_t kMostStreams = 16;
  static constexpr SigningTime kOldest = 60 * 100'000;  ///< a minute, of a stream not heard before

  /// For the next frame that we sign: the time, and always later than the one before it.
  [[nodiscard]] SigningTime next(SigningTime now);

  /// Whether a frame whose signature is right is new. It changes nothing where it is not.
  [[nodiscard]] bool accept(const SignedBy& by, SigningTime now);

 private:
  struct Stream {
    SignedBy last;
    bool used = false;
  };

  SigningTime newest_ = 0;  // of ours and of what was accepted
  std::array<Stream, kMostStreams> streams_{};
};

}  // namespace saker::flight::mavlink
