#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "mavlink/messages.h"

/// A message's fields ↔ its payload: little-endian, in the order of the definition.
///
/// Source: the MAVLink developer guide, "Packet serialization".
namespace saker::flight::mavlink {

inline constexpr std::size_t kMostPayload = 255;

/// The bytes of one message; `length` of them are sent.
struct Payload {
  std::array<std::uint8_t, kMostPayload> bytes{};
  std::size_t length = 0;
};

namespace codec {

static_assert(std::endian::native == std::endian::little, "fields are copied as they are");

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

template <class T>
[[nodiscard]] bool is_finite(const T& value) {
  if constexpr (IsArray<T>::value)
    return std::all_of(value.begin(), value.end(), [](const auto& v) { return is_finite(v); });
  else if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(value);
  else
    return true;
}

}  // namespace codec

/// Whether no field is NaN or infinite.
template <class Message>
[[nodiscard]] bool is_finite(const Message& message) {
  bool finite = true;
  Message::visit(
      message, [&](const char*, const auto& field) { finite = finite && codec::is_finite(field); });
  return finite;
}

/// Nothing where a field is NaN or infinite: ArduPilot's simulator ends itself on one, and no
/// message of ours needs one. All fields are there; trailing zeros are cut when it is framed.
template <class Message>
[[nodiscard]] std::optional<Payload> encode(const Message& message) {
  static_assert(Message::kLength <= kMostPayload);
  if (!is_finite(message)) return std::nullopt;
  Payload payload;
  Message::visit(message, [&](const char*, const auto& field) {
    std::memcpy(payload.bytes.data() + payload.length, &field, sizeof field);
    payload.length += sizeof field;
  });
  return payload;
}

/// What is missing at the end is zero; what is there beyond the definition is of a newer one and
/// ignored. Numbers may be NaN: whoever uses a field checks it.
template <class Message>
[[nodiscard]] Message decode(std::span<const std::uint8_t> payload) {
  std::array<std::uint8_t, Message::kLength> bytes{};
  std::copy_n(payload.begin(), std::min(payload.size(), bytes.size()), bytes.begin());
  Message message;
  std::size_t at = 0;
  Message::visit(message, [&](const char*, auto& field) {
    std::memcpy(&field, bytes.data() + at, sizeof field);
    at += sizeof field;
  });
  return message;
}

/// A text field, up to its first zero. What is not printable ASCII becomes '?': it goes into logs.
template <std::size_t N>
[[nodiscard]] std::string text_of(const std::array<char, N>& field) {
  std::string text(field.begin(), std::find(field.begin(), field.end(), '\0'));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

/// Cut to the field's length.
template <std::size_t N>
void write_text(std::string_view text, std::array<char, N>& field) {
  field.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), N), field.begin());
}

}  // namespace saker::flight::mavlink
