#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/lidar/scan_assembler.h"
#include "tools/saker/command.h"
#include "tools/saker/recording_input.h"

namespace saker::tools {
namespace {

struct ScansOptions {
  RecordingInput input;
};

constexpr const char* kHeader =
    "scan,frame_id,first_column_ns,last_column_ns,valid_columns,points\n";

/// Of a recording without packets: the number of the scan, its first and last point.
std::string row(const lidar::Frame& frame, int number) {
  const lidar::Scan& scan = frame.scan;
  const auto points = std::count_if(scan.points.begin(), scan.points.end(),
                                    [](const Eigen::Vector3f& p) { return p.allFinite(); });
  const auto first = std::min_element(scan.offset_ns.begin(), scan.offset_ns.end());
  const Time begin = scan.stamp + (first == scan.offset_ns.end() ? 0 : *first);
  return fmt::format("{},{},{},{},{},{}\n", frame.name, number, begin, scan.stamp, scan.columns,
                     points);
}

std::string row(const lidar::Frame& frame, const lidar::AssembledScan& scan) {
  return fmt::format("{},{},{},{},{},{}\n", frame.name, scan.frame_id, scan.first_column,
                     scan.last_column, scan.valid_columns, scan.returns);
}

void report(const lidar::ScanSource& source, int scans) {
  spdlog::info("{} scans, {} inertial samples", scans, source.counters().imu_samples);
  const std::string amiss = source.counters().summary();
  if (!amiss.empty()) spdlog::warn("not used: {}", amiss);
}

int scans(const ScansOptions& options, const CommonOptions& common) {
  const auto source = options.input.open();
  const OutputFolder out(common);
  core::OutputFile table(out / "scans.csv");
  table.write(kHeader);
  int count = 0;
  for (; auto frame = source->next(); ++count) {
    if (!frame->fault.empty()) spdlog::warn("{}: {}", frame->name, frame->fault);
    const lidar::AssembledScan* packets = source->assembled();
    table.write(packets != nullptr ? row(*frame, *packets) : row(*frame, count));
    if (!options.input.options.keep_ranges || !frame->fault.empty()) continue;
    if (packets == nullptr) {
      throw Error(options.input.path + ": --ranges: its scans are points, not ranges of a sensor");
    }
    core::write_npy(out / (frame->name + ".npy"), packets->ranges_mm, frame->scan.rows,
                    frame->scan.columns);
  }
  table.finish();
  report(*source, count);
  if (count == 0) throw Error(options.input.path + ": no scan in it, expected at least one");
  return 0;
}

}  // namespace

void add_scans(Commands& commands) {
  auto options = std::make_shared<ScansOptions>();
  CLI::App& app =
      commands.add({.name = "scans",
                    .does = "decodes a recording: OUT/scans.csv and, with --ranges, OUT/NNNNNN.npy",
                    .output = Output::folder,
                    .example = "saker scans drive.pcap --ranges -o out"},
                   [options](const CommonOptions& common) { return scans(*options, common); });
  add_recording_input(app, "CAPTURE", options->input);
  app.add_flag("--ranges", options->input.options.keep_ranges,
               "ranges of the first return in mm, uint32, rows x columns, staggered as sent");
}

}  // namespace saker::tools
