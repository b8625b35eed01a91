#include "flight/process/service.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "saker/core/error.h"

namespace saker::flight {

void Service::ready() const { sd_notify(0, "READY=1"); }

void Service::say(const std::string& status) const { sd_notify(0, ("STATUS=" + status).c_str()); }

void Service::alive(Steady::time_point now) {
  if (now - fed_ < kFeedPeriod) return;
  fed_ = now;
  sd_notify(0, "WATCHDOG=1");
}

void Service::stopping() const { sd_notify(0, "STOPPING=1"); }

FlightMark::FlightMark() {
  const char* folder = std::getenv("RUNTIME_DIRECTORY");
  if (folder == nullptr) return;
  const std::filesystem::path file = std::filesystem::path(folder) / "in_flight";
  if (std::filesystem::exists(file))
    throw Error(
        "restarted in the middle of a flight: the flight controller lands; start the service again "
        "when the vehicle stands where a mission begins");
  file_ = file;
}

FlightMark::~FlightMark() { clear(); }

void FlightMark::clear() {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

bool FlightMark::set() const { return file_.empty() || std::ofstream(file_).good(); }

bool to_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");  // systemd.exec(5): DEVICE:INODE
  struct stat found {};
  return stream != nullptr && ::fstat(STDERR_FILENO, &found) == 0 &&
         stream == fmt::format("{}:{}", found.st_dev, found.st_ino);
}

std::string journal_error() { return to_journal() ? SD_ERR : ""; }

}  // namespace saker::flight
