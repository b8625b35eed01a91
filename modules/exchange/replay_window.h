#pragma once

#include <bitset>
#include <cstdint>

namespace saker::exchange {

/// Which counters of one sender's life were taken: the newest, and which of the kCounters up to it.
/// Source: the sliding window of IPsec (RFC 4303, section 3.4.3).
class ReplayWindow {
 public:
  static constexpr std::size_t kCounters = 1024;
  using Taken = std::bitset<kCounters>;

  ReplayWindow() = default;
  ReplayWindow(std::uint64_t newest, const Taken& taken) : newest_(newest), taken_(taken) {}

  /// False where it was taken before, or is too old to know.
  [[nodiscard]] bool take(std::uint64_t counter) {
    if (counter > newest_) {
      const std::uint64_t ahead = counter - newest_;
      taken_ = ahead < kCounters ? taken_ << ahead : Taken();
      newest_ = counter;
    }
    const std::uint64_t behind = newest_ - counter;
    if (behind >= kCounters || taken_[behind]) return false;
    taken_.set(behind);
    return true;
  }

  [[nodiscard]] std::uint64_t newest() const { return newest_; }
  /// [i]: newest − i was taken.
  [[nodiscard]] const Taken& taken() const { return taken_; }

 private:
  std::uint64_t newest_ = 0;
  Taken taken_{};
};

}  // namespace saker::exchange
