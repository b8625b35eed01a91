#pragma once

#include "saker/multirobot/constellation.h"

namespace saker::multirobot {

struct MergeConfig {
  int track_every = 5;
  int track_keyframes = 30;
  int track_iterations = 3;
  int iterations = 10;
  double trust_radius = 1e8;
  double first_scale = 8;
  double disagreement = 0.15;
  int loop_every = 40;
  int loop_keyframes = 120;
  double loop_shift_m = 6;
  double loop_turn_deg = 15;
  ConstellationConfig constellation;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("track_every", track_every, {1, 1000}, "",
            "new keyframes after which the newest are fitted to the map: drift over so few stays "
            "far within the association's gates");
    v.field("track_keyframes", track_keyframes, {2, 1000}, "",
            "newest keyframes that are fitted; older ones are held");
    v.field("track_iterations", track_iterations, {1, 100}, "", "most steps of such a fit");
    v.field("iterations", iterations, {1, 1000}, "",
            "most steps of each solve of the whole graph: once a history is in, and where it "
            "closes a loop");
    v.field("trust_radius", trust_radius, {1, 1e12}, "",
            "in place of slam.graph.trust_radius in such solves: drift bends a flight as a whole, "
            "which three steps undo, and ten do not where 10000 holds them back");
    v.field("first_scale", first_scale, {1, 1000}, "",
            "of the robust kernel, times slam.graph.robust_scale, at the first such solve; halved "
            "until it is 1");
    v.field("disagreement", disagreement, {0, 1}, "",
            "robust weight below which one flight's measurements of an object speak of another "
            "object");
    v.field("loop_every", loop_every, {1, 10000}, "", "new keyframes between searches for loops");
    v.field("loop_keyframes", loop_keyframes, {10, 10000}, "",
            "newest keyframes whose new objects may be old ones that drift has moved");
    v.field("loop_shift_m", loop_shift_m, {0.1, 1000}, "m", "by which drift may have moved them");
    v.field("loop_turn_deg", loop_turn_deg, {0.1, 180}, "degree", "and turned");
    v.group("constellation", constellation, "objects matched between maps of unknown poses");
  }
};

}  // namespace saker::multirobot
