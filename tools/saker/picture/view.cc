#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <deque>
#include <memory>

#include "saker/core/error.h"
#include "saker/lidar/recording.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/picture/picture.h"
#include "tools/saker/picture/scan_picture.h"
#include "tools/saker/recording_input.h"

namespace saker::tools {
namespace {

/// Odometry runs for this long before the window, so that it has a map when the window begins.
constexpr double kRunUp_s = 1;

struct ViewOptions {
  RecordingInput input;
  int scan = 0;
};

/// The scan and those of the `span` before it, oldest first. Throws Error where it cannot be read.
std::deque<lidar::Frame> read_frames(const ViewOptions& options, Time span) {
  const auto source = options.input.open();
  std::deque<lidar::Frame> frames;
  for (int i = 0; i <= options.scan; ++i) {
    auto frame = source->next();
    if (!frame) {
      throw Error(fmt::format("{}: --scan {}: there are {} scans, the first is 0",
                              options.input.path, options.scan, i));
    }
    frames.push_back(std::move(*frame));
    while (frames.front().scan.stamp < frames.back().scan.stamp - span) frames.pop_front();
  }
  if (const lidar::Frame& wanted = frames.back(); !wanted.fault.empty()) {
    throw Error(fmt::format("{}: scan {}: {}", options.input.path, options.scan, wanted.fault));
  }
  return frames;
}

/// Odometry over all frames, labels for those of the window.
std::vector<detection::LabelledScan> labelled_window(const std::deque<lidar::Frame>& frames,
                                                     const autonomy::Config& config) {
  odometry::Odometry odometry(config.odometry);
  segmentation::Segmentation segmentation(config.segmentation, config.objects);
  const Time oldest = frames.back().scan.stamp - from_seconds(config.detection.window_s);
  std::vector<detection::LabelledScan> window;
  for (const lidar::Frame& frame : frames) {
    odometry::OdometryEstimate estimate = odometry.register_scan(frame.scan, frame.imu);
    if (frame.scan.stamp < oldest || !frame.fault.empty() ||
        estimate.status == odometry::OdometryStatus::refused) {
      continue;
    }
    window.push_back(
        {frame.scan.stamp, estimate.T_odom_lidar,
         std::make_shared<const std::vector<Eigen::Vector3f>>(std::move(estimate.points)),
         std::make_shared<const lidar::Labels>(segmentation.segment(frame.scan)), nullptr,
         frame.scan.T_lidar_sensor.translation().cast<double>()});
  }
  return window;
}

std::string title_of(const lidar::Frame& frame, const objects::Detections& detections,
                     const objects::ClassTable& table) {
  std::vector<int> counts(table.size());
  for (const objects::Measurement& m : detections.measurements) ++counts[m.class_id];
  std::string title = "Scan " + frame.name + " and its window from above";
  for (int id = 0; id < table.size(); ++id) {
    if (counts[id] > 0) {
      title += fmt::format(", {} {}", counts[id], table[static_cast<objects::ClassId>(id)].name);
    }
  }
  return title;
}

int view(const ViewOptions& options, const CommonOptions& common) {
  const autonomy::Config config = read_configuration(common).autonomy;
  detection::Detection detection(config.detection, config.objects);
  const std::filesystem::path file = output_file(common.out, common.force);
  (void)output_file(svg_beside(file), common.force);
  const auto frames = read_frames(options, from_seconds(config.detection.window_s + kRunUp_s));
  const auto window = labelled_window(frames, config);
  if (window.empty() || window.back().stamp != frames.back().scan.stamp) {
    throw Error(fmt::format("{}: scan {} is not newer than the one before it", options.input.path,
                            options.scan));
  }
  const objects::Detections detections = detection.detect(window);
  const std::string title = title_of(frames.back(), detections, config.objects);
  write_scan_picture(file,
                     {.title = title,
                      .scan = frames.back().scan,
                      .labels = *window.back().labels,
                      .window = window,
                      .detections = detections},
                     config.objects);
  spdlog::info("{} -> {}", title, file.string());
  return 0;
}

}  // namespace

void add_view(Commands& commands) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& app =
      commands.add({.name = "view",
                    .does = "a picture (PNG) of a scan, its labels, clusters and fitted models",
                    .output = Output::file,
                    .example = "saker view drive/ --scan 100 -o scan.png"},
                   [options](const CommonOptions& common) { return view(*options, common); });
  add_recording_input(app, "INPUT", options->input);
  app.add_option("--scan", options->scan, "which scan, in their order; the first is 0")
      ->required()
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
}

}  // namespace saker::tools
