#include "lidar/recording.h"

#include <vector>

#include "core/error.h"
#include "lidar/kitti_folder.h"
#include "lidar/ouster_capture.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

RecordingFormat format_of(const fs::path& path) {
  if (fs::is_directory(path)) return RecordingFormat::kKitti;
  const fs::path extension = path.extension();
  if (extension == ".pcap" || extension == ".pcapng") return RecordingFormat::kOuster;
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

std::unique_ptr<ScanSource> open_recording(const fs::path& path, RecordingFormat format,
                                           const fs::path& metadata) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error("cannot read " + path.string() + ": no such file");
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
