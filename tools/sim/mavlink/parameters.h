#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flight/mavlink/config.h"
#include "mavlink/messages.h"

namespace saker::tools {

/// The parameters of a simulated autopilot: those that configs/autopilots names, with the values
/// with which it flies, answered and set as each kind does it. They change nothing of the model.
class AutopilotParameters {
 public:
  explicit AutopilotParameters(flight::mavlink::Autopilot autopilot);

  /// The answer; nothing: there is no such parameter.
  [[nodiscard]] std::optional<flight::mavlink::ParamValue> answer(
      const flight::mavlink::ParamRequestRead& request) const;
  [[nodiscard]] std::optional<flight::mavlink::ParamValue> set(
      const flight::mavlink::ParamSet& request);
  /// All, in their order.
  [[nodiscard]] std::vector<flight::mavlink::ParamValue> all() const;

 private:
  struct Entry {
    double value = 0;
    bool whole = true;
  };
  [[nodiscard]] flight::mavlink::ParamValue message(const std::string& name,
                                                    const Entry& entry) const;
  [[nodiscard]] std::uint8_t type(const Entry& entry) const;

  bool bytewise_;
  std::map<std::string, Entry> entries_;
};

}  // namespace saker::tools
