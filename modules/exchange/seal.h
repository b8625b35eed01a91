#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saker/exchange/key.h"
#include "saker/exchange/replay_window.h"
#include "saker/exchange/stream.h"

/// Messages that only the team can write, read and say once.
///
/// A sealed message: version (1 byte), length of the sender's name and the name, a random nonce
/// (24 bytes), length of the payload (2 bytes); then, encrypted and authenticated by
/// XChaCha20-Poly1305 (draft-irtf-cfrg-xchacha; libsodium) with the key of the robot that the
/// channel names: the sender's epoch and counter (8 bytes each) and the payload. The channel and
/// all that stands before are authenticated with it.
///
/// Two messages may carry one epoch and one counter (a copied disk, two robots of one name): as
/// nonces are drawn, nothing but a message is lost by it. An epoch is a sender's life: when it
/// began (ms of the system clock, upper 42 bits) and 22 drawn bits, always above the one before
/// that is on its disk. A receiver takes each counter once; a later epoch ends those before it. So
/// a sender that lost its file is taken again where its clock is right, and by a renewed key
/// (key.h) where it is not. What is held back and comes late, but for the first time, is taken:
/// where that matters, the message has its own time.
namespace saker::exchange {

/// A sealed message is longer than its payload by this at most.
constexpr std::size_t kSealBytes = 1 + 1 + kLongestName + 24 + 2 + 8 + 8 + 16;
constexpr std::size_t kLongestPayload = 65000;
/// An Opener knows so many senders, each for each robot's channel, and forgets none.
constexpr std::size_t kMostSenders = 64;

/// What became of a message that came in.
enum class Verdict : std::uint8_t {
  genuine,
  own,         ///< this process's own, heard again
  cut,         ///< shorter or longer than it says
  unknown,     ///< another version, or more senders than the ceiling
  forged,      ///< not sealed with the robot's key for this channel
  replayed,    ///< taken before, or too old to know
  unkept,      ///< genuine, but the disk does not take that it was heard
  superseded,  ///< of an earlier life of its sender than the newest that was heard
};
constexpr int kVerdicts = 8;

[[nodiscard]] std::vector<std::string> enum_names(Verdict);

struct Opened {
  Verdict verdict = Verdict::cut;
  std::string sender{};  ///< of a genuine one, as all that follows
  std::string payload{};
  std::uint64_t epoch = 0, counter = 0;
};

/// Seals what one process sends. Its epoch is on the disk before it is used.
class Sealer {
 public:
  /// \param sender  this process's name in the team, of its own: 1 … kLongestName bytes
  /// \param epoch_file  where the newest epoch is kept, its folder has to exist; empty: nowhere,
  ///     for receivers that ask who lives (flight/link/session.h)
  /// \param start_ms  of the system clock; nothing: now
  /// Throws Error when the file cannot be read or written.
  Sealer(const Key& key, std::string sender, const std::filesystem::path& epoch_file,
         std::optional<std::int64_t> start_ms = std::nullopt);
  ~Sealer();
  Sealer(const Sealer&) = delete;
  Sealer& operator=(const Sealer&) = delete;

  /// Nothing when the payload is too long, or the channel names a robot whose key this is not.
  [[nodiscard]] std::optional<std::string> seal(const std::string& channel,
                                                std::string_view payload);

  [[nodiscard]] const std::string& sender() const { return sender_; }
  [[nodiscard]] std::uint64_t epoch() const { return epoch_; }

  /// What is sealed with the same key: this process's own messages, and those of another that uses
  /// its name, too. Whether it came before is not asked.
  [[nodiscard]] Opened opened(const std::string& channel, std::string_view sealed) const;

 private:
  Key key_;
  std::string sender_;
  std::uint64_t epoch_ = 0, counter_ = 0;
};

/// Opens one message; whether it came before is not asked.
/// \param own  the name under which this process seals
[[nodiscard]] Opened unsealed(const Key& key, const std::string& own, const std::string& channel,
                              std::string_view sealed);

/// Opens what comes in. Of every sender the newest counters that were heard are on the disk before
/// their message is given out, so that none is taken twice, also after a power cut: a message costs
/// one write of a disk's page.
class Opener {
 public:
  /// \param own  the name under which this process seals
  /// \param window_file  where counters that were heard are kept; its folder has to exist
  /// Throws Error when the file cannot be read, written or is none.
  Opener(const Key& key, std::string own, const std::filesystem::path& window_file);
  ~Opener();
  Opener(const Opener&) = delete;
  Opener& operator=(const Opener&) = delete;

  [[nodiscard]] Opened open(const std::string& channel, std::string_view sealed);

  /// Whoever it did not hear before is `unknown` from now on.
  [[nodiscard]] bool full() const { return heard_.size() >= kMostSenders; }
  /// How many messages had this verdict.
  [[nodiscard]] long count(Verdict verdict) const {
    return counts_[static_cast<std::size_t>(verdict)];
  }

 private:
  /// Who seals, with which robot's key.
  using Pair = std::pair<std::string, std::string>;
  /// What was heard of a pair, and with which key: a renewed one begins anew.
  struct Heard {
    std::size_t slot = 0;  // in the file
    std::uint64_t key = 0, epoch = 0;
    ReplayWindow window{};
  };

  [[nodiscard]] Verdict take(const std::string& robot, const Opened& message);
  [[nodiscard]] bool keep(const Pair& pair, const Heard& heard) const;
  void load(const std::filesystem::path& file);

  Key key_;
  std::string own_;
  int file_ = -1;
  std::map<Pair, Heard> heard_;
  std::array<long, kVerdicts> counts_{};
};

}  // namespace saker::exchange
