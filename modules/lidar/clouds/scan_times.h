#pragma once

#include <filesystem>
#include <vector>

#include "saker/core/time.h"

namespace saker::lidar {

/// When each scan of a folder was taken.
///
/// `times.txt` in the folder or beside it has seconds, a line a scan; `timestamps.txt` (KITTI's raw
/// recordings) dates, a line a scan or, where files are missing, a line a number. Else names may be
/// times: nanoseconds (19 digits), microseconds (16), or seconds and nanoseconds
/// ("1583836591_182590976"). Else scans are 0.1 s apart. \param scans  the folder \param files  in
/// it, in their order Throws Error when a file of times does not fit the scans.
[[nodiscard]] std::vector<Time> times_of_scans(const std::filesystem::path& scans,
                                               const std::vector<std::filesystem::path>& files);

/// The folder above, of a path however it is written.
[[nodiscard]] std::filesystem::path parent_of(const std::filesystem::path& folder);

}  // namespace saker::lidar
