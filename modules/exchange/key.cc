#include "saker/exchange/key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/durable.h"

namespace saker::exchange {
namespace {

void start_sodium() {
  if (sodium_init() < 0) throw Error("libsodium does not start: no source of random numbers");
}

void refuse_readable(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  }
  if ((found.st_mode & (S_IROTH | S_IWOTH)) != 0) {
    throw Error(
        fmt::format("{}: everybody may read or write the key (mode {:04o}), mend with: "
                    "chmod o-rwx {}",
                    file.string(), found.st_mode & 07777, file.string()));
  }
}

}  // namespace

Key read_key(const std::filesystem::path& file) {
  start_sodium();
  refuse_readable(file);
  std::string digits = core::read_file(file);
  while (!digits.empty() && (digits.back() == '\n' || digits.back() == '\r')) digits.pop_back();
  Key key{};
  std::size_t size = 0;
  const char* end = nullptr;
  const bool read = sodium_hex2bin(key.data(), key.size(), digits.data(), digits.size(), nullptr,
                                   &size, &end) == 0;
  const bool whole = end == digits.data() + digits.size() && size == key.size();
  sodium_memzero(digits.data(), digits.size());
  if (!read || !whole) {
    throw Error(
        fmt::format("{}: not a key, expected {} hexadecimal digits (saker base key -o FILE)",
                    file.string(), 2 * key.size()));
  }
  return key;
}

void make_key_file(const std::filesystem::path& file) {
  start_sodium();
  Key key{};
  randombytes_buf(key.data(), key.size());
  std::array<char, 2 * key.size() + 1> digits{};
  sodium_bin2hex(digits.data(), digits.size(), key.data(), key.size());
  digits.back() = '\n';
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
  }
  const bool written =
      write_at(descriptor, {digits.data(), digits.size()}, 0) && ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!written) throw Error(fmt::format("cannot write {}: disk full?", file.string()));
}

}  // namespace saker::exchange
