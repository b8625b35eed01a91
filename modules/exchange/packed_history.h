#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "saker/exchange/coded.h"
#include "saker/slam/history.h"
#include "saker/slam/trajectory.h"

/// A flight in bytes: a header, then one entry after another, so that what was packed earlier is
/// the beginning of what is packed later.
///
/// The header says where the flight began in the team's frame, if anybody measured it: pose and
/// variances as single-precision numbers, the rest of the covariance is zero.
///
/// Poses are relative to the previous one as it is unpacked, so that errors do not add up: 1 mm,
/// 0.01°, 1 µs. Models: 1 mm, 0.01°, sizes 1 cm, radii 1 mm; class probabilities 1/64; covariances
/// as in packed_covariance.h. All by what is usual in this flight (coded.h): about 30 bytes a
/// measurement and 20 a pose.
namespace saker::exchange {

/// Packs the entries of one flight in their order.
class HistoryPacker {
 public:
  /// \param classes  in the class table: entries of every class_probability
  /// \param takeoff  T_base_odom, where it was surveyed
  HistoryPacker(const std::string& robot, std::uint32_t flight, int classes,
                const std::optional<slam::PosePrior>& takeoff = std::nullopt);

  /// What every history begins with.
  [[nodiscard]] std::string header() const;
  /// The bytes of the next entry. Empty, and nothing changed, where stamp or pose is none;
  /// measurements that are not finite, of other classes, or more than 5000 are left out and
  /// counted.
  [[nodiscard]] std::string pack(const slam::HistoryEntry& entry);

  [[nodiscard]] long left_out() const { return left_out_; }

 private:
  std::string robot_;
  std::uint32_t flight_;
  int classes_;
  std::optional<slam::PosePrior> takeoff_;
  Time stamp_ = 0;
  SE3 T_odom_lidar_ = SE3::Identity();  // of the last entry, as it is unpacked
  Statistics statistics_;
  long left_out_ = 0;
};

/// Header and all entries.
[[nodiscard]] std::string packed(const slam::History& history, int classes,
                                 const std::optional<slam::PosePrior>& takeoff = std::nullopt);

struct UnpackedHistory {
  slam::History history;
  std::optional<slam::PosePrior> takeoff;  ///< T_base_odom
  int classes = 0;
  std::size_t bytes = 0;  ///< that were whole entries; what follows is cut or damaged
};

/// All whole entries; nothing where not even the header is there or it is none.
[[nodiscard]] std::optional<UnpackedHistory> unpacked(std::string_view bytes);

}  // namespace saker::exchange
