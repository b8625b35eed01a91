#include "saker/lidar/gate_cause.h"

namespace saker::lidar {

const char* to_string(GateCause cause) {
  switch (cause) {
    case GateCause::none:
      return "believed";
    case GateCause::waits:
      return "that wait for the lidar";
    case GateCause::not_agreed:
      return "before both streams of a sensor agreed";
    case GateCause::shape:
      return "no packet of this sensor";
    case GateCause::address:
      return "from another address";
    case GateCause::port:
      return "from another port";
    case GateCause::serial_number:
      return "of another serial number";
    case GateCause::restarted:
      return "of another init id";
    case GateCause::stamp:
      return "stamped with no time";
    case GateCause::ahead:
      return "stamped ahead of time";
    case GateCause::late:
      return "stamped long before";
    case GateCause::back:
      return "stamped back in time";
    case GateCause::frame:
      return "of a frame that is not due";
    case GateCause::columns:
      return "with columns not in a row";
    case GateCause::out_of_order:
      return "out of order";
    case GateCause::too_many:
      return "more often than the sensor sends";
  }
  return "";
}

}  // namespace saker::lidar
