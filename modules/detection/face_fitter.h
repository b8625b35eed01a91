#pragma once

#include "saker/core/config.h"
#include "saker/detection/size_prior.h"
#include "saker/detection/vehicle_fitter.h"

/// A vehicle's faces by one likelihood.
///
/// Unknown are the heading ψ, the places e_f of the four faces along their outward normals, and the
/// kind k (size_prior.h). Given ψ and k the posterior is
///
///   p(e, k | ψ) ∝ Π_f [ H_f(e_f) · B_f(e_f) ] · N(length; k) · N(width; k) · p(top | k) · p(k).
///
/// Hits, H_f. The outermost layer of each strip across the face, u_j at y_j from the vehicle's
/// middle line, lies on a face that bows in towards its corners as a superellipse of the fourth
/// order:
///   u_j = e_f − b (y_j / h)⁴ − d_j + n_j,
/// with the half width h, the bow's depth b, anything from 0 to `bow` alike and one for all strips,
/// d_j ~ Exp(roundness) for what stands back, and n_j ~ N(0, noise²) of range and calibration. A
/// share `stray` of strips (mirrors, leaves) may be anywhere. All of this only where the face was
/// seen: with probability q_f = looked · (1 − hidden) · (own / (own + others)), others being points
/// of no object about that face (occluders). Else hits are a bound: with `corner`, where a face
/// beside it was looked at, they end at its corner, e_f − max u ~ Exp(0.6 bow), otherwise e_f is
/// anywhere beyond them within `depth`.
///
/// Free-space evidence, B_f. Of all beams, which share the shape, the n-th nearest counts, at v:
/// Φ((v + slack − e_f) / free_sd). Beams beside a seen face or corner pass it, v − max(e_f, u) ~
/// Exp(passed) or Exp(0.6 bow), but for `unpassed`; beside what hides it v is anywhere within 3 m.
///
/// Heading. The strips of each face that was looked at lie on one line, N(0, side), or, leaves and
/// mirrors, anywhere. Both ψ and ψ + 90° are tried, the posterior's evidence decides.
///
/// Each density is kept on a grid, blurred by what one vehicle's shape shares over all windows
/// (shape_sd). Means use the sizes' prior; covariances are second moments about them with a
/// hundredth of it: the windows of a vehicle all say the same prior.
namespace saker::detection {

struct FaceConfig {
  double strip_m = 0.2;
  double layer_m = 0.06;
  double noise_m = 0.025;
  double noise_per_m = 0.0007;
  double roundness_m = 0.01;
  double bow_end_m = 0.4;
  double bow_side_m = 0.2;
  double stray = 0.1;
  double hidden = 0.15;
  double outside_m = 0.5;
  double depth_end_m = 5;
  double depth_side_m = 2;
  double free_lowest_m = 0.25;
  double free_highest_m = 0.65;
  double free_slack_m = 0.08;
  double free_end_sd_m = 0.1;
  double free_side_sd_m = 0.05;
  int free_beams = 3;
  double passed_m = 0.06;
  double unpassed = 0.05;
  double corner = 0.5;
  double shape_sd_m = 0.04;
  double side_m = 0.05;
  double top_sd_m = 0.06;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("strip_m", strip_m, {0.05, 2}, "m", "strips across a face: wider than beams are apart");
    v.field("layer_m", layer_m, {0.01, 1}, "m",
            "depth of a strip's outermost layer, whose mean counts: some sds of a range");
    v.field("noise_m", noise_m, {0.001, 1}, "m",
            "standard deviation of a layer's place: range, calibration and odometry in a window");
    v.field("noise_per_m", noise_per_m, {0, 0.1}, "m/m",
            "more of it by range: half a beam's width");
    v.field("roundness_m", roundness_m, {0.005, 1}, "m",
            "mean by which body panels stand back from the outermost line: sills, arches, lamps");
    v.field("bow_end_m", bow_end_m, {0, 2}, "m",
            "by which bumpers and grilles stand back at their corners at most");
    v.field("bow_side_m", bow_side_m, {0, 2}, "m", "by which sides taper to the ends at most");
    v.field("stray", stray, {0.001, 0.9}, "", "share of strips that are no panel: mirrors, leaves");
    v.field("hidden", hidden, {0.001, 0.9}, "",
            "probability that a face that was looked at is hidden by something");
    v.field("outside_m", outside_m, {0.01, 20}, "m",
            "that a sensor is outside of a face's plane: it looks at the face");
    v.field("depth_end_m", depth_end_m, {0.1, 20}, "m",
            "within which a hidden end lies beyond the hits: a van behind its rear");
    v.field("depth_side_m", depth_side_m, {0.1, 10}, "m", "the same of a hidden side");
    v.field("free_lowest_m", free_lowest_m, {0, 2}, "m", "above the ground: clearance, kerbs");
    v.field("free_highest_m", free_highest_m, {0.1, 3}, "m", "above the ground: low bonnets");
    v.field("free_slack_m", free_slack_m, {0, 1}, "m",
            "by which panels stand back between these heights where beams still pass");
    v.field("free_end_sd_m", free_end_sd_m, {0.005, 1}, "m", "its standard deviation at ends");
    v.field("free_side_sd_m", free_side_sd_m, {0.005, 1}, "m", "the same at sides");
    v.field("free_beams", free_beams, {1, 1000}, "",
            "beams that make sure; of those kept (window.beam_stride)");
    v.field("passed_m", passed_m, {0.005, 1}, "m",
            "by which beams pass a seen face: their distance from each other");
    v.field("unpassed", unpassed, {0.001, 1}, "", "share of seen faces that they do not pass so");
    v.field(
        "corner", corner, {0.001, 0.999}, "",
        "probability that a face that was looked at was followed to the corner of an unseen one");
    v.field("shape_sd_m", shape_sd_m, {0.001, 1}, "m",
            "standard deviation of a face against a box's, the same in all windows");
    v.field("side_m", side_m, {0.01, 1}, "m",
            "standard deviation of strips about their face, for the heading");
    v.field("top_sd_m", top_sd_m, {0.001, 1}, "m", "standard deviation of the top's height");
  }
};

/// Cost: points × headings for the heading, beams towards the vehicle × 8 for its faces.
class FaceFitter final : public VehicleFitter {
 public:
  /// \param highest_m  above the ground, above which points are not kept
  FaceFitter(const FaceConfig& config, double highest_m, VehicleKinds kinds)
      : config_(config), highest_m_(highest_m), kinds_(std::move(kinds)) {}
  [[nodiscard]] Plan outline(const VehicleView& view) const override;
  [[nodiscard]] Plan fit(const VehicleView& view, const Plan& outline) const override;

 private:
  FaceConfig config_;
  double highest_m_;
  VehicleKinds kinds_;
};

}  // namespace saker::detection
