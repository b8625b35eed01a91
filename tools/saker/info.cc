#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "flight/bus/scan_log.h"
#include "saker/core/error.h"
#include "saker/lidar/bags/message_file.h"
#include "saker/lidar/recording_kind.h"
#include "saker/objects/map_io.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/recording_input.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kScansRead = 20;  // so that an answer takes a second, however long the recording is
constexpr double kGapPeriods = 1.8;  // of the median period: a scan is missing

std::string kind_name(lidar::RecordingKind kind) {
  switch (kind) {
    case lidar::RecordingKind::kFloatScans:
      return "scans of floats (*.bin)";
    case lidar::RecordingKind::kClouds:
      return "clouds (PCD, PLY, .npy)";
    case lidar::RecordingKind::kCapture:
      return "capture (pcap)";
    case lidar::RecordingKind::kOsf:
      return "OSF";
    case lidar::RecordingKind::kRos1Bag:
      return "ROS 1 bag";
    case lidar::RecordingKind::kMcap:
      return "MCAP";
    case lidar::RecordingKind::kRos2Database:
      return "ROS 2 bag (SQLite)";
    case lidar::RecordingKind::kUnknown:
      break;
  }
  return "unknown";
}

/// What was seen of the first scans.
struct Summary {
  int scans = 0, faulty = 0, imu = 0;
  std::size_t points = 0;
  bool timed = false, ringed = false;
  int rows = 0, columns = 0;
  std::vector<Time> stamps;
  Eigen::Vector3f least = Eigen::Vector3f::Constant(INFINITY);
  Eigen::Vector3f most = Eigen::Vector3f::Constant(-INFINITY);
  float farthest = 0;

  void add(const lidar::Frame& frame) {
    ++scans;
    imu += static_cast<int>(frame.imu.size());
    stamps.push_back(frame.scan.stamp);
    if (!frame.fault.empty()) ++faulty;
    rows = frame.scan.rows;
    columns = frame.scan.columns;
    ringed = ringed || !frame.scan.ring.empty();
    const auto& offsets = frame.scan.offset_ns;
    timed = timed || std::any_of(offsets.begin(), offsets.end(), [](auto t) { return t != 0; });
    for (const Eigen::Vector3f& p : frame.scan.points) {
      if (!p.allFinite()) continue;
      ++points;
      least = least.cwiseMin(p);
      most = most.cwiseMax(p);
      farthest = std::max(farthest, p.norm());
    }
  }
};

/// Rate and gaps by the stamps.
std::string times_of(const std::vector<Time>& stamps) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    periods.push_back(to_seconds(stamps[i] - stamps[i - 1]));
  }
  if (periods.empty()) return "one scan";
  std::vector<double> sorted = periods;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const auto gaps = std::count_if(periods.begin(), periods.end(),
                                  [&](double period) { return period > kGapPeriods * median; });
  const auto back = std::count_if(periods.begin(), periods.end(), [](double p) { return p <= 0; });
  std::string text = fmt::format("{:.2f} Hz, from {:.3f} s", median > 0 ? 1 / median : 0,
                                 to_seconds(stamps.front()));
  if (gaps > 0) text += fmt::format(", {} gaps of up to {:.2f} s", gaps, sorted.back());
  if (back > 0) text += fmt::format(", {} times time does not go on", back);
  return text;
}

void print_scans(lidar::ScanSource& source) {
  if (const std::string note = source.note(); !note.empty())
    std::cout << "note     " << note << "\n";
  Summary summary;
  while (summary.scans < kScansRead) {
    const auto frame = source.next();
    if (!frame) break;
    summary.add(*frame);
  }
  const int expected = source.expected_scans();
  std::cout << fmt::format(
      "scans    {}{}\n", expected > 0 ? fmt::format("{}, of which ", expected) : "",
      summary.scans < kScansRead ? fmt::format("{} read", summary.scans)
                                 : fmt::format("the first {} were read", kScansRead));
  if (summary.scans == 0) return;
  if (summary.faulty > 0) std::cout << fmt::format("faulty   {}\n", summary.faulty);
  std::cout << "rate     " << times_of(summary.stamps) << "\n";
  std::cout << fmt::format(
      "points   {:.0f} a scan, {}, {}{}\n", static_cast<double>(summary.points) / summary.scans,
      summary.rows > 0 ? fmt::format("{} x {}", summary.rows, summary.columns) : "not organised",
      summary.timed ? "each with its time" : "without times", summary.ringed ? ", with rings" : "");
  if (summary.points > 0) {
    std::cout << fmt::format(
        "extent   x {:.1f} to {:.1f}, y {:.1f} to {:.1f}, z {:.1f} to {:.1f} m; up to {:.1f} m\n",
        summary.least.x(), summary.most.x(), summary.least.y(), summary.most.y(), summary.least.z(),
        summary.most.z(), summary.farthest);
  }
  std::cout << fmt::format("inertial {} samples\n", summary.imu);
  if (const std::string amiss = source.counters().summary(); !amiss.empty()) {
    std::cout << "amiss    " << amiss << "\n";
  }
}

/// Topics with types, counts and rates. \return whether the file has any with scans
void print_topics(const lidar::RecordingParts& parts) {
  const auto file = lidar::open_messages(parts);
  const double duration = to_seconds(file->end() - file->begin());
  std::cout << fmt::format("duration {:.3f} s, from {:.3f} s\n", duration,
                           to_seconds(file->begin()));
  for (const lidar::Topic& topic : file->topics()) {
    std::cout << fmt::format(
        "topic    {} {}, {} messages{}\n", topic.name, topic.type, topic.messages,
        duration > 0 && topic.messages > 1
            ? fmt::format(", {:.1f} Hz", static_cast<double>(topic.messages - 1) / duration)
            : "");
  }
}

bool is_map(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".smap" || extension == ".json";
}

int print_map(const fs::path& file, const objects::ClassTable& table) {
  const objects::ObjectMap map = objects::read_map(file, table);
  std::cout << "kind     object map\n";
  std::map<std::string, int> counts;
  Eigen::Vector3d least = Eigen::Vector3d::Constant(INFINITY), most = -least;
  for (const objects::MapObject& object : map.objects) {
    ++counts[table[object.class_id].name];
    least = least.cwiseMin(objects::place(object.model));
    most = most.cwiseMax(objects::place(object.model));
  }
  for (const auto& [name, count] : counts)
    std::cout << fmt::format("objects  {} {}\n", count, name);
  if (map.objects.empty()) std::cout << "objects  none\n";
  if (!map.objects.empty()) {
    std::cout << fmt::format("extent   x {:.1f} to {:.1f}, y {:.1f} to {:.1f} m\n", least.x(),
                             most.x(), least.y(), most.y());
  }
  return 0;
}

int info(const RecordingInput& input, const CommonOptions& common) {
  const fs::path path = input.path;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error("cannot read " + path.string() + ": no such file");
  if (fs::is_regular_file(path, ignored) && is_map(path)) {
    return print_map(path, read_configuration(common).autonomy.objects);
  }
  if (flight::is_lcm_log(path)) {
    std::cout << "kind     log of lcm-logger\n";
    flight::ScanLog log(path);
    print_scans(log);
    return 0;
  }
  const lidar::RecordingParts parts = lidar::recording_parts(path);
  if (parts.files.empty() || parts.kind == lidar::RecordingKind::kUnknown) {
    throw Error(path.string() + ": neither a recording nor a map nor a log");
  }
  std::cout << "kind     " << kind_name(parts.kind);
  if (parts.files.size() > 1) std::cout << fmt::format(", {} files", parts.files.size());
  std::cout << "\n";
  const bool messages = parts.kind == lidar::RecordingKind::kRos1Bag ||
                        parts.kind == lidar::RecordingKind::kMcap ||
                        parts.kind == lidar::RecordingKind::kRos2Database;
  if (messages) print_topics(parts);
  try {
    print_scans(*lidar::open_recording(path, input.options));
  } catch (const Error& error) {
    if (!messages) throw;
    std::cout << "scans    " << error.what() << "\n";  // its topics are known all the same
  }
  return 0;
}

}  // namespace

void add_info(Commands& commands) {
  auto input = std::make_shared<RecordingInput>();
  CLI::App& app =
      commands.add({.name = "info",
                    .does = "what is in a recording, log or map: topics, rates, gaps, extents",
                    .example = "saker info drive.bag"},
                   [input](const CommonOptions& common) { return info(*input, common); });
  add_recording_input(app, "FILE", *input);
}

}  // namespace saker::tools
