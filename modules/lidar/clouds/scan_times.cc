#include "saker/lidar/clouds/scan_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr Time kTenthOfSecond = kNanosecondsPerSecond / 10;
constexpr double kLargestTime = 9e9;  // seconds; beyond it nanoseconds overflow
constexpr Time kLargestTime_ns = 9 * kNanosecondsPerSecond * kNanosecondsPerSecond;

fs::path beside(const fs::path& scans, const char* name) {
  std::error_code ignored;
  for (const fs::path& file : {scans / name, parent_of(scans) / name}) {
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return {};
}

std::optional<Time> seconds_in(const std::string& line) {
  char* end = nullptr;
  const double seconds = std::strtod(line.c_str(), &end);
  const bool whole =
      end != line.c_str() &&
      line.find_first_not_of(" \t\r", static_cast<std::size_t>(end - line.c_str())) ==
          std::string::npos;
  if (!whole || !(std::abs(seconds) < kLargestTime)) return std::nullopt;
  return from_seconds(seconds);
}

/// "2011-09-26 13:02:25.951199337"
std::optional<Time> date_in(const std::string& line) {
  std::tm date = {};
  double seconds = 0;
  if (std::sscanf(line.c_str(), "%d-%d-%d %d:%d:%lf", &date.tm_year, &date.tm_mon, &date.tm_mday,
                  &date.tm_hour, &date.tm_min, &seconds) != 6) {
    return std::nullopt;
  }
  const auto inside = [](int value, int least, int most) {
    return value >= least && value <= most;
  };
  if (!inside(date.tm_year, 1970, 2200) || !inside(date.tm_mon, 1, 12) ||
      !inside(date.tm_mday, 1, 31) || !inside(date.tm_hour, 0, 23) || !inside(date.tm_min, 0, 59) ||
      !(seconds >= 0 && seconds < 61)) {
    return std::nullopt;
  }
  date.tm_year -= 1900;
  date.tm_mon -= 1;
  return ::timegm(&date) * kNanosecondsPerSecond + from_seconds(seconds);
}

template <class Parse>
std::vector<Time> read_times(const fs::path& file, Parse&& parse, const char* expected) {
  std::ifstream in(file);
  std::vector<Time> times;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto time = parse(line);
    if (!time) {
      throw Error(file.string() + ":" + std::to_string(number) + ": \"" + line.substr(0, 40) +
                  "\", expected " + expected);
    }
    times.push_back(*time);
  }
  return times;
}

[[noreturn]] void refuse(const fs::path& file, std::size_t found, std::size_t expected) {
  throw Error(file.string() + ": " + std::to_string(found) + " times, expected " +
              std::to_string(expected) + ", one a scan");
}

/// A line a scan, or a line a number: where scans were lost their numbers are missing.
std::vector<Time> read_dates(const fs::path& file, const std::vector<fs::path>& files) {
  const std::vector<Time> dates =
      read_times(file, date_in, "a date and a time, 2011-09-26 13:02:25.951199337");
  if (dates.size() == files.size()) return dates;
  std::vector<Time> times;
  for (const fs::path& scan : files) {
    const std::string stem = scan.stem().string();
    if (stem.size() > 12 || stem.find_first_not_of("0123456789") != std::string::npos) break;
    const std::size_t number = std::strtoull(stem.c_str(), nullptr, 10);
    if (number >= dates.size()) break;
    times.push_back(dates[number]);
  }
  if (times.size() != files.size()) refuse(file, dates.size(), files.size());
  return times;
}

std::optional<Time> time_from(long long number, Time unit) {
  if (number > kLargestTime_ns / unit) return std::nullopt;
  return number * unit;
}

/// The time that a name says, without its letters.
std::optional<Time> time_in_name(const std::string& name) {
  std::vector<std::string> runs;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] < '0' || name[i] > '9') continue;
    if (i == 0 || name[i - 1] < '0' || name[i - 1] > '9') runs.emplace_back();
    runs.back() += name[i];
  }
  if (runs.empty()) return std::nullopt;
  const std::string& last = runs.back();
  if (last.size() == 19) return time_from(std::strtoll(last.c_str(), nullptr, 10), 1);
  if (last.size() == 16) return time_from(std::strtoll(last.c_str(), nullptr, 10), 1000);
  if (runs.size() < 2 || runs[runs.size() - 2].size() != 10 || last.size() > 9) {
    return std::nullopt;
  }
  const auto seconds =
      time_from(std::strtoll(runs[runs.size() - 2].c_str(), nullptr, 10), kNanosecondsPerSecond);
  if (!seconds) return std::nullopt;
  const Time rest = std::strtoll(last.c_str(), nullptr, 10);
  // "1583836591.182" has thousandths, "1583836591_82590976" nanoseconds without their zeros.
  const bool point = name.find(runs[runs.size() - 2] + "." + last) != std::string::npos;
  const auto digits = static_cast<double>(last.size());
  return *seconds +
         (point ? std::llround(static_cast<double>(rest) * std::pow(10, 9 - digits)) : rest);
}

}  // namespace

fs::path parent_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).parent_path();
}

std::vector<Time> times_of_scans(const fs::path& scans, const std::vector<fs::path>& files) {
  std::vector<Time> times;
  if (const fs::path file = beside(scans, "times.txt"); !file.empty()) {
    times = read_times(file, seconds_in, "a time in seconds");
    if (times.size() != files.size()) refuse(file, times.size(), files.size());
    return times;
  }
  if (const fs::path file = beside(scans, "timestamps.txt"); !file.empty()) {
    return read_dates(file, files);
  }
  for (const fs::path& file : files) {
    const auto time = time_in_name(file.filename().string());
    if (!time || (!times.empty() && *time <= times.back())) break;
    times.push_back(*time);
  }
  if (times.size() == files.size()) return times;
  times.clear();
  for (std::size_t i = 0; i < files.size(); ++i) {
    times.push_back(kTenthOfSecond * static_cast<Time>(i));
  }
  return times;
}

}  // namespace saker::lidar
