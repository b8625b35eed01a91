#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "saker/core/colour.h"

/// Numbers as viewers get them: rounded to 1e-6 of their unit (short in JSON), and left out of an
/// object where they are not known, since JSON has no NaN and plain schemas have no null.
namespace saker::flight::viewers {

using Json = nlohmann::ordered_json;

/// To six decimals. \param value  finite
[[nodiscard]] double rounded(double value);

/// Puts `value` under `key` where it is finite.
void put(Json& object, const char* key, double value);
/// The same of a vector: as an array, where all of it is finite.
void put(Json& object, const char* key, const Eigen::Ref<const Eigen::VectorXd>& value);

/// A finite vector as an array.
[[nodiscard]] Json array(const Eigen::Ref<const Eigen::VectorXd>& value);
/// x, y, z, w.
[[nodiscard]] Json array(const Eigen::Quaterniond& rotation);

/// Red, green, blue, 0 … 1.
[[nodiscard]] Json array(const core::Colour& colour);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace saker::flight::viewers
