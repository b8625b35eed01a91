#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/scan.h"

/// Stage 0: recordings and live sensors, scan by scan.
///
/// Reads recordings of any LiDAR (docs/formats.md) and, through ouster_sensor.h, a live Ouster;
/// makes organised or unorganised scans with the inertial samples that came since the last one, in
/// the order of time, all in the lidar frame. Method: kitti_folder.h, ouster_stream.h. Refuses a
/// recording that is not there or whose metadata is wrong (Error); a scan that cannot be read
/// inside a good recording is a Frame with a `fault`. Cost: 0.4 ms for a scan of 64×1024, 2 ms for
/// one of KITTI.
namespace saker::lidar {

/// One scan, as a recording gives it.
struct Frame {
  Scan scan;                   ///< empty when `fault` is set; its stamp holds even then
  std::vector<ImuSample> imu;  ///< since the last frame, oldest first
  std::string name;            ///< stem of the scan's file, or a running number of six digits
  std::string fault;           ///< why this scan could not be read; empty when it could
};

/// What a source met so far that it did not use.
struct SourceCounters {
  int faulty_scans = 0;
  int bad_packets = 0;       ///< of an unknown size, or cut
  int bad_columns = 0;       ///< that do not exist, or seconds away from their neighbours
  int late_packets = 0;      ///< of a frame that had ended
  int repeated_columns = 0;  ///< that were there already
  int missing_columns = 0;   ///< of the window, in frames between the first and the last
  int lost_frames = 0;       ///< of which nothing came
  int lost_fragments = 0;    ///< of which fragments were missing
  int other_sensors = 0;     ///< packets of sensors that were not asked for
  int clock_steps = 0;       ///< of the sensor's clock: stamps go on as if it had not
  int imu_samples = 0;       ///< used, for information
  int late_imu_samples = 0;  ///< not newer than those before
  std::string ended_early;   ///< why the recording ends before its end; empty when it does not

  /// "12 columns missing, 3 packets late", or empty when nothing was amiss.
  [[nodiscard]] std::string summary() const;
};

struct AssembledScan;

class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// Nothing when the recording is over. Never throws for what is in it.
  [[nodiscard]] virtual std::optional<Frame> next() = 0;
  [[nodiscard]] virtual SourceCounters counters() const = 0;

  /// Scans in all, for progress; 0 when that is not known beforehand.
  [[nodiscard]] virtual int expected_scans() const { return 0; }

  /// What a user has to know about the recording as a whole, as a line; empty when there is
  /// nothing.
  [[nodiscard]] virtual std::string note() const { return {}; }

  /// Model and mode of the sensor, "OS1-64 512x10" (sensor_info.h); empty where it does not say.
  [[nodiscard]] virtual std::string sensor_name() const { return {}; }

  /// Of the frame given last, all that an Ouster sensor's packets said; null of other recordings.
  [[nodiscard]] virtual const AssembledScan* assembled() const { return nullptr; }
};

enum class RecordingFormat { kAutomatic, kKitti, kOuster };

/// What a recording alone does not say.
struct RecordingOptions {
  RecordingFormat format = RecordingFormat::kAutomatic;
  std::filesystem::path metadata;   ///< of an Ouster sensor; else beside the recording or in it
  std::string sensor;               ///< serial number, where a capture has several sensors
  std::vector<std::string> topics;  ///< where a bag has several with scans or inertial samples
  bool keep_ranges = false;         ///< `assembled` has them
  std::string point_fields;         ///< "x,y,z,i,ring": floats of a point in `*.bin`
};

/// Whatever people have, told by its content and not by its name (docs/formats.md):
/// folders of scans (`*.bin`, PCD, PLY, `*.npy`; in it, in `velodyne/` or as KITTI's raw recordings
/// have them) and single ones, Ouster captures and OSF files, ROS 1 and ROS 2 bags, MCAP files.
/// Throws Error when there is nothing to read, or when what is there can be read in several ways.
[[nodiscard]] std::unique_ptr<ScanSource> open_recording(const std::filesystem::path& path,
                                                         const RecordingOptions& options);

[[nodiscard]] std::unique_ptr<ScanSource> open_recording(
    const std::filesystem::path& path, RecordingFormat format = RecordingFormat::kAutomatic,
    const std::filesystem::path& metadata = {});

/// Metadata that belongs to a capture; throws Error that names where it was looked for.
[[nodiscard]] std::filesystem::path find_metadata(const std::filesystem::path& capture);

}  // namespace saker::lidar
