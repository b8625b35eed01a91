#include "tools/sim/mavlink/parameters.h"

#include <algorithm>
#include <iterator>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/parameter_exchange.h"

namespace saker::tools {

using flight::mavlink::Autopilot;
using flight::mavlink::ParamRequestRead;
using flight::mavlink::ParamSet;
using flight::mavlink::ParamValue;

namespace {

constexpr std::uint8_t kInt8 = 2, kInt32 = 6, kFloat = 9;  // MAV_PARAM_TYPE
constexpr std::uint16_t kNoIndex = 65535;

}  // namespace

AutopilotParameters::AutopilotParameters(Autopilot autopilot)
    : bytewise_(autopilot == Autopilot::px4) {
  if (bytewise_) {
    entries_ = {{"EKF2_EV_CTRL", {15}},        {"EKF2_HGT_REF", {3}},
                {"EKF2_GPS_CTRL", {0}},        {"EKF2_MAG_TYPE", {5}},
                {"EKF2_EV_DELAY", {0, false}}, {"SYS_HAS_GPS", {0}},
                {"SYS_HAS_MAG", {0}},          {"COM_RC_IN_MODE", {4}},
                {"COM_RCL_EXCEPT", {4}},       {"COM_OF_LOSS_T", {0.5, false}},
                {"COM_OBL_RC_ACT", {4}},       {"EKF2_EV_POS_X", {0, false}},
                {"EKF2_EV_POS_Y", {0, false}}, {"EKF2_EV_POS_Z", {0, false}}};
    return;
  }
  // As the records of ../shared/data/mavlink were flown.
  entries_ = {{"AHRS_EKF_TYPE", {3}},     {"EK3_ENABLE", {1}},
              {"EK3_SRC1_POSXY", {6}},    {"EK3_SRC1_VELXY", {6}},
              {"EK3_SRC1_POSZ", {6}},     {"EK3_SRC1_VELZ", {6}},
              {"EK3_SRC1_YAW", {6}},      {"VISO_TYPE", {1}},
              {"VISO_DELAY_MS", {10}},    {"GPS1_TYPE", {0}},
              {"COMPASS_ENABLE", {0}},    {"FS_THR_ENABLE", {0}},
              {"FS_GCS_ENABLE", {5}},     {"FS_EKF_ACTION", {1}},
              {"SYSID_MYGCS", {255}},     {"GUID_TIMEOUT", {0.5, false}},
              {"VISO_POS_X", {0, false}}, {"VISO_POS_Y", {0, false}},
              {"VISO_POS_Z", {0, false}}};
}

std::uint8_t AutopilotParameters::type(const Entry& entry) const {
  if (!entry.whole) return kFloat;
  return bytewise_ ? kInt32 : kInt8;
}

ParamValue AutopilotParameters::message(const std::string& name, const Entry& entry) const {
  ParamValue message;
  message.param_value = flight::mavlink::field_of(entry.value, type(entry), bytewise_);
  message.param_count = static_cast<std::uint16_t>(entries_.size());
  message.param_index =
      static_cast<std::uint16_t>(std::distance(entries_.begin(), entries_.find(name)));
  flight::mavlink::write_text(name, message.param_id);
  message.param_type = type(entry);
  return message;
}

std::optional<ParamValue> AutopilotParameters::answer(const ParamRequestRead& request) const {
  auto entry = entries_.end();
  if (request.param_index < 0) {
    entry = entries_.find(flight::mavlink::text_of(request.param_id));
  } else if (static_cast<std::size_t>(request.param_index) < entries_.size()) {
    entry = std::next(entries_.begin(), request.param_index);
  }
  if (entry == entries_.end()) return std::nullopt;
  return message(entry->first, entry->second);
}

std::optional<ParamValue> AutopilotParameters::set(const ParamSet& request) {
  const auto entry = entries_.find(flight::mavlink::text_of(request.param_id));
  if (entry == entries_.end()) return std::nullopt;
  const double value =
      flight::mavlink::value_of(request.param_value, request.param_type, bytewise_);
  if (std::isfinite(value)) entry->second.value = value;
  ParamValue answer = message(entry->first, entry->second);
  answer.param_index = kNoIndex;
  return answer;
}

std::vector<ParamValue> AutopilotParameters::all() const {
  std::vector<ParamValue> messages;
  for (const auto& [name, entry] : entries_) messages.push_back(message(name, entry));
  return messages;
}

}  // namespace saker::tools
