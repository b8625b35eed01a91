#pragma once

#include <string>
#include <vector>

#include "saker/core/config.h"

namespace saker::flight::ground {

struct GroundConfig {
  int port = 8765;
  std::string listen;
  std::string folder = "saker-ground";

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("port", port, {0, 65535}, "",
              "Page and WebSocket are served on this TCP port; 0: one that is free.");
    v.setting("listen", listen, "",
              "Address of the interface that other machines reach, by TLS and with a key in the "
              "address; empty: this machine alone.");
    v.setting("folder", folder, "",
              "Key and certificate of `listen`, and who ordered what (orders.log), are kept in "
              "this folder, made if need be.");
  }
};

/// Where the site is on the Earth.
struct SiteConfig {
  std::vector<double> origin;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("origin", origin, {-180, 360}, "°",
              "Latitude and longitude of the take-off point, heading of x clockwise from north; "
              "empty: not known.");
  }
};

}  // namespace saker::flight::ground
