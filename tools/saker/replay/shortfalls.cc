#include "tools/saker/replay/shortfalls.h"

#include <fmt/format.h>

#include <algorithm>

namespace saker::tools {
namespace {

constexpr double kMostNotRegistered = 0.1;  // or not held: share of the scans

constexpr double kBegins_s = 2;  // a new map of few scans holds less than it soon will

}  // namespace

std::vector<std::string> shortfalls(const autonomy::LockstepResult& result, int detections) {
  const auto count = [&](auto what) {
    return std::count_if(result.scans.begin(), result.scans.end(), what);
  };
  const auto scans = static_cast<double>(result.scans.size());
  const auto lost =
      count([](const autonomy::ScanRecord& scan) { return !odometry::registered(scan.status); });
  const auto settled = [&](const autonomy::ScanRecord& scan) {
    return to_seconds(scan.stamp - result.scans.front().stamp) >= kBegins_s;
  };
  const auto not_held = count([&](const autonomy::ScanRecord& scan) {
    return settled(scan) && scan.status == odometry::OdometryStatus::open;
  });
  const auto backwards = count([](const autonomy::ScanRecord& scan) {
    return scan.reason == odometry::OdometryReason::not_newer;
  });
  std::vector<std::string> lines;
  if (static_cast<double>(lost) > kMostNotRegistered * scans)
    lines.push_back(
        fmt::format("{} of {} scans were not registered: trajectory and map are in doubt", lost,
                    result.scans.size()));
  if (static_cast<double>(not_held) > kMostNotRegistered * static_cast<double>(count(settled)))
    lines.push_back(fmt::format(
        "in {} of {} scans nothing in sight held the pose in a direction: trajectory and map are "
        "in doubt",
        not_held, result.scans.size()));
  if (backwards > 0)
    lines.push_back(fmt::format("time did not go on in {} scans: they were not used", backwards));
  if (detections > 0 && result.map.objects.empty())
    lines.push_back(
        fmt::format("{} detections and no object: none was seen often enough to be sure of it "
                    "(`tentative` in map.json, detections.jsonl)",
                    detections));
  return lines;
}

}  // namespace saker::tools
