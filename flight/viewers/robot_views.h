#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "flight/bus/occupancy_messages.h"
#include "flight/bus/scan_messages.h"
#include "flight/viewers/robot_view.h"

namespace saker::flight::viewers {

/// Every robot that is heard, by its name. One thread.
class RobotViews {
 public:
  static constexpr std::size_t kMostRobots = 32;
  using Bytes = std::span<const std::uint8_t>;

  /// \param lost_s  as RobotView has it
  RobotViews(std::shared_ptr<const Site> site, double lost_s);

  /// The robot's view, made where it is new; null where there are too many.
  RobotView* of(const std::string& robot);
  /// The view of one that was heard; null where it was not. Makes none.
  [[nodiscard]] RobotView* find(const std::string& robot);
  /// With a site of its own: a run's robot, with its prior map.
  RobotView* add(const std::string& robot, std::shared_ptr<const Site> site);

  /// A message as it travels: decoded by the suffix of its channel ("R1_STATE"). False where it is
  /// not what its channel holds, or of a channel that viewers are told nothing of.
  bool hear(const std::string& channel, Bytes bytes, double t);

  /// Whether scans and occupancy are decoded at all: they are most of the bytes.
  void want_bulk(bool scans, bool occupancy);

  [[nodiscard]] std::map<std::string, RobotView>& all() { return views_; }
  void clear();

 private:
  template <class Message>
  bool hear_as(RobotView& view, Bytes bytes, double t);
  template <class Message, class Joiner>
  bool hear_joined(RobotView& view, Joiner& joiner, Bytes bytes, double t);
  bool hear_scan(RobotView& view, Bytes bytes, double t);
  bool hear_occupancy(RobotView& view, Bytes bytes, double t);

  std::shared_ptr<const Site> site_;
  double lost_s_;
  bool scans_ = false, occupancy_ = false;
  std::map<std::string, RobotView> views_;
  std::map<std::string, ScanJoiner> scan_joiners_;
  std::map<std::string, OccupancyJoiner> occupancy_joiners_;
};

}  // namespace saker::flight::viewers
