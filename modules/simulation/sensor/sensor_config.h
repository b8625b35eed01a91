#pragma once

#include <string>

#include "saker/core/config.h"

namespace saker::simulation {

/// The Ouster sensor, and what the network does to its packets.
struct CaptureConfig {
  std::string profile = "RNG19_RFL8_SIG16_NIR16";
  int rows = 64;
  int columns = 1024;
  int window_first = -1;
  int window_last = -1;
  double lost_share = 0;
  double repeated_share = 0;
  double late_share = 0;
  int mtu = 1500;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("profile", profile, "", "layout of the packets, as in the vendor's metadata");
    v.field("rows", rows, {16, 128}, "", "beams: 16, 32, 64 or 128");
    v.field("columns", columns, {512, 2048}, "", "of a revolution: 512, 1024 or 2048");
    v.field("window_first", window_first, {-1, 2047}, "", "first column that is sent; -1: all");
    v.field("window_last", window_last, {-1, 2047}, "",
            "last column that is sent; before the first: the window wraps");
    v.field("lost_share", lost_share, {0, 1}, "", "of the packets that never come");
    v.field("repeated_share", repeated_share, {0, 1}, "", "of the packets that come twice");
    v.field("late_share", late_share, {0, 1}, "", "of the packets that are overtaken by others");
    v.field("mtu", mtu, {576, 65535}, "byte", "larger datagrams travel in fragments");
  }
};

struct ImuConfig {
  double rate_hz = 100;
  double acceleration_noise = 0.02;
  double rotation_noise = 0.002;
  double acceleration_bias = 0.05;
  double rotation_bias = 0.004;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("rate_hz", rate_hz, {10, 1000}, "Hz", "samples: an OS1 sends 100 a second");
    v.field("acceleration_noise", acceleration_noise, {0, 5}, "m/s²", "sd of a sample");
    v.field("rotation_noise", rotation_noise, {0, 1}, "rad/s", "sd of a sample");
    v.field("acceleration_bias", acceleration_bias, {0, 5}, "m/s²", "sd of the constant error");
    v.field("rotation_bias", rotation_bias, {0, 1}, "rad/s", "sd of the constant error");
  }
};

}  // namespace saker::simulation
