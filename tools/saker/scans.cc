#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "saker/core/files.h"
#include "saker/lidar/ouster_capture.h"
#include "tools/saker/command.h"

namespace saker::tools {
namespace {

struct ScansOptions {
  std::string capture;
  std::string metadata;
  bool ranges = false;
};

constexpr const char* kHeader =
    "scan,frame_id,first_column_ns,last_column_ns,valid_columns,points\n";

std::string row(const lidar::OusterStream::Item& item) {
  const lidar::AssembledScan& scan = item.assembled;
  return fmt::format("{},{},{},{},{},{}\n", item.frame.name, scan.frame_id, scan.first_column,
                     scan.last_column, scan.valid_columns, scan.returns);
}

void report(const lidar::OusterCapture& capture, int scans) {
  spdlog::info("{} scans", scans);
  const std::string amiss = capture.counters().summary();
  if (!amiss.empty()) spdlog::warn("not used: {}", amiss);
}

int scans(const ScansOptions& options, const CommonOptions& common) {
  lidar::OusterCapture capture(
      options.capture,
      options.metadata.empty() ? lidar::find_metadata(options.capture).string() : options.metadata,
      options.ranges);
  const OutputFolder out(common);
  core::OutputFile table(out / "scans.csv");
  table.write(kHeader);
  int count = 0;
  while (auto item = capture.next_item()) {
    table.write(row(*item));
    ++count;
    if (!options.ranges) continue;
    core::write_npy(out / (item->frame.name + ".npy"), item->assembled.ranges_mm,
                    capture.info().rows, capture.info().columns);
  }
  table.finish();
  report(capture, count);
  return 0;
}

}  // namespace

void add_scans(Commands& commands) {
  auto options = std::make_shared<ScansOptions>();
  CLI::App& app = commands.add(
      {.name = "scans",
       .does = "decodes an Ouster capture: OUT/scans.csv and, with --ranges, OUT/NNNNNN.npy",
       .output = Output::folder,
       .example = "saker scans drive.pcap --ranges -o out"},
      [options](const CommonOptions& common) { return scans(*options, common); });
  app.add_option("CAPTURE", options->capture, "the capture (*.pcap)")->required();
  app.add_option("--meta", options->metadata, "metadata (JSON); else beside the capture")
      ->type_name("FILE");
  app.add_flag("--ranges", options->ranges,
               "ranges of the first return in mm, uint32, rows x columns, staggered as sent");
}

}  // namespace saker::tools
