#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saker::flight {

/// Of a message, what fits into one datagram of 1400 bytes with seal and challenges.
constexpr std::size_t kFragmentBytes = 1280;

/// A piece of a message of one channel.
struct Fragment {
  std::string channel;       ///< "_STATE"
  std::uint32_t number = 0;  ///< of the message on its channel, counted from 1
  std::uint16_t index = 0, count = 1;
  std::string bytes;
};

[[nodiscard]] std::string to_bytes(const Fragment& fragment);
/// Nothing where the bytes are none.
[[nodiscard]] std::optional<Fragment> fragment_of(std::string_view bytes);

/// Puts the messages of one channel together again, whatever was lost or overtook another.
class FragmentJoiner {
 public:
  /// \param every  each message counts, in whatever order they come; else only newer ones
  explicit FragmentJoiner(bool every) : every_(every) {}

  /// The message, when this piece was the last one that was missing.
  [[nodiscard]] std::optional<std::string> add(Fragment fragment);

  /// Messages that were given up for newer ones, or came after newer ones.
  [[nodiscard]] long incomplete() const { return incomplete_; }

 private:
  bool every_;
  std::uint32_t number_ = 0;  // that is put together, or was last
  std::size_t missing_ = 0;
  std::vector<std::optional<std::string>> pieces_;
  long incomplete_ = 0;
};

}  // namespace saker::flight
