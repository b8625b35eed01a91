#include "saker/autonomy/team.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <tuple>

#include "saker/core/error.h"

namespace saker::autonomy {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr const char* kNobodyKnows = "nobody knows where it took off";

const char* why(multirobot::MergeStatus status) {
  switch (status) {
    case multirobot::MergeStatus::not_aligned:
      return kNobodyKnows;
    case multirobot::MergeStatus::invalid:
      return "not a flight";
    case multirobot::MergeStatus::merged:
    case multirobot::MergeStatus::nothing_new:
      return "";
  }
  return "";
}

Lot lot_of(const TeamConfig& config) {
  try {
    return Lot(config.lot_m);
  } catch (const Error&) {
    throw Error(fmt::format("team.lot_m: {} numbers, expected x and y of three corners or more",
                            config.lot_m.size()));
  }
}

}  // namespace

Matrix6d covariance_of(const SurveyConfig& config) {
  Vector6d sd;
  sd << config.level_sd_deg * kDegree, config.level_sd_deg * kDegree,
      config.heading_sd_deg * kDegree, Eigen::Vector3d::Constant(config.place_sd_m);
  return sd.cwiseAbs2().asDiagonal();
}

std::optional<slam::PosePrior> takeoff_pose(const TakeoffConfig& config) {
  if (config.position_m.empty()) return std::nullopt;
  if (config.position_m.size() != 3) {
    throw Error(fmt::format("team.takeoff.position_m: {} numbers, expected x, y, z or none",
                            config.position_m.size()));
  }
  SE3 T_base_world = SE3::Identity();
  T_base_world.translation() = Eigen::Vector3d(config.position_m.data());
  T_base_world.rotate(Eigen::AngleAxisd(config.yaw_deg * kDegree, Eigen::Vector3d::UnitZ()));
  return slam::PosePrior{T_base_world, covariance_of(config.survey)};
}

Team::Team(const TeamConfig& config, const multirobot::MergeConfig& merge,
           const slam::SlamConfig& slam, const objects::ClassTable& table)
    : config_(core::checked(config, "team")),
      table_(table),
      takeoff_(takeoff_pose(config.takeoff)),
      lot_(lot_of(config)),
      merged_(merge, slam, table) {}

ToldFlight& Team::told_of(const slam::History& history) {
  const auto name = [](const ToldFlight& f) { return std::tie(f.robot, f.flight); };
  const auto place =
      std::ranges::lower_bound(told_, std::tie(history.robot, history.flight), {}, name);
  if (place != told_.end() && place->robot == history.robot && place->flight == history.flight)
    return *place;
  return *told_.insert(place, {.robot = history.robot, .flight = history.flight});
}

void Team::add(std::span<const exchange::UnpackedHistory> told, const core::Budget& budget) {
  // Whoever says where it took off makes the map in which the others are to be found.
  for (const bool placed : {true, false}) {
    for (const exchange::UnpackedHistory& flight : told) {
      if (placed == (takeoff_ && flight.takeoff)) merge(flight, placed, budget);
    }
  }
}

void Team::merge(const exchange::UnpackedHistory& told, bool placed, const core::Budget& budget) {
  ToldFlight& flight = told_of(told.history);
  flight.entries = static_cast<int>(told.history.entries.size());
  flight.left_out = "";
  if (flight.merged == flight.entries) return;
  if (!placed && merged_.flights().empty()) {
    flight.left_out = takeoff_ ? kNobodyKnows : "nobody measured where this robot takes off";
  } else if (budget.used_up(0)) {
    flight.left_out = "no time was left";
  } else {
    const multirobot::MergeReport report =
        merged_.add(told.history, placed ? told.takeoff : std::nullopt, budget);
    flight.merged += report.entries;
    flight.left_out = why(report.status);
    if (report.entries > 0 && flight.merged < flight.entries) flight.left_out = "time was up";
  }
}

void Team::add_own(const slam::History& history, const core::Budget& budget) {
  (void)merged_.add(history, takeoff_, budget);
}

std::string Team::text() const {
  std::string text;
  for (const ToldFlight& flight : told_) {
    text += fmt::format("{}{} flight {} ({} of {} keyframes", text.empty() ? "" : "; ",
                        flight.robot, flight.flight, flight.merged, flight.entries);
    text += flight.left_out.empty() ? ")" : fmt::format(": {})", flight.left_out);
  }
  return text.empty() ? "no flight of others" : text;
}

objects::ObjectMap Team::map() const {
  objects::ObjectMap map = merged_.reported_map();
  map.frame = takeoff_ ? "base" : "world";
  return map;
}

TeamPrior Team::prior(const objects::ObjectMap& said, const active::TargetsConfig& config) const {
  const SE3& T_base_world = takeoff_.value().pose;
  TeamPrior result = team_prior(in_frame("base", T_base_world, said), map(), lot_,
                                config_.known_gate_m, config, table_);
  result.prior = in_frame("world", T_base_world.inverse(), result.prior);
  return result;
}

}  // namespace saker::autonomy
