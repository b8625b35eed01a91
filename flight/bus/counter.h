#pragma once

#include <string>
#include <utility>

#include "saker/counter_t.hpp"

namespace saker::flight {

/// An entry of `_HEALTH`.
[[nodiscard]] inline counter_t counter(std::string name, long value) {
  counter_t message{};
  message.name = std::move(name);
  message.value = value;
  return message;
}

}  // namespace saker::flight
