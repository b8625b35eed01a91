#include "saker/lidar/recording.h"

#include <vector>

#include "saker/core/error.h"
#include "saker/lidar/kitti_folder.h"
#include "saker/lidar/ouster_capture.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

bool is_capture(const fs::path& path) {
  return path.extension() == ".pcap" || path.extension() == ".pcapng";
}

/// The only capture in a folder without KITTI scans; else the path itself.
fs::path capture_in(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored) || is_kitti_folder(path)) return path;
  std::vector<fs::path> captures;
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    if (is_capture(entry.path())) captures.push_back(entry.path());
  }
  if (captures.size() > 1) {
    throw Error(path.string() + ": " + std::to_string(captures.size()) +
                " captures in it, expected one: name the file");
  }
  return captures.empty() ? path : captures.front();
}

RecordingFormat format_of(const fs::path& path) {
  if (fs::is_directory(path)) return RecordingFormat::kKitti;
  if (is_capture(path)) return RecordingFormat::kOuster;
  throw Error(path.string() + ": neither a folder of scans nor a capture (*.pcap)");
}

}  // namespace

std::string SourceCounters::summary() const {
  std::string text;
  const auto add = [&](int count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(faulty_scans, "faulty scans");
  add(bad_packets, "bad packets");
  add(bad_columns, "bad columns");
  add(late_packets, "late packets");
  add(repeated_columns, "repeated columns");
  add(missing_columns, "missing columns");
  add(lost_frames, "lost frames");
  add(lost_fragments, "datagrams with fragments missing");
  if (!ended_early.empty()) text += (text.empty() ? "" : ", ") + ("ended early: " + ended_early);
  return text;
}

std::unique_ptr<ScanSource> open_recording(const fs::path& given, RecordingFormat format,
                                           const fs::path& metadata) {
  std::error_code ignored;
  if (!fs::exists(given, ignored)) throw Error("cannot read " + given.string() + ": no such file");
  const fs::path path = format == RecordingFormat::kKitti ? given : capture_in(given);
  if (format == RecordingFormat::kAutomatic) format = format_of(path);
  if (format == RecordingFormat::kKitti) return std::make_unique<KittiFolder>(path);
  return std::make_unique<OusterCapture>(path, metadata.empty() ? find_metadata(path) : metadata);
}

fs::path find_metadata(const fs::path& capture) {
  std::error_code ignored;
  if (!fs::is_regular_file(capture, ignored)) {
    throw Error("cannot read capture " + capture.string() + ": no such file");
  }
  std::vector<std::string> stems = {capture.stem().string()};
  const auto cut = stems[0].rfind('_');
  if (cut != std::string::npos) stems.push_back(stems[0].substr(0, cut));
  std::string looked_for;
  for (const std::string& stem : stems) {
    const fs::path file = capture.parent_path() / (stem + ".json");
    if (fs::is_regular_file(file, ignored)) return file;
    looked_for += (looked_for.empty() ? "" : " or ") + file.string();
  }
  throw Error(capture.string() + ": no metadata beside it, expected " + looked_for);
}

}  // namespace saker::lidar
