#pragma once

#include <string>
#include <string_view>

namespace saker::core {

/// Text as it stands in XML or HTML, between tags or in quotes. Control characters are left out, as
/// XML has none but line ends and tabs, which stay where the text is of several lines.
inline std::string escaped_markup(std::string_view text, bool several_lines = false) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= ' ' || (several_lines && (c == '\n' || c == '\t'))) {
          result += c;
        }
    }
  }
  return result;
}

}  // namespace saker::core
