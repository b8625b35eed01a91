#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saker/autonomy/config.h"
#include "saker/autonomy/team_config.h"
#include "saker/lidar/mount.h"
#include "saker/simulation/mission/mission_config.h"
#include "tools/saker/mission/team_division.h"
#include "tools/saker/mission/team_link.h"

namespace saker::tools {

/// A robot of a team and what it is to do. Frame `base`: the team's, for a site that is simulated
/// in the middle of its aisle, x along it.
struct RobotConfig {
  std::string name = "R1";
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  double height_m = 3;
  lidar::MountConfig mount;
  active::PolicyName policy = active::PolicyName::saker;
  std::vector<double> lot_m;
  std::vector<std::string> set;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "capitals and digits, one robot's only");
    v.field("x_m", x_m, {-1000, 1000}, "m", "take-off, in base");
    v.field("y_m", y_m, {-1000, 1000}, "m", "take-off, in base");
    v.field("yaw_deg", yaw_deg, {-360, 360}, "°", "heading there, from base's x axis");
    v.field("height_m", height_m, {1, 60}, "m", "of take-off and viewpoints");
    v.group("mount", mount, "where its lidar is on the body");
    v.field("policy", policy, "", "visit, paper or saker");
    v.field("lot_m", lot_m, {-1e5, 1e5}, "m",
            "corners x1, y1, x2, y2, … of what it is to cover, in base; empty: everything");
    v.field("set", set, "", "settings of this robot, key=value, over the team's");
  }
};

/// Where robots take off.
struct TakeoffSurveyConfig {
  autonomy::SurveyConfig survey;
  double within_m = 8;

  template <class Visitor>
  void visit(Visitor& v) {
    survey.visit(v);
    v.field("within_m", within_m, {0, 100}, "m",
            "of a place that is not free, the nearest free one is taken");
  }
};

/// What a mission file says: robots that fly one after another over one site.
struct TeamMissionConfig {
  std::string scenario;
  std::vector<std::string> set;
  std::vector<RobotConfig> robots;
  TakeoffSurveyConfig takeoff;
  DivisionConfig division;
  LinkConfig link;
  bool at_once = false;
  double known_gate_m = autonomy::TeamConfig{}.known_gate_m;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("scenario", scenario, "", "the site, kind mission; from this file's folder");
    v.field("set", set, "",
            "settings of all robots and of the base, key=value, over those of the command line");
    v.list("robots", robots, "in the order of their flights");
    v.group("takeoff", takeoff, "how well take-off poses are known");
    v.group("division", division, "whose lot is what");
    v.group("link", link, "between a robot and its base, at the base");
    v.field("at_once", at_once, "",
            "as if they flew at once: nobody hears before its flight what others mapped");
    v.field("known_gate_m", known_gate_m, {0.1, 50}, "m",
            "between what was said of an object beforehand and what robots mapped: three "
            "deviations of a prior of 1 m");
  }
};

/// The same, checked, with all that it names.
struct TeamMission {
  TeamMissionConfig config;
  std::string name{};  ///< of the file, without its ending
  simulation::MissionConfig site{};
  autonomy::Config base{};                 ///< what the base is told, which merges
  std::vector<autonomy::Config> robots{};  ///< one each: what its program is told
};

/// A scenario file of kind mission. Throws Error.
[[nodiscard]] simulation::MissionConfig read_site(const std::string& file);

/// Throws Error, one line with the file's name, on anything that cannot be flown.
[[nodiscard]] TeamMission read_team_mission(const std::filesystem::path& file,
                                            const autonomy::Config& config);

}  // namespace saker::tools
