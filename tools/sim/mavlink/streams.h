#pragma once

#include <cstdint>
#include <vector>

#include "saker/core/time.h"
#include "tools/sim/mavlink/quirks.h"

/// When which message of the autopilot is due: SET_MESSAGE_INTERVAL and its own streams.
namespace saker::tools {

class Streams {
 public:
  explicit Streams(const Quirks& quirks);

  /// Whether it has such a message at all.
  [[nodiscard]] bool knows(std::uint32_t id) const;
  /// \param interval_us  −1: not any more; 0: as at the beginning. False where it is not known.
  bool ask(std::uint32_t id, double interval_us);
  [[nodiscard]] std::vector<std::uint32_t> due(Time now);

 private:
  struct Stream {
    std::uint32_t id;
    Time own_period;  // 0: none
    Time period;
    Time next = 0;
  };

  std::vector<Stream> streams_;
};

}  // namespace saker::tools
