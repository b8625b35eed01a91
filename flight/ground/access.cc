#include "flight/ground/access.h"

#include <algorithm>
#include <map>

#include "saker/core/error.h"

namespace saker::flight::ground {
namespace {

namespace fs = std::filesystem;

/// In a time that says nothing of where they differ.
bool same(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

bool is_local_origin(const std::string& origin) {
  if (origin.empty() || origin == "file://") return true;
  for (const std::string scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) return is_this_machine(origin.substr(scheme.size()));
  }
  return false;  // "null", of a page without a place, too
}

}  // namespace

bool is_this_machine(const std::string& host) {
  std::string name = host;
  const std::size_t colon = name.rfind(':');
  const bool port = colon != std::string::npos &&
                    name.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  if (port && name.find(']', colon) == std::string::npos) name.resize(colon);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

bool Gate::admits(const Knock& knock) const {
  if (!key_.empty() && same(knock.key, key_)) return true;
  return this_machine_alone_ && is_this_machine(knock.host) && is_local_origin(knock.origin);
}

const char* media_type(const fs::path& file) {
  static const std::map<std::string, const char*> types = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".json", "application/json"},
      {".txt", "text/plain; charset=utf-8"},
      {".woff2", "font/woff2"}};
  const auto at = types.find(file.extension().string());
  return at == types.end() ? nullptr : at->second;
}

std::optional<fs::path> page_file(const fs::path& page, const std::string& path) {
  if (path.empty() || path.front() != '/' || path.find('\0') != std::string::npos)
    return std::nullopt;
  const fs::path relative = path == "/" ? fs::path("index.html") : fs::path(path.substr(1));
  if (relative.is_absolute()) return std::nullopt;
  for (const fs::path& part : relative) {
    if (part.empty() || part.string().front() == '.') return std::nullopt;
  }
  std::error_code failed;
  const fs::path root = fs::canonical(page, failed);
  if (failed) return std::nullopt;
  const fs::path file = fs::canonical(root / relative, failed);
  if (failed || !fs::is_regular_file(file, failed) || media_type(file) == nullptr)
    return std::nullopt;
  const auto [in_root, rest] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return in_root == root.end() ? std::optional(file) : std::nullopt;
}

fs::path page_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  std::string looked;
  for (const char* place : {"../../../flight/ground/page", "../share/saker/ground"}) {
    const fs::path folder = (program.parent_path() / place).lexically_normal();
    if (fs::is_directory(folder)) return folder;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  throw Error("the page is not there: looked for " + looked);
}

}  // namespace saker::flight::ground
