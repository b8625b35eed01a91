#include "flight/viewers/run_log.h"

#include <regex>

#include "flight/bus/scan_log.h"
#include "saker/core/error.h"

namespace saker::flight::viewers {
namespace {

double seconds_of(const lcm::LogEvent& event) {
  return static_cast<double>(event.timestamp) * 1e-6;
}

bool is_of_a_robot(const std::string& channel) {
  static const std::regex pattern(kAnyRobot + "_[A-Z_]+");
  return std::regex_match(channel, pattern);
}

}  // namespace

LogRun::LogRun(const std::filesystem::path& file) : file_(file.string()) {
  if (!is_lcm_log(file)) throw Error("cannot read " + file_ + ": no log of lcm-logger");
  lcm::LogFile log(file_, "r");
  bool any = false;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (!is_of_a_robot(event->channel)) continue;
    const double t = seconds_of(*event);
    begin_s_ = any ? std::min(begin_s_, t) : t;
    end_s_ = any ? std::max(end_s_, t) : t;
    any = true;
  }
  if (!any) throw Error(file_ + ": no message of a robot in it, expected R1_STATE and the like");
  log_.emplace(file_, "r");
  next_ = log_->readNextEvent();
}

void LogRun::advance(double t, RobotViews& views) {
  for (; next_ != nullptr && seconds_of(*next_) <= t; next_ = log_->readNextEvent()) {
    if (!is_of_a_robot(next_->channel)) continue;
    const auto* data = static_cast<const std::uint8_t*>(next_->data);
    views.hear(next_->channel, {data, static_cast<std::size_t>(next_->datalen)},
               seconds_of(*next_));
  }
}

void LogRun::rewind(RobotViews& views) {
  views.clear();
  log_.emplace(file_, "r");
  next_ = log_->readNextEvent();
}

}  // namespace saker::flight::viewers
