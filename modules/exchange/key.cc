#include "saker/exchange/key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>
#include <string>
#include <system_error>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/durable.h"
#include "saker/exchange/stream.h"

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

/// Whether these are the digits of a key.
bool read_digits(const std::string& digits, Key& key) {
  std::size_t size = 0;
  const char* end = nullptr;
  return sodium_hex2bin(key.data(), key.size(), digits.data(), digits.size(), nullptr, &size,
                        &end) == 0 &&
         end == digits.data() + digits.size() && size == key.size();
}

std::string digits_of(const Key& key) {
  std::string digits(2 * key.size() + 1, '\0');
  sodium_bin2hex(digits.data(), digits.size(), key.data(), key.size());
  digits.back() = '\n';
  return digits;
}

/// "R1 2" → a line of the team's file.
bool read_renewed(const std::string& line, Key& key) {
  const std::size_t space = line.find(' ');
  const std::string robot = line.substr(0, space);
  if (space == std::string::npos || !is_name(robot)) return false;
  std::uint32_t count = 0;
  const char* const end = line.data() + line.size();
  const auto [stop, fault] = std::from_chars(line.data() + space + 1, end, count);
  key.renewed[robot] = count;
  return fault == std::errc{} && stop == end;
}

bool read_text(const std::string& text, Key& key) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (!line.empty() && line.back() == '\r') line.pop_back();
  if (const std::size_t space = line.find(' '); space != std::string::npos) {
    key.robot = line.substr(0, space);
    return is_name(key.robot) && read_digits(line.substr(space + 1), key) &&
           !std::getline(lines, line);
  }
  if (!read_digits(line, key)) return false;
  while (std::getline(lines, line)) {
    if (!line.empty() && !read_renewed(line, key)) return false;
  }
  return true;
}

void write_new(const std::filesystem::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
  }
  const bool written = write_at(descriptor, text, 0) && ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!written) throw Error(fmt::format("cannot write {}: disk full?", file.string()));
}

void replace(const std::filesystem::path& file, const std::string& text) {
  if (!write_durably(file, text, Access::kept))
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

void check_robot(const std::string& robot) {
  if (is_name(robot)) return;
  throw Error(fmt::format("robot {}, expected up to {} capitals and digits", robot, kLongestName));
}

}  // namespace

Key read_key(const std::filesystem::path& file) {
  start_sodium();
  refuse_readable(file);
  std::string text = core::read_file(file);
  Key key{};
  const bool read = read_text(text, key);
  sodium_memzero(text.data(), text.size());
  if (!read) {
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
  write_new(file, digits_of(key));
}

std::optional<Key> key_of(const Key& key, const std::string& robot) {
  if (key.robot == robot) return key;
  if (!key.robot.empty()) return std::nullopt;
  const auto renewed = key.renewed.find(robot);
  ByteWriter what;
  what.text("saker robot");
  what.text(robot);
  what.fixed(renewed == key.renewed.end() ? std::uint32_t{0} : renewed->second);
  Key own{};
  own.robot = robot;
  crypto_generichash(own.data(), own.size(),
                     reinterpret_cast<const unsigned char*>(what.bytes().data()),
                     what.bytes().size(), key.data(), key.size());
  return own;
}

void make_robot_key_file(const Key& key, const std::string& robot,
                         const std::filesystem::path& file, Existing existing) {
  check_robot(robot);
  if (!key.robot.empty()) {
    throw Error(
        fmt::format("this is the key of {}, expected the team's: no other robot's follows "
                    "from it",
                    key.robot));
  }
  const std::string text = robot + " " + digits_of(*key_of(key, robot));
  existing == Existing::replaced ? replace(file, text) : write_new(file, text);
}

void renew_key(const std::filesystem::path& team_file, const std::string& robot,
               const std::filesystem::path& robot_file) {
  check_robot(robot);
  Key key = read_key(team_file);
  if (!key.robot.empty()) {
    throw Error(
        fmt::format("{}: the key of {}, expected the team's", team_file.string(), key.robot));
  }
  ++key.renewed[robot];
  make_robot_key_file(key, robot, robot_file, Existing::replaced);
  std::string text = digits_of(key);
  for (const auto& [name, count] : key.renewed) text += fmt::format("{} {}\n", name, count);
  replace(team_file, text);
}

void require_key_of(const Key& key, const std::string& name) {
  if (key.robot.empty() || key.robot == name) return;
  throw Error(
      fmt::format("the key is that of {}, expected that of {} or the team's", key.robot, name));
}

std::string team_key_note(const std::filesystem::path& file) {
  std::error_code hidden;
  if (!std::filesystem::exists(file, hidden) || !read_key(file).robot.empty()) return "";
  return fmt::format(
      "{} is the team's key: with this robot every robot's is lost; its own is enough (saker base "
      "key --robot)",
      file.string());
}

}  // namespace saker::exchange
