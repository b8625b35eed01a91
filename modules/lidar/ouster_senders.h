#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/datagrams.h"
#include "saker/lidar/packet.h"

/// Which Ouster sensors a capture holds: one sensor is one stream, told by its serial number where
/// packets say it, else by its address.
namespace saker::lidar {

struct OusterSender {
  std::string address;              ///< where its packets come from
  std::uint64_t serial_number = 0;  ///< 0: its packets do not say
  int packets = 0;                  ///< lidar packets among the first of the capture

  int last_column = -1;  ///< the largest number of a column
  int frames = 0;        ///< that began in them
  int last_frame = 0;    ///< number of the newest

  /// Serial number where there is one, else the address.
  [[nodiscard]] std::string name() const;
};

/// Reads the beginning of a capture (20,000 datagrams at most).
[[nodiscard]] std::vector<OusterSender> find_ouster_senders(const std::filesystem::path& capture,
                                                            const PacketFormat& format);

/// Throws Error where the sender's columns are not those of the metadata's mode.
void check_mode(const OusterSender& sender, const SensorInfo& info, const std::string& where);

/// Nothing where there is one only. Throws Error (`where` is what it begins with) when there are
/// several and `wanted` names none of them, when it names one that is not there, and when the
/// sender's serial number or mode is another than the metadata's.
[[nodiscard]] std::optional<OusterSender> choose_sender(const std::vector<OusterSender>& senders,
                                                        const std::string& wanted,
                                                        const SensorInfo& info,
                                                        const std::string& where);

}  // namespace saker::lidar
