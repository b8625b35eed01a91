#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mavlink/messages.h"
#include "saker/core/time.h"

/// Parameters of an autopilot, read and written one after another over a line that loses messages.
///
/// Makes PARAM_REQUEST_READ and PARAM_SET, reads PARAM_VALUE. No socket, no clock. Source: the
/// MAVLink developer guide, "Parameter protocol": ArduPilot casts whole numbers to float, PX4 puts
/// their bytes into the float's.
namespace saker::flight::mavlink {

enum class ParameterOutcome : std::uint8_t {
  waiting,
  known,    ///< read, or written and read back
  missing,  ///< no answer to `most_tries`: the autopilot has no such parameter
  refused,  ///< written, and another value came back
};

struct Parameter {
  std::string name;
  std::optional<double> set = std::nullopt;  ///< to be written; nothing: to be read
  ParameterOutcome outcome = ParameterOutcome::waiting;
  double value = NAN;     ///< as the autopilot has it
  std::uint8_t type = 0;  ///< MAV_PARAM_TYPE, from the reading: a writing needs it
};

class ParameterExchange {
 public:
  using Request = std::variant<ParamRequestRead, ParamSet>;

  static constexpr Time kAnswer = kNanosecondsPerSecond / 2;  ///< without one it is asked again …
  static constexpr int kMostTries = 5;                        ///< … so often in all

  /// \param bytewise  as PX4 does it
  ParameterExchange(std::vector<Parameter> parameters, std::uint8_t system, std::uint8_t component,
                    bool bytewise);

  /// What to send now, if anything.
  [[nodiscard]] std::optional<Request> due(Time now);
  /// What is not asked for is ignored.
  void hear(const ParamValue& message);

  [[nodiscard]] bool done() const { return at_ == parameters_.size(); }
  /// In the order in which they were given.
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }

 private:
  void next(ParameterOutcome outcome);

  std::vector<Parameter> parameters_;
  std::uint8_t system_, component_;
  bool bytewise_;
  std::size_t at_ = 0;  // the one that is waited for
  int tries_ = 0;
  Time next_try_ = 0;
};

/// The value in PARAM_VALUE's and PARAM_SET's field. \param type  MAV_PARAM_TYPE
[[nodiscard]] double value_of(float field, std::uint8_t type, bool bytewise);
[[nodiscard]] float field_of(double value, std::uint8_t type, bool bytewise);

}  // namespace saker::flight::mavlink
