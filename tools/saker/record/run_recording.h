#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "flight/viewers/recording.h"
#include "saker/autonomy/plant.h"

namespace saker::tools {

/// `--record FILE.mcap` of a command: what viewers are told of its run, with the schemas of
/// saker-ground, and every scan as the sensor said it, which `saker replay` reads.
///
/// Scans go into the file while the run goes on; the rest (objects, poses, some points of each
/// scan) once its folder is written, since poses and map are those after SLAM.
class RunRecording {
 public:
  /// \param robot  whose run it is, as the page calls it
  /// Throws Error where the name does not end in .mcap or the file cannot be written.
  RunRecording(const std::filesystem::path& file, std::string robot);

  /// \param scan  in the order of time; one without points is left out
  void add(const lidar::Scan& scan);

  /// \param out     the run's folder, finished
  /// \param points  some of each scan, in the order of time, `odom` being the map's frame
  /// Logs what was written. Throws Error where something cannot be read or written.
  void finish(const std::filesystem::path& out, const flight::viewers::Site& site,
              const std::vector<autonomy::RegisteredScan>& points);

 private:
  std::filesystem::path file_;
  std::string robot_;
  flight::viewers::Recording recording_;
};

/// The file of --record, which may be written: none where `file` is empty. Throws Error where it
/// is there and `force` is false, or where its folder is not there.
[[nodiscard]] std::optional<std::filesystem::path> record_file(const std::string& file, bool force);

}  // namespace saker::tools
