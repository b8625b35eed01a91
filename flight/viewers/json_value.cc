#include "flight/viewers/json_value.h"

#include <cmath>

namespace saker::flight::viewers {

double rounded(double value) {
  constexpr double kSteps = 1e6;           // a unit
  constexpr double kFraction = 4.5035e15;  // doubles above it have none
  const double scaled = value * kSteps;
  return std::abs(scaled) < kFraction ? std::round(scaled) / kSteps : value;
}

void put(Json& object, const char* key, double value) {
  if (std::isfinite(value)) object[key] = rounded(value);
}

void put(Json& object, const char* key, const Eigen::Ref<const Eigen::VectorXd>& value) {
  if (value.allFinite()) object[key] = array(value);
}

Json array(const Eigen::Ref<const Eigen::VectorXd>& value) {
  Json result = Json::array();
  for (const double v : value) result.push_back(rounded(v));
  return result;
}

Json array(const Eigen::Quaterniond& rotation) { return array(rotation.coeffs()); }

Json array(const core::Colour& colour) {
  return array(Eigen::Vector3d(colour.red, colour.green, colour.blue) / 255);
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t word = static_cast<std::uint32_t>(bytes[i]) << 16 |
                               (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0u) |
                               (left > 2 ? bytes[i + 2] : 0u);
    text += kDigits[word >> 18];
    text += kDigits[word >> 12 & 63];
    text += left > 1 ? kDigits[word >> 6 & 63] : '=';
    text += left > 2 ? kDigits[word & 63] : '=';
  }
  return text;
}

}  // namespace saker::flight::viewers
