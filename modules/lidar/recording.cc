#include "saker/lidar/recording.h"

#include <vector>

#include "saker/core/error.h"
#include "saker/lidar/bags/bag_recording.h"
#include "saker/lidar/clouds/cloud_folder.h"
#include "saker/lidar/kitti_folder.h"
#include "saker/lidar/osf/osf_recording.h"
#include "saker/lidar/ouster_capture.h"
#include "saker/lidar/recording_kind.h"
#include "saker/lidar/spinning/spinning_capture.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

/// What a file that is not known may be, to say it.
std::string expected_kinds() {
  return "expected a folder of scans (*.bin, PCD, PLY, .npy), a capture (*.pcap), OSF, a ROS bag "
         "or "
         "MCAP";
}

/// Of Velodyne or Hesai where most of its beginning is; else of Ouster.
std::unique_ptr<ScanSource> open_capture(const std::vector<fs::path>& files,
                                         const RecordingOptions& options) {
  const SpinningSenders spinning = find_spinning_senders(files.front());
  if (2 * spinning.packets > spinning.datagrams && options.format != RecordingFormat::kOuster) {
    return std::make_unique<SpinningCapture>(files, spinning, options);
  }
  if (options.metadata.empty() && !spinning.unread.empty()) {
    throw Error(files.front().string() + ": packets that are not read: " + spinning.unread +
                "; expected Ouster's, Velodyne's VLP-16, VLP-32C, HDL-32E or HDL-64E, Hesai's "
                "Pandar64, XT32 or QT64");
  }
  return std::make_unique<OusterCapture>(
      files, options.metadata.empty() ? find_metadata(files.front()) : options.metadata,
      options.keep_ranges, options.sensor);
}

std::unique_ptr<ScanSource> open_parts(const RecordingParts& parts,
                                       const RecordingOptions& options) {
  const fs::path& first = parts.files.front();
  switch (parts.kind) {
    case RecordingKind::kFloatScans:
      return std::make_unique<KittiFolder>(first, options.point_fields);
    case RecordingKind::kClouds:
      return std::make_unique<CloudFolder>(first);
    case RecordingKind::kCapture:
      return open_capture(parts.files, options);
    case RecordingKind::kOsf:
      return std::make_unique<OsfRecording>(first, options);
    case RecordingKind::kRos1Bag:
    case RecordingKind::kMcap:
    case RecordingKind::kRos2Database:
      return std::make_unique<BagRecording>(parts, options);
    case RecordingKind::kUnknown:
      break;
  }
  throw Error(first.string() + ": no recording that is known, " + expected_kinds());
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
  add(clock_steps, "steps of the clock");
  add(other_sensors, "packets of other sensors");
  add(late_imu_samples, "late inertial samples");
  add(lost_fragments, "datagrams with fragments missing");
  if (!ended_early.empty()) text += (text.empty() ? "" : ", ") + ("ended early: " + ended_early);
  return text;
}

std::unique_ptr<ScanSource> open_recording(const fs::path& path, const RecordingOptions& options) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error("cannot read " + path.string() + ": no such file");
  RecordingParts parts = {RecordingKind::kFloatScans, {path}};
  if (options.format != RecordingFormat::kKitti) parts = recording_parts(path);
  if (options.format == RecordingFormat::kOuster && !parts.files.empty() &&
      parts.kind != RecordingKind::kOsf) {
    parts.kind = RecordingKind::kCapture;
  }
  if (parts.files.empty()) throw Error(path.string() + ": no scans, " + expected_kinds());
  if (!options.point_fields.empty() && parts.kind != RecordingKind::kFloatScans) {
    throw Error(path.string() + ": --point-fields " + options.point_fields +
                ": only *.bin scans do not say what their points are");
  }
  return open_parts(parts, options);
}

std::unique_ptr<ScanSource> open_recording(const fs::path& path, RecordingFormat format,
                                           const fs::path& metadata) {
  RecordingOptions options;
  options.format = format;
  options.metadata = metadata;
  return open_recording(path, options);
}

fs::path find_metadata(const fs::path& capture) {
  std::error_code ignored;
  if (!fs::is_regular_file(capture, ignored)) {
    throw Error("cannot read capture " + capture.string() + ": no such file");
  }
  const std::string whole = capture.stem().string();
  std::vector<std::string> stems = {whole};
  const auto cut = whole.find_last_of("_-");
  if (cut != std::string::npos) stems.push_back(whole.substr(0, cut));
  stems.push_back(whole + "_0");
  std::string looked_for;
  for (const std::string& stem : stems) {
    const fs::path file = capture.parent_path() / (stem + ".json");
    if (fs::is_regular_file(file, ignored)) return file;
    looked_for += (looked_for.empty() ? "" : " or ") + file.string();
  }
  throw Error(capture.string() + ": no metadata beside it, expected " + looked_for);
}

}  // namespace saker::lidar
