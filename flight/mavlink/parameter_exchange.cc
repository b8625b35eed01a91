#include "flight/mavlink/parameter_exchange.h"

#include <bit>
#include <utility>

#include "flight/mavlink/codec.h"

namespace saker::flight::mavlink {
namespace {

/// MAV_PARAM_TYPE of whole numbers up to 32 bits: 1, 3, 5 unsigned, 2, 4, 6 signed.
bool is_whole(std::uint8_t type) { return type >= 1 && type <= 6; }
bool is_signed(std::uint8_t type) { return type % 2 == 0; }

}  // namespace

double value_of(float field, std::uint8_t type, bool bytewise) {
  if (!bytewise || !is_whole(type)) return static_cast<double>(field);
  const auto bits = std::bit_cast<std::uint32_t>(field);
  return is_signed(type) ? static_cast<double>(static_cast<std::int32_t>(bits))
                         : static_cast<double>(bits);
}

float field_of(double value, std::uint8_t type, bool bytewise) {
  if (!bytewise || !is_whole(type)) return static_cast<float>(value);
  const auto whole = static_cast<std::int64_t>(std::llround(value));
  return std::bit_cast<float>(static_cast<std::uint32_t>(whole));
}

ParameterExchange::ParameterExchange(std::vector<Parameter> parameters, std::uint8_t system,
                                     std::uint8_t component, bool bytewise)
    : parameters_(std::move(parameters)),
      system_(system),
      component_(component),
      bytewise_(bytewise) {}

std::optional<ParameterExchange::Request> ParameterExchange::due(Time now) {
  if (done() || now < next_try_) return std::nullopt;
  if (tries_ == kMostTries) {
    next(ParameterOutcome::missing);
    if (done()) return std::nullopt;
  }
  ++tries_;
  next_try_ = now + kAnswer;
  const Parameter& parameter = parameters_[at_];
  if (parameter.set) {
    ParamSet request;
    request.param_value = field_of(*parameter.set, parameter.type, bytewise_);
    request.target_system = system_;
    request.target_component = component_;
    write_text(parameter.name, request.param_id);
    request.param_type = parameter.type;
    return request;
  }
  ParamRequestRead request;
  request.param_index = -1;
  request.target_system = system_;
  request.target_component = component_;
  write_text(parameter.name, request.param_id);
  return request;
}

void ParameterExchange::hear(const ParamValue& message) {
  if (done() || tries_ == 0 || text_of(message.param_id) != parameters_[at_].name) return;
  Parameter& parameter = parameters_[at_];
  parameter.type = message.param_type;
  parameter.value = value_of(message.param_value, message.param_type, bytewise_);
  const bool as_set =
      !parameter.set || static_cast<float>(*parameter.set) == static_cast<float>(parameter.value);
  next(as_set ? ParameterOutcome::known : ParameterOutcome::refused);
}

void ParameterExchange::next(ParameterOutcome outcome) {
  parameters_[at_++].outcome = outcome;
  tries_ = 0;
  next_try_ = 0;
}

}  // namespace saker::flight::mavlink
