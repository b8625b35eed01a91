#include "tools/saker/faults/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;
using enum FaultKind;
using P = FaultPlace;

constexpr int kMostFaults = 3;
constexpr double kStays = 0.2;  // of those that may
constexpr std::array kPlaces = {
    "none",    "lidar",    "imu",        "state",     "ack",       "odometry",     "setpoint",
    "command", "scans",    "trajectory", "verdict",   "occupancy", "registration", "segmentation",
    "mapping", "planning", "checker",    "executive", "hold",      "resume",       "return",
    "land",    "abort",    "full",       "slow",      "cut"};

std::vector<FaultKindInfo> kinds() {
  const std::vector<P> channels = {P::lidar,      P::imu,      P::state,    P::ack,
                                   P::odometry,   P::setpoint, P::command,  P::scans,
                                   P::trajectory, P::verdict,  P::occupancy};
  const std::vector<P> stages = {P::registration, P::segmentation, P::mapping, P::planning,
                                 P::checker};
  const std::vector<P> orders = {P::hold, P::resume, P::return_home, P::land, P::abort};
  return {
      {lose, "lose", "share", 0.1, 1, false, 0.1, 10, true, channels},
      {delay, "delay", "s", 0.02, 0.5, false, 0.1, 10, true, channels},
      {repeat, "repeat", "share", 0.1, 1, false, 0.1, 10, true, channels},
      {stick, "stick", "", 0, 0, false, 0.1, 10, true, {P::state, P::odometry}},
      {garbage, "garbage", "share", 0.05, 1, false, 0.1, 5, true, {P::lidar, P::imu, P::state}},
      {flood, "flood", "times", 5, 100, false, 0.1, 2, false, {P::lidar, P::imu}},
      {forge, "forge", "s", 0.03, 1000, true, 0.1, 10, true, {P::lidar, P::imu}},
      {clock_drift, "clock_drift", "ppm", 20, 500, true, 30, 600, true},
      {clock_step, "clock_step", "s", 0.005, 0.1, true, 1, 600, true},
      {imu_bias, "imu_bias", "m/s²", 0.05, 1, true, 1, 60, true},
      {imu_saturation, "imu_saturation", "m/s²", 10.5, 20, false, 1, 60, true},
      {imu_vibration, "imu_vibration", "m/s²", 0.2, 5, false, 1, 60, true},
      {rows_dead, "rows_dead", "share", 0.05, 0.6, false, 1, 60, true},
      {view_covered, "view_covered", "share", 0.1, 1, false, 0.5, 60, true},
      {rain, "rain", "share", 0.01, 0.3, false, 1, 60, true},
      {gust, "gust", "m/s", 2, 8, false, 0.5, 4},
      {wall, "wall", "m", 3, 8, false, 1, 1},
      {person, "person", "m/s", 0.5, 2, false, 1, 1},
      {lorry, "lorry", "m/s", 1, 6, false, 1, 1},
      {stall, "stall", "", 0, 0, false, 0.1, 10, true, stages},
      {restart, "restart", "", 0, 0, false, 0.2, 3, false, {P::checker, P::executive}},
      {battery_drop, "battery_drop", "share", 0.1, 0.9, false, 600, 600, true},
      {battery_unknown, "battery_unknown", "", 0, 0, false, 0.1, 30, true},
      {disk, "disk", "s", 0.1, 10, false, 1, 60, true, {P::full, P::slow, P::cut}},
      {prior, "prior", "m", 1, 20, false, 600, 600, true},
      {order, "order", "", 0, 0, false, 1, 1, false, orders},
  };
}

const FaultKindInfo& info_of(FaultKind kind) {
  return fault_kinds()[static_cast<std::size_t>(kind)];
}

double log_uniform(core::Rng& rng, double least, double most) {
  return least * std::pow(most / least, rng.uniform());
}

Fault drawn(core::Rng& rng, double seconds) {
  const auto& all = fault_kinds();
  const FaultKindInfo& info =
      all[static_cast<std::size_t>(rng.index(static_cast<int>(all.size())))];
  Fault fault;
  fault.kind = info.kind;
  fault.place =
      info.places[static_cast<std::size_t>(rng.index(static_cast<int>(info.places.size())))];
  fault.at_s = rng.uniform(0, seconds);
  const double sign = rng.chance(0.5) ? -1 : 1;
  if (info.most > 0) fault.strength = log_uniform(rng, info.least, info.most);
  if (info.either_sign) fault.strength *= sign;
  fault.lasts_s = log_uniform(rng, info.shortest_s, info.longest_s);
  const bool stays = rng.chance(kStays);
  if (info.may_stay && stays) fault.lasts_s = std::numeric_limits<double>::infinity();
  fault.towards_deg = rng.uniform(-180, 180);
  fault.seed = static_cast<std::uint64_t>(rng.index(1 << 30));
  return fault;
}

template <class Named>
int index_of(const Named& names, const std::string& name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return static_cast<int>(i);
  return -1;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const FaultKindInfo& info : fault_kinds()) names.emplace_back(info.name);
  return names;
}

Fault fault_from_json(const Json& json, const std::string& where) {
  const std::string kind = json.at("kind"), place = json.at("place");
  const int k = index_of(kind_names(), kind), p = index_of(kPlaces, place);
  if (k < 0) throw Error(fmt::format("{}: kind \"{}\", expected a kind of fault", where, kind));
  Fault fault;
  fault.kind = fault_kinds()[static_cast<std::size_t>(k)].kind;
  const auto& places = info_of(fault.kind).places;
  fault.place = static_cast<FaultPlace>(p);
  if (p < 0 || std::ranges::find(places, fault.place) == places.end())
    throw Error(
        fmt::format("{}: place \"{}\", expected one where there is {}", where, place, kind));
  fault.at_s = json.at("at_s");
  fault.lasts_s = json.at("lasts_s").is_null() ? std::numeric_limits<double>::infinity()
                                               : json.at("lasts_s").get<double>();
  fault.strength = json.at("strength");
  fault.towards_deg = json.at("towards_deg");
  fault.seed = json.at("seed");
  return fault;
}

}  // namespace

const std::vector<FaultKindInfo>& fault_kinds() {
  static const std::vector<FaultKindInfo> all = kinds();
  return all;
}

const char* to_string(FaultKind kind) { return info_of(kind).name; }
const char* to_string(FaultPlace place) { return kPlaces[static_cast<std::size_t>(place)]; }

std::string text_of(const Fault& fault) {
  std::string text = to_string(fault.kind);
  if (fault.place != FaultPlace::none) text += fmt::format(" {}", to_string(fault.place));
  const FaultKindInfo& info = info_of(fault.kind);
  if (*info.unit != 0) text += fmt::format(", {:.3g} {}", fault.strength, info.unit);
  text += fmt::format(" from {:.2f} s", fault.at_s);
  return text + (std::isfinite(fault.lasts_s) ? fmt::format(" for {:.2f} s", fault.lasts_s)
                                              : std::string(" on"));
}

const Fault* acting(const FaultSchedule& schedule, FaultKind kind, FaultPlace place, double t_s) {
  const Fault* strongest = nullptr;
  for (const Fault& fault : schedule) {
    if (fault.kind != kind || fault.place != place || !fault.acts(t_s)) continue;
    if (strongest == nullptr || std::abs(fault.strength) > std::abs(strongest->strength))
      strongest = &fault;
  }
  return strongest;
}

FaultSchedule draw_faults(core::Rng& rng, double seconds) {
  FaultSchedule schedule(static_cast<std::size_t>(1 + rng.index(kMostFaults)));
  for (Fault& fault : schedule) fault = drawn(rng, seconds);
  std::ranges::stable_sort(schedule, {}, &Fault::at_s);
  return schedule;
}

Json to_json(const FaultSchedule& schedule) {
  Json list = Json::array();
  for (const Fault& fault : schedule) {
    list.push_back({{"kind", to_string(fault.kind)},
                    {"place", to_string(fault.place)},
                    {"at_s", fault.at_s},
                    {"lasts_s", std::isfinite(fault.lasts_s) ? Json(fault.lasts_s) : Json()},
                    {"strength", fault.strength},
                    {"towards_deg", fault.towards_deg},
                    {"seed", fault.seed}});
  }
  return list;
}

FaultSchedule faults_from_json(const Json& json, std::string_view where) {
  if (!json.is_array()) throw Error(fmt::format("{}: expected a list of faults", where));
  FaultSchedule schedule;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string entry = fmt::format("{}: fault {}", where, i + 1);
    try {
      schedule.push_back(fault_from_json(json[i], entry));
    } catch (const Json::exception& error) {
      throw Error(fmt::format("{}: {}", entry, error.what()));
    }
  }
  return schedule;
}

}  // namespace saker::tools
