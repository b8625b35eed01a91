#include "flight/base_station/sealed.h"

#include <cmath>
#include <cstring>

namespace saker::flight {

std::optional<std::string> sealed_order(exchange::Sealer& sealer, const std::string& channel,
                                        std::int64_t utime, Bus::Bytes message) {
  std::string payload(sizeof utime, '\0');
  std::memcpy(payload.data(), &utime, sizeof utime);
  payload.append(message.begin(), message.end());
  return sealer.seal(channel, payload);
}

std::optional<std::vector<std::uint8_t>> opened_order(exchange::Opener& opener,
                                                      const std::string& channel, Bus::Bytes sealed,
                                                      std::int64_t now_utime, double most_age_s) {
  const exchange::Opened order =
      opener.open(channel, {reinterpret_cast<const char*>(sealed.data()), sealed.size()});
  std::int64_t utime = 0;
  if (order.verdict != exchange::Verdict::genuine || order.payload.size() < sizeof utime)
    return std::nullopt;
  std::memcpy(&utime, order.payload.data(), sizeof utime);
  if (std::abs(static_cast<double>(now_utime) - static_cast<double>(utime)) > most_age_s * 1e6)
    return std::nullopt;
  return std::vector<std::uint8_t>(order.payload.begin() + sizeof utime, order.payload.end());
}

}  // namespace saker::flight
