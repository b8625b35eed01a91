#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace saker::core {

/// A line of text that allocates nothing, for loops that must not wait for memory. What is longer
/// than kMost bytes is cut. Converts from and to std::string, so that who does not fly may forget
/// about it.
class Text {
 public:
  static constexpr std::size_t kMost = 480;  ///< twice what MISSION carries of a cause

  Text() = default;
  Text(std::string_view text) { append(text); }
  Text(const char* text) : Text(std::string_view(text)) {}
  Text(const std::string& text) : Text(std::string_view(text)) {}
  Text(const Text& other) : Text(other.view()) {}  // copies what is there alone
  Text& operator=(const Text& other) {
    if (this == &other) return *this;
    size_ = 0;
    return append(other.view());
  }

  Text& append(std::string_view text) {
    const std::size_t more = std::min(text.size(), kMost - size_);
    if (more > 0) std::memcpy(bytes_ + size_, text.data(), more);
    size_ += more;
    return *this;
  }
  Text& operator+=(const Text& text) { return append(text.view()); }
  void clear() { size_ = 0; }

  [[nodiscard]] std::string_view view() const { return {bytes_, size_}; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t find(std::string_view what) const { return view().find(what); }
  operator std::string() const { return std::string(view()); }

  friend Text operator+(Text a, const Text& b) { return a += b; }
  friend bool operator==(const Text& a, const Text& b) { return a.view() == b.view(); }
  friend std::ostream& operator<<(std::ostream& out, const Text& text) {
    return out << text.view();
  }

 private:
  std::size_t size_ = 0;
  char bytes_[kMost];
};

/// fmt::format without memory: `text("{:.1f} m off", off)`.
template <class... Arguments>
[[nodiscard]] Text text(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
  char bytes[Text::kMost];
  const auto end =
      fmt::format_to_n(bytes, Text::kMost, form, std::forward<Arguments>(arguments)...);
  return Text(std::string_view(bytes, std::min(end.size, Text::kMost)));
}

}  // namespace saker::core

template <>
struct fmt::formatter<saker::core::Text> : fmt::formatter<std::string_view> {
  template <class Context>
  auto format(const saker::core::Text& text, Context& context) const {
    return fmt::formatter<std::string_view>::format(text.view(), context);
  }
};
