#pragma once

#include <bitset>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "saker/exchange/key.h"
#include "saker/exchange/stream.h"

/// Messages that only the team can write, read and say once.
///
/// A sealed message: version (1 byte), length of the sender's name and the name, the sender's
/// counter (8 bytes), length of the payload (2 bytes), then the payload encrypted and
/// authenticated by XChaCha20-Poly1305 (draft-irtf-cfrg-xchacha; libsodium) with the team's key.
/// The nonce is made of name and counter; the channel and everything before the payload are
/// authenticated with it. A counter is never used twice, nor taken twice. What is held back and
/// comes late, but for the first time, is taken: where that matters, the message has its own time.
namespace saker::exchange {

/// A sealed message is longer than its payload by this at most.
constexpr std::size_t kSealBytes = 1 + 1 + kLongestName + 8 + 2 + 16;
constexpr std::size_t kLongestPayload = 65000;

/// Seals what one process sends. Counters are reserved in blocks, durably and before any is used,
/// so that none is used again whatever ends the process or the machine.
class Sealer {
 public:
  /// \param sender  this process's name in the team, of its own: 1 … kLongestName bytes
  /// \param counter_file  where reserved counters are kept; its folder has to exist
  /// Throws Error when the file cannot be read or written.
  Sealer(const Key& key, std::string sender, std::filesystem::path counter_file);
  ~Sealer();
  Sealer(const Sealer&) = delete;
  Sealer& operator=(const Sealer&) = delete;

  /// Nothing when no more counters can be reserved (a full disk) or the payload is too long.
  [[nodiscard]] std::optional<std::string> seal(const std::string& channel,
                                                std::string_view payload);

  [[nodiscard]] const std::string& sender() const { return sender_; }

 private:
  [[nodiscard]] bool reserve();

  Key key_;
  std::string sender_;
  std::filesystem::path file_;
  std::uint64_t next_ = 0, reserved_ = 0;  // the next counter; the first that is not reserved
};

/// What became of a message that came in.
enum class Verdict : std::uint8_t {
  genuine,
  own,       ///< this process's own, heard again
  cut,       ///< shorter or longer than it says
  unknown,   ///< another version, or more senders than the ceiling
  forged,    ///< not sealed with the team's key for this channel
  replayed,  ///< taken before, or too old to know
  unkept,    ///< genuine, but the disk does not take that it was heard
};
constexpr int kVerdicts = 7;

[[nodiscard]] std::vector<std::string> enum_names(Verdict);

struct Opened {
  Verdict verdict = Verdict::cut;
  std::string sender;   ///< of a genuine one
  std::string payload;  ///< of a genuine one
};

/// Opens what comes in. Of every sender the newest counters that were heard are on file before
/// their message is given out, so that none is taken twice, also after kill -9.
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

  /// How many messages had this verdict.
  [[nodiscard]] long count(Verdict verdict) const {
    return counts_[static_cast<std::size_t>(verdict)];
  }

 private:
  static constexpr std::size_t kWindow = 1024;  // counters behind the newest that are told apart
  static constexpr std::size_t kMostSenders = 64;

  struct Window {
    std::size_t slot = 0;  // in the file
    std::uint64_t newest = 0;
    std::bitset<kWindow> heard{};  // [i]: newest − i was heard
  };

  [[nodiscard]] Opened judged(const std::string& channel, std::string_view sealed);
  [[nodiscard]] Verdict take(const std::string& sender, std::uint64_t counter);
  [[nodiscard]] bool keep(const std::string& sender, const Window& window) const;
  void load(const std::filesystem::path& file);

  Key key_;
  std::string own_;
  int file_ = -1;
  std::map<std::string, Window> windows_;
  std::array<long, kVerdicts> counts_{};
};

}  // namespace saker::exchange
