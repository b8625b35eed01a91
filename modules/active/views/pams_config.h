#pragma once

#include "saker/active/belief/faces.h"
#include "saker/active/views/region_samples.h"
#include "saker/core/config.h"
#include "saker/objects/class_table.h"

namespace saker::active {

/// How a target is looked for, as policy `visit` does.
struct SearchConfig {
  int sides = 2;
  bool between = false;
  double dwell_s = 3.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("sides", sides, {1, 4}, "", "from which it is looked for: behind what hides it, too");
    v.field("between", between, "", "as active.visit.between");
    v.field("dwell_s", dwell_s, {0, 60}, "s", "as active.visit.dwell_s");
  }
};

/// When a viewpoint counts as one that was looked from.
struct LookedFromConfig {
  bool from_start = false;
  double near_m = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("from_start", from_start, "",
            "whether the vehicle is taken to be where what is decided now begins to be flown: what "
            "is committed is as good as flown, so that it need not stop at a viewpoint");
    v.field("near_m", near_m, {0, 10}, "m",
            "around where a target was in view for a dwell, nothing new is told of it, whatever "
            "the cell: an estimate that trembles moves the cells' borders");
  }
};

/// One method, PAMS, with two sets of defaults: `paper` as the paper has it, `saker` beyond it.
struct PamsConfig {
  Sampling sampling = Sampling::centroids;
  bool beyond_region = false;
  int horizon = 3;
  double most_paths = 25000;
  int beam = 60;
  double dwell_s = 1.5;
  LookedFromConfig looked_from;
  double prior_place_m = 0.5;
  bool prior_of_class = false;
  double prior_length_m = 0.5;
  double prior_width_m = 0.5;
  FacesConfig faces;
  bool common_counts = false;
  bool map_counts = false;
  double enough_entropy = -10;
  double most_size_sd_m = 10;
  double reopen_share = 1.3;
  double least_probability = 0.8;
  double least_gain = 0.05;
  double price_per_s = 0;
  double discovered_price_per_s = 0;
  int at_once = 1;
  bool replan = false;
  double switch_gain = 0.3;
  double drift_m = 0.01;
  bool drift_counts = false;
  double most_drift_m = 0.3;
  int most_views = 12;
  SearchConfig search;
  double way_step_m = 1;
  double window_s = 0.5;

  [[nodiscard]] static PamsConfig paper() { return {}; }

  [[nodiscard]] static PamsConfig saker() {
    PamsConfig config;
    config.beyond_region = true;
    config.dwell_s = 0.9;
    config.looked_from.from_start = true;
    config.looked_from.near_m = 0.5;  // beyond what an estimate trembles by, well within a cell
    config.prior_of_class = true;
    const objects::ObjectClass vehicle;
    config.prior_length_m = vehicle.length_sd_m;
    config.prior_width_m = vehicle.width_sd_m;
    config.faces.hidden_end_m = 0.08;  // lengths with one were off by 0.06 m, widths by 0.04 m
    config.faces.hidden_side_m = 0.08;
    config.enough_entropy = -11.5;
    config.most_size_sd_m = 0.05;  // errors go with what the map states
    config.common_counts = true;
    config.map_counts = true;
    config.price_per_s = 0.2;
    config.discovered_price_per_s = 1;
    config.at_once = 4;
    config.replan = true;
    config.drift_counts = true;
    config.search.between = true;
    config.search.dwell_s = 0.9;  // one decision: SLAM has the object, or is about to
    return config;
  }

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("sampling", sampling, "",
            "of the region of good views: all of the lattice in it, or each part's centroid");
    v.field("beyond_region", beyond_region, "",
            "whether all of the lattice is weighed where no sample of the region is worth flying "
            "to and the size is not known to most_size_sd_m");
    v.field("horizon", horizon, {1, 5}, "", "viewpoints in a path, the paper's T");
    v.field("most_paths", most_paths, {1, 1e6}, "",
            "ordered paths up to which all are weighed: 30 samples, 3 at a time; then a beam");
    v.field("beam", beam, {1, 1000}, "", "partial paths that the beam search keeps");
    v.field("dwell_s", dwell_s, {0, 60}, "s",
            "in view from a cell of the model until it counts; below a second one decision does");
    v.group("looked_from", looked_from, "when a viewpoint counts as one that was looked from");
    v.field("prior_place_m", prior_place_m, {0.01, 10}, "m",
            "sd of x and y before the first view: half a car's width");
    v.field(
        "prior_of_class", prior_of_class, "",
        "whether those of length and width are the class's (objects.classes), not the next two");
    v.field("prior_length_m", prior_length_m, {0.01, 10}, "m", "sd of the length before it");
    v.field("prior_width_m", prior_width_m, {0.01, 10}, "m", "the same of the width");
    v.group("faces", faces, "what a view tells of each face of a box");
    v.field("common_counts", common_counts, "",
            "whether the error that all views share, never flown off, is part of the entropy");
    v.field("map_counts", map_counts, "",
            "whether a target is known no better than the map has it: where one view contradicts "
            "others, it is looked at further");
    v.field("enough_entropy", enough_entropy, {-40, 10}, "nat",
            "½ ln det of the covariance in m² at which a target is known well enough");
    v.field("most_size_sd_m", most_size_sd_m, {0.01, 10}, "m",
            "sd of length and of width in the map, above which it is not, either: an end that "
            "nobody saw hides in a determinant");
    v.field("reopen_share", reopen_share, {1, 100}, "",
            "of most_size_sd_m, above which a closed target is opened again: estimates tremble");
    v.field("least_probability", least_probability, {0, 1}, "",
            "of the class of the mapped object until then");
    v.field("least_gain", least_gain, {0, 10}, "nat", "that a path must bring to be flown");
    v.field("price_per_s", price_per_s, {0, 10}, "nat/s",
            "what a second of flight must bring beside it: the more, the shorter the mission");
    v.field("discovered_price_per_s", discovered_price_per_s, {0, 10}, "nat/s",
            "the same for one that the prior map, if any, lacks: at 0.3 they took 37 of 98 s");
    v.field("at_once", at_once, {1, 8}, "",
            "targets that a viewpoint is weighed for: the tour's current one and its neighbours");
    v.field("replan", replan, "", "whether a better viewpoint replaces the one that is flown to");
    v.field("switch_gain", switch_gain, {0, 10}, "nat", "by which it must be better");
    v.field("drift_m", drift_m, {0, 1}, "m",
            "sd of the pose after 1 m of flight; it grows with the root of the way");
    v.field("drift_counts", drift_counts, "", "whether it is part of what a view is worth");
    v.field("most_drift_m", most_drift_m, {0.01, 10}, "m",
            "sd of the pose since a target was first seen, beyond which it is looked at no more");
    v.field("most_views", most_views, {1, 100}, "", "viewpoints flown to a target");
    v.group("search", search,
            "a target that is not in the map, or of which nobody has seen how long it is");
    v.field("window_s", window_s, {0, 60}, "s",
            "the same for what is predicted: SLAM counts a cell from its first window on");
    v.field("way_step_m", way_step_m, {0.1, 10}, "m",
            "at which it is asked what comes into view on the way: a third of the narrowest cell");
  }
};

}  // namespace saker::active
