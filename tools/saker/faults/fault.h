#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "saker/core/rng.h"

/// What goes wrong in a flight, as data: kinds of faults, faults of one mission, and their draw
/// from a seed.
///
/// By kind after PX4's failure module (off, stuck, garbage, wrong, slow); a schedule that a seed
/// gives and that replays to the byte after Zhou et al., "FoundationDB", SIGMOD 2021, section 4.
/// Times are seconds of the mission since its begin; a fault acts in [at_s, at_s + lasts_s).
namespace saker::tools {

enum class FaultKind {
  // Of a channel.
  lose,
  delay,
  repeat,
  stick,
  garbage,
  flood,  ///< copies of each packet
  forge,  ///< a packet of somebody else beside each of the sensor's
  // Of the sensor.
  clock_drift,
  clock_step,
  imu_bias,
  imu_saturation,
  imu_vibration,
  rows_dead,
  view_covered,
  rain,
  // Of what is about the vehicle.
  gust,
  wall,
  person,
  lorry,
  // Of the vehicle's computer and the vehicle.
  stall,
  restart,
  battery_drop,
  battery_unknown,
  disk,
  // Of what people say.
  prior,
  order,
};

/// Where it happens: a channel between processes, a stage, a process; what it is that is ordered,
/// or that is wrong with the disk.
enum class FaultPlace {
  none,
  lidar,
  imu,
  state,
  ack,
  odometry,  ///< to the flight controller
  setpoint,
  command,
  scans,  ///< to the collision checker
  trajectory,
  verdict,
  occupancy,
  registration,  ///< the stage
  segmentation,
  mapping,
  planning,
  checker,
  executive,
  hold,  ///< the order
  resume,
  return_home,
  land,
  abort,
  full,  ///< the disk
  slow,
  cut,  ///< it loses its power in the middle of a write
};

/// A person or a lorry comes from there: in sight before it is where the vehicle was.
inline constexpr double kMoverComesFrom_m = 12;

/// One thing that goes wrong.
struct Fault {
  FaultKind kind = FaultKind::lose;
  FaultPlace place = FaultPlace::none;
  double at_s = 0;
  double lasts_s = 0;      ///< infinite: until the end
  double strength = 0;     ///< in the kind's unit
  double towards_deg = 0;  ///< in `world`: where a gust blows, a person goes; else of no meaning
  std::uint64_t seed = 0;  ///< of its own random numbers

  [[nodiscard]] bool acts(double t_s) const { return t_s >= at_s && t_s < at_s + lasts_s; }
};

/// What a kind can be.
struct FaultKindInfo {
  FaultKind kind;
  const char* name;
  const char* unit;  ///< of the strength; empty: it has none
  double least = 0, most = 0;
  bool either_sign = false;
  double shortest_s = 0, longest_s = 0;
  bool may_stay = false;  ///< a fifth of them lasts until the end
  std::vector<FaultPlace> places = {FaultPlace::none};
};

[[nodiscard]] const std::vector<FaultKindInfo>& fault_kinds();
[[nodiscard]] const char* to_string(FaultKind kind);
[[nodiscard]] const char* to_string(FaultPlace place);
/// "lose verdict, 40 % from 12.3 s for 2.0 s"
[[nodiscard]] std::string text_of(const Fault& fault);

/// All faults of one mission.
using FaultSchedule = std::vector<Fault>;

/// The one that acts at that time, the strongest of several; null: none.
[[nodiscard]] const Fault* acting(const FaultSchedule& schedule, FaultKind kind, FaultPlace place,
                                  double t_s);

/// One to three faults of a mission of `seconds`, each kind as likely as any other, each place of
/// a kind too. A function of the generator's state.
[[nodiscard]] FaultSchedule draw_faults(core::Rng& rng, double seconds);

[[nodiscard]] nlohmann::ordered_json to_json(const FaultSchedule& schedule);
/// Throws Error that names the entry and what was expected; \param where begins the message
[[nodiscard]] FaultSchedule faults_from_json(const nlohmann::ordered_json& json,
                                             std::string_view where);

}  // namespace saker::tools
