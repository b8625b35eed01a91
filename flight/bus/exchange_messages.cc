#include "flight/bus/exchange_messages.h"

#include <chrono>

namespace saker::flight {

std::int64_t system_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

exchange_t to_lcm(std::int64_t utime, std::string_view datagram) {
  exchange_t message{};
  message.utime = utime;
  message.data.assign(datagram.begin(), datagram.end());
  message.num_data = static_cast<std::int32_t>(message.data.size());
  return message;
}

std::string_view datagram_of(const exchange_t& message) {
  return {reinterpret_cast<const char*>(message.data.data()), message.data.size()};
}

}  // namespace saker::flight
