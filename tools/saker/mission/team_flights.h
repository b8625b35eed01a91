#pragma once

#include <filesystem>
#include <vector>

#include "saker/autonomy/team_map.h"
#include "saker/exchange/store.h"
#include "saker/multirobot/merge.h"
#include "tools/saker/command.h"
#include "tools/saker/experiment/mission_run.h"
#include "tools/saker/mission/team_link.h"
#include "tools/saker/mission/team_mission.h"

namespace saker::tools {

/// A robot where it takes off.
struct PlacedRobot {
  SE3 T_base_world = SE3::Identity();  ///< true
  slam::PosePrior surveyed{};          ///< the same as the team knows it
  autonomy::Lot lot;
  std::vector<int> targets{};  ///< ids, in the truth, of what truly stands in its lot
};

/// The site, in base.
struct TeamSite {
  objects::ObjectMap truth;
  objects::ObjectMap said;      ///< beforehand
  std::vector<int> targets;     ///< ids of the vehicles to be mapped
  std::vector<double> fence_m;  ///< corners: all that is said where nothing is of the targets
  std::vector<PlacedRobot> robots;
};

/// Throws Error, naming the robot, where there is no room to take off or nothing in its lot.
[[nodiscard]] TeamSite build_team_site(const TeamMission& mission, std::uint64_t seed);

/// One robot's part of the mission.
struct TeamFlight {
  std::string robot;
  Json results{};  ///< of `fly`
  int known = 0;   ///< targets that others had mapped well: not visited
  int weak = 0;    ///< that others had mapped, but not well enough
  std::size_t history_bytes = 0;
  ContactFigures before{}, after{};  ///< at the base
  multirobot::MergeReport merge{};
};

/// A robot after another: at the base it hears what is known, flies, tells the base, which merges.
/// The base merges what came over the link, and no more; a robot that did not hear all of it flies
/// by what was said beforehand alone.
class TeamFlights {
 public:
  /// \param out  each robot has a folder in it, as `fly` leaves it; where one is finished it is
  /// read
  TeamFlights(const TeamMission& mission, const TeamSite& site, const CommonOptions& common,
              std::filesystem::path out);

  /// All of them, in their order.
  void fly_all();

  [[nodiscard]] const std::vector<TeamFlight>& flights() const { return flights_; }
  [[nodiscard]] const multirobot::MultiRobotSlam& merged() const { return merged_; }
  /// With covariances, in base.
  [[nodiscard]] objects::ObjectMap map() const;

 private:
  void fly(std::size_t robot);
  [[nodiscard]] objects::ObjectMap prior_of(std::size_t robot, TeamFlight& flight) const;
  [[nodiscard]] std::vector<double> fence_of(std::size_t robot,
                                             const objects::ObjectMap& prior) const;
  [[nodiscard]] Json flown(std::size_t robot, const objects::ObjectMap& prior) const;
  [[nodiscard]] ContactFigures contact(std::size_t number, exchange::Store& robot);
  void merge(TeamFlight& flight);

  const TeamMission& mission_;
  const TeamSite& site_;
  CommonOptions common_;
  std::filesystem::path out_;
  const objects::ClassTable& table_;
  exchange::MemoryStore base_;
  multirobot::MultiRobotSlam merged_;
  std::vector<TeamFlight> flights_;
};

}  // namespace saker::tools
