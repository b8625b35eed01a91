#include "tools/saker/record/run_recording.h"

#include <spdlog/spdlog.h>

#include "saker/core/error.h"
#include "tools/saker/command.h"

namespace saker::tools {
namespace {

const std::filesystem::path& named_mcap(const std::filesystem::path& file) {
  if (file.extension() == ".mcap") return file;
  throw Error("cannot write " + file.string() + ": expected a name that ends in .mcap");
}

}  // namespace

RunRecording::RunRecording(const std::filesystem::path& file, std::string robot)
    : file_(named_mcap(file)), robot_(std::move(robot)), recording_(file_) {}

void RunRecording::add(const lidar::Scan& scan) {
  if (!scan.points.empty()) recording_.add_scan(robot_, scan);
}

void RunRecording::finish(const std::filesystem::path& out, const flight::viewers::Site& site,
                          const std::vector<autonomy::RegisteredScan>& points) {
  const auto run = flight::viewers::open_run(out, site);
  std::size_t next = 0;
  const auto more = [&](double t, flight::viewers::RobotViews& views) {
    auto* const view = views.find(robot_);
    for (; next < points.size() && to_seconds(points[next].stamp) <= t; ++next) {
      if (view != nullptr) view->hear(points[next], to_seconds(points[next].stamp));
    }
  };
  const std::uint64_t messages = flight::viewers::record_run(*run, site, recording_, more);
  spdlog::info("{}: {} messages over {:.1f} s", file_.string(), messages,
               run->end_s() - run->begin_s());
}

std::optional<std::filesystem::path> record_file(const std::string& file, bool force) {
  if (file.empty()) return std::nullopt;
  return named_mcap(output_file(file, force));
}

}  // namespace saker::tools
