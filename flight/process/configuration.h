#pragma once

#include "autonomy/config.h"
#include "bus/bus.h"

namespace saker::flight {

/// The whole configuration file: the autonomy's, and the networks.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
  }
};

}  // namespace saker::flight
