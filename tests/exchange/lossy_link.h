#pragma once

#include <map>
#include <optional>
#include <string>

#include "saker/core/rng.h"
#include "saker/core/time.h"

namespace saker::exchange {

struct LossConfig {
  double loss = 0.3;
  double repeated = 0.1;    // of those that arrive
  double delay_s = 0.004;   // of all
  double jitter_s = 0.015;  // uniform on top: what makes datagrams overtake each other
};

/// A link in one direction that loses, repeats and reorders.
class LossyLink {
 public:
  LossyLink(const LossConfig& config, core::Rng rng) : config_(config), rng_(rng) {}

  void send(Time now, const std::string& datagram) {
    ++sent;
    if (rng_.chance(config_.loss)) return;
    arrives(now, datagram);
    if (rng_.chance(config_.repeated)) arrives(now, datagram);
  }

  /// The next one that has arrived by `now`.
  std::optional<std::string> receive(Time now) {
    if (under_way_.empty() || under_way_.begin()->first > now) return std::nullopt;
    std::string datagram = std::move(under_way_.begin()->second);
    under_way_.erase(under_way_.begin());
    return datagram;
  }

  long sent = 0;

 private:
  void arrives(Time now, const std::string& datagram) {
    const double delay = config_.delay_s + rng_.uniform(0, config_.jitter_s);
    under_way_.emplace(now + from_seconds(delay), datagram);
  }

  LossConfig config_;
  core::Rng rng_;
  std::multimap<Time, std::string> under_way_;
};

}  // namespace saker::exchange
