#pragma once

#include <string>
#include <vector>

#include "saker/core/config.h"

/// Settings of what is done where the prior map is wrong, incomplete or absent.
namespace saker::active {

enum class SweepWhen { never, without_prior, always };

[[nodiscard]] inline std::vector<std::string> enum_names(SweepWhen) {
  return {"never", "without_prior", "always"};
}

struct SweepConfig {
  SweepWhen when = SweepWhen::without_prior;
  double spacing_m = 16;
  double step_m = 8;
  double inset_m = 1.5;
  double cell_m = 2;
  double seen_s = 3;
  double least_seen = 0.9;
  int most_cells = 50000;
  double arrived_m = 1.5;
  double patience_s = 20;
  double standing_s = 8;
  double progress_m = 0.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("when", when, "",
              "The geofence is swept for targets never, without_prior (where none is known "
              "beforehand) or always (once those are closed).");
    v.setting("spacing_m", spacing_m, {1, 200}, "m",
              "Lines of the sweep lie so far apart; active.view.farthest_m sees each vehicle from "
              "both sides.");
    v.field("step_m", step_m, {1, 200}, "m",
            "between stops on a line; one whose surroundings were seen is left out");
    v.field("inset_m", inset_m, {0, 50}, "m", "from where a line meets the geofence to its stop");
    v.field("cell_m", cell_m, {0.25, 20}, "m", "edge of the squares that are seen or not");
    v.field("seen_s", seen_s, {0, 60}, "s",
            "in range with what stands there known, until a square is seen: five windows, after "
            "which SLAM believes in an object");
    v.field("least_seen", least_seen, {0, 1}, "",
            "share of a stop's squares that is enough: what is inside of things is never seen");
    v.field("most_cells", most_cells, {1, 1000000}, "",
            "squares in the geofence; a larger one is refused");
    v.field("arrived_m", arrived_m, {0.1, 20}, "m", "so near to a stop is there");
    v.field("patience_s", patience_s, {1, 600}, "s",
            "without coming nearer to a stop, until it is given up");
    v.field("standing_s", standing_s, {1, 600}, "s",
            "the same for a vehicle that stands, also at the stop: longer than seen_s");
    v.field("progress_m", progress_m, {0.05, 10}, "m", "that count as nearer");
  }
};

struct DiscoveryConfig {
  int most = 100;
  double settle_s = 3;
  double moved_m = 1;
  double same_m = 1.2;
  double around_m = 2.5;
  double around_step_m = 0.5;
  double least_free = 0.95;
  double absent_s = 4;
  SweepConfig sweep;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("most", most, {0, 1000}, "",
              "At most so many objects that the prior map lacks become targets.");
    v.field(
        "settle_s", settle_s, {1.5, 600}, "s",
        "for which such an object must be in the map, in its place: what drives is not by then");
    v.field("moved_m", moved_m, {0.05, 20}, "m", "by which its place may change: estimates settle");
    v.field("same_m", same_m, {0, 20}, "m",
            "nearer to a target's object it is the same mapped twice: half of a parking place");
    v.field("around_m", around_m, {0.5, 20}, "m",
            "about a target's place nothing stands: then it is not there. About half a vehicle");
    v.field("around_step_m", around_step_m, {0.1, 5}, "m",
            "between the columns that are looked at: two cells of the block");
    v.field("least_free", least_free, {0, 1}, "",
            "share of them that must be free or a mapped object's: one face of a vehicle fills a "
            "tenth");
    v.field("absent_s", absent_s, {0, 600}, "s",
            "for so long, seen from near by, until it is dismissed: SLAM believes in it by then");
    v.group("sweep", sweep, "back and forth over the geofence");
  }
};

}  // namespace saker::active
