#pragma once

#include <filesystem>
#include <string>

#include "saker/lidar/sensor_info.h"

/// Reads and writes the vendor's metadata JSON. Read are the flat form of firmware 1 and 2 and the
/// nested one of the vendor's newer tools, of firmware 1.12 to 3.2; what older firmware leaves out
/// (profile, data format, transforms) gets the vendor's documented default. Written is the nested
/// form.
namespace saker::lidar {

/// Throws Error that names the file and the key that is missing or wrong.
[[nodiscard]] SensorInfo read_metadata(const std::filesystem::path& file);

/// `where` is what a message begins with.
[[nodiscard]] SensorInfo parse_metadata(const std::string& json, const std::string& where);

[[nodiscard]] std::string metadata_json(const SensorInfo& info);

/// Written beside the file and renamed. Throws Error when that fails.
void write_metadata(const SensorInfo& info, const std::filesystem::path& file);

}  // namespace saker::lidar
