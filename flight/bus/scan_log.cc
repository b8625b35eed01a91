#include "flight/bus/scan_log.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "saker/core/error.h"
#include "saker/occupancy/open_beam.h"

namespace saker::flight {
namespace {

constexpr std::array<unsigned char, 4> kSyncWord = {0xed, 0xa1, 0xda, 0x01};

std::optional<scan_t> scan_of(const lcm::LogEvent& event) {
  scan_t message{};
  if (message.decode(event.data, 0, event.datalen) < 0) return std::nullopt;
  return message;
}

bool is_scan_channel(const std::string& channel) {
  return channel.ends_with(kChannel<scan_t>.suffix);
}

const std::filesystem::path& checked_file(const std::filesystem::path& file) {
  if (is_lcm_log(file)) return file;
  throw Error("cannot read " + file.string() + ": no log of lcm-logger");
}

}  // namespace

bool is_lcm_log(const std::filesystem::path& file) {
  std::array<unsigned char, 4> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(begin.data()), begin.size());
  return in && begin == kSyncWord;
}

ScanLog::ScanLog(const std::filesystem::path& file) : log_(checked_file(file).string(), "r") {
  lcm::LogFile count(file.string(), "r");
  while (const lcm::LogEvent* event = count.readNextEvent()) {
    if (!is_scan_channel(event->channel)) continue;
    if (channel_.empty()) channel_ = event->channel;
    if (event->channel != channel_) {
      throw Error(fmt::format("{}: {} and {} in it, expected one robot: lcm-logger --channel={}",
                              file.string(), channel_, event->channel, channel_));
    }
    const auto message = scan_of(*event);
    if (message && message->chunk == 0) ++expected_;
  }
  if (expected_ > 0) return;
  throw Error(file.string() +
              ": no _SCAN in it, expected those of the bulk network: "
              "lcm-logger --lcm-url='udpm://239.255.76.67:7668?ttl=0&recv_buf_size=2097152' FILE");
}

std::optional<lidar::Frame> ScanLog::next() {
  while (const lcm::LogEvent* event = log_.readNextEvent()) {
    if (event->channel != channel_) continue;
    auto message = scan_of(*event);
    if (!message) ++malformed_;
    const auto scan = message ? joiner_.add(std::move(*message)) : std::nullopt;
    if (!scan) continue;
    lidar::Frame frame;
    frame.name = fmt::format("{:06}", scans_++);
    frame.scan.stamp = scan->stamp;
    for (std::size_t i = 0; i < scan->points->size(); ++i) {
      if (occupancy::is_open_beam((*scan->points)[i])) continue;
      frame.scan.points.push_back((*scan->points)[i]);
      frame.scan.reflectivity.push_back((*scan->reflectivity)[i]);
    }
    frame.scan.offset_ns.assign(frame.scan.size(), 0);
    return frame;
  }
  return std::nullopt;
}

lidar::SourceCounters ScanLog::counters() const {
  lidar::SourceCounters counters;
  counters.bad_packets = malformed_ + static_cast<int>(joiner_.counters().refused);
  counters.lost_frames = static_cast<int>(joiner_.counters().incomplete);
  return counters;
}

}  // namespace saker::flight
