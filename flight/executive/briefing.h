#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/presence.h"
#include "flight/executive/robot_exchange.h"
#include "flight/process/configuration.h"
#include "saker/autonomy/team.h"

namespace saker::flight {

/// What the team tells this robot before it takes off, and the map of all when it has landed.
///
/// Nothing of it runs in flight. Before take-off: `exchange.call_s` where no base answers, else at
/// most `exchange.hear_s` and `team.merge_s`; meanwhile the bus is handled, so that others see that
/// this robot is there.
class Briefing {
 public:
  /// What is given has to outlive this. Throws Error on an invalid configuration.
  Briefing(const ProcessConfig& config, RobotExchange& exchange, Bus& bus, Presence& presence);

  /// Before any loop runs: tells the team what this robot goes by, hears it, merges what it mapped.
  /// \param said  the prior map, `world`. \return what is to be flown to, `world`
  [[nodiscard]] objects::ObjectMap brief(const objects::ObjectMap& said);

  /// After the last loop: leaves merged.json and merged.smap, all flights with this one in `base`
  /// (in this one's `world` where its take-off was not surveyed), if others told of any.
  void debrief(const slam::History& own, const std::filesystem::path& out);

  /// What was used before take-off, in a line, and the same for `_HEALTH`.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::vector<std::pair<std::string, long>> figures() const;

 private:
  void tell(const objects::ObjectMap& said);
  void attend(double longest_s, const std::function<bool()>& done);
  [[nodiscard]] objects::ObjectMap planned(const objects::ObjectMap& said);
  [[nodiscard]] core::Budget budget() const;

  const ProcessConfig& config_;
  RobotExchange& exchange_;
  Bus& bus_;
  Presence& presence_;
  autonomy::Team team_;
  std::string text_;
  long flights_ = 0, objects_ = 0, known_ = 0;
};

}  // namespace saker::flight
