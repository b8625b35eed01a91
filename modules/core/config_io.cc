#include "saker/core/config_io.h"

namespace saker::core {
namespace {

constexpr std::size_t kMostColumns = 110;  // a longer comment stands above its key

}  // namespace

void ConfigSaver::add(const char* name, const std::string& value, const std::string& comment) {
  const std::string line = indent_ + name + ":" + (value.empty() ? "" : " " + value);
  if (!comments_ || comment.empty()) {
    text_ += line + "\n";
  } else if (line.size() + 4 + comment.size() <= kMostColumns) {
    text_ += line + "  # " + comment + "\n";
  } else {
    text_ += indent_ + "# " + comment + "\n" + line + "\n";
  }
}

/// The dash goes before the first key, which a comment may precede.
std::string ConfigSaver::as_list_entry() const {
  std::string entry = text_;
  std::size_t line = 0;
  while (line < entry.size() && entry[line + indent_.size()] == '#') {
    line = entry.find('\n', line) + 1;
  }
  if (line < entry.size()) entry[line + indent_.size() - 2] = '-';
  return entry;
}

}  // namespace saker::core
