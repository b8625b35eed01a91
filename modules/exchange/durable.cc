#include "saker/exchange/durable.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace saker::exchange {
namespace {

/// A rename is on the disk when its folder is.
bool sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return false;
  const bool done = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return done;
}

bool take_access(int part, const std::filesystem::path& of) {
  struct stat before {};
  if (::stat(of.c_str(), &before) != 0) return errno == ENOENT;
  return ::fchown(part, before.st_uid, before.st_gid) == 0 &&
         ::fchmod(part, before.st_mode & (S_IRWXU | S_IRWXG)) == 0;
}

}  // namespace

bool write_durably(const std::filesystem::path& file, std::string_view content, Access access) {
  const std::string part = file.string() + ".part";
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  const bool written = (access == Access::owner || take_access(descriptor, file)) &&
                       write_at(descriptor, content, 0) && ::fsync(descriptor) == 0;
  const bool closed = ::close(descriptor) == 0;
  return written && closed && std::rename(part.c_str(), file.c_str()) == 0 &&
         sync_folder(file.parent_path());
}

bool write_at(int file, std::string_view bytes, std::size_t offset) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(done));
    offset += static_cast<std::size_t>(done);
  }
  return true;
}

}  // namespace saker::exchange
