#pragma once

#include <cstdint>

namespace saker::core {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Colours that can be told apart on white, also by most who see fewer of them (Okabe and Ito,
/// 2008).
namespace colours {
constexpr Colour kInk{34, 40, 49};
constexpr Colour kGrey{140, 148, 158};
constexpr Colour kBlue{0, 114, 178};
constexpr Colour kOrange{213, 94, 0};
constexpr Colour kGreen{0, 158, 115};
constexpr Colour kPurple{160, 80, 150};
constexpr Colour kYellow{230, 159, 0};
constexpr Colour kSky{86, 180, 233};
}  // namespace colours

}  // namespace saker::core
