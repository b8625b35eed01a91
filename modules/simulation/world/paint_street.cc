#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/facades.h"
#include "saker/simulation/world/fences.h"
#include "saker/simulation/world/furnish_street.h"
#include "saker/simulation/world/ground_details.h"
#include "saker/simulation/world/street_furniture.h"
#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

bool is_median(Use use) { return use == Use::island || use == Use::barrier || use == Use::border; }

/// From the middle line to the far side of the last lane, medians included.
double road_width(const std::vector<Strip>& strips) {
  double width = 0;
  double road = 0;
  for (const Strip& strip : strips) {
    if (strip.use != Use::lane && strip.use != Use::none && !is_median(strip.use)) break;
    width += strip.width;
    if (strip.use == Use::lane) road = width;
  }
  return road;
}

/// Paints and builds on the road between `right` < 0 and `left`.
class RoadPainter {
 public:
  explicit RoadPainter(StreetSite& street)
      : street_(street),
        ground_(street.site.world, street.palette, street.site.terrain),
        rng_(street.rng),
        left_(road_width(street.site.terrain.section().left)),
        right_(-road_width(street.site.terrain.section().right)),
        divided_(is_median(street.site.terrain.section().left.front().use) ||
                 is_median(street.site.terrain.section().right.front().use)) {}

  void paint() {
    if (left_ - right_ < 3) return;
    mark();
    patch_up();
    wet();
    bumps();
    islands();
    cross_traffic();
    if (street_.theme.tram) tram();
    if (rng_.chance(street_.theme.works)) works();
    if (rng_.chance(0.06)) bridge();
    if (left_ - right_ > 10 && rng_.chance(0.15)) gantry();
  }

 private:
  [[nodiscard]] double any_s(double reach = 75) { return rng_.uniform(-reach, reach); }
  [[nodiscard]] double any_d() { return rng_.uniform(right_ + 0.7, left_ - 0.7); }
  [[nodiscard]] bool crossing(double s, double margin) const {
    return street_.site.terrain.in_crossing(s, margin);
  }

  void mark() {
    if (!street_.theme.marked) return;
    const TerrainShape& shape = street_.site.terrain.shape();
    if (shape.crossing < 1e8) {
      for (const double end : {-1.0, 1.0})
        ground_.crosswalk(shape.crossing + end * (shape.crossing_half_width + 2.5), right_, left_);
    }
    if (rng_.chance(0.5)) ground_.crosswalk(any_s(), right_, left_);
    if (!divided_ && rng_.chance(0.6)) ground_.line(0, -90, 90, 3, rng_.uniform(3, 7), 0.12);
  }

  void patch_up() {
    const int patches = rng_.index(14);
    for (int i = 0; i < patches; ++i) {
      const MaterialId other =
          any_tint(street_.site.world, street_.palette.asphalt, 0.1, 0.45, rng_);
      ground_.patch(any_s(), any_d(), rng_.uniform(0.3, 12), rng_.uniform(0.2, 0.6), other, 0.008);
    }
    const int shafts = rng_.index(12);
    for (int i = 0; i < shafts; ++i)
      ground_.blot(any_s(), any_d(), rng_.uniform(0.25, 0.4), 0, street_.palette.steel, rng_);
    if (rng_.chance(0.08))
      ground_.patch(0, 0.5 * (left_ + right_), 90, 0.5 * (left_ - right_), street_.palette.cobble,
                    0.01);
  }

  void wet() {
    const double wet = street_.theme.wet;
    if (rng_.chance(0.4 * wet))
      ground_.patch(any_s(40), 0.5 * (left_ + right_), rng_.uniform(10, 90), 0.5 * (left_ - right_),
                    street_.palette.wet, 0.009);
    const int puddles = static_cast<int>(rng_.uniform(0, 25) * wet);
    for (int i = 0; i < puddles; ++i)
      ground_.blot(any_s(), any_d(), rng_.uniform(0.3, 2), 0.5, street_.palette.water, rng_);
  }

  void bumps() {
    if (divided_ || !rng_.chance(0.25)) return;
    const int count = 1 + rng_.index(4);
    for (int i = 0; i < count; ++i)
      ground_.speed_bump(any_s(), right_, left_, rng_.uniform(0.4, 3.5), rng_.uniform(0.04, 0.12));
  }

  /// Refuges with a sign or bollards between the lanes.
  void islands() {
    if (divided_ || left_ - right_ < 7 || !rng_.chance(0.4)) return;
    const int count = 1 + rng_.index(3);
    for (int i = 0; i < count; ++i) {
      const double half_s = rng_.uniform(1.5, 8);
      const double half_d = rng_.uniform(0.4, 1.1);
      const double s = any_s();
      if (crossing(s, half_s + 1) || !street_.site.claim(s, 0, 0, half_s, half_d)) continue;
      const MaterialId top = rng_.chance(0.5) ? street_.palette.paving : street_.palette.grass;
      ground_.island(s, 0, half_s, half_d, rng_.uniform(0.08, 0.18), top);
      const SE3 T = street_.site.terrain.upright(s, 0) * placed(rng_.uniform(-1, 1), 0, 0.05);
      (rng_.chance(0.4) ? add_bollard_row : any_pole(rng_))(street_.site.world, street_.palette, T,
                                                            rng_);
    }
  }

  /// Queues on the crossing street, in the lane of their direction, not on the road itself.
  void cross_traffic() {
    const TerrainShape& shape = street_.site.terrain.shape();
    if (shape.crossing > 1e8 || !rng_.chance(0.6)) return;
    const double share = rng_.uniform(0.1, 0.8);
    for (const double side : {-1.0, 1.0}) {
      for (const double lane : {-1.0, 1.0}) {
        const double s = shape.crossing + lane * 0.5 * shape.crossing_half_width;
        double out = (side > 0 ? left_ : -right_) + rng_.uniform(1, 4);
        while (out < 45) {
          const VehicleShape vehicle = random_shape(street_.site.next_kind(), rng_);
          const double middle = side * (out + vehicle.length / 2);
          const double yaw = lane * std::numbers::pi / 2 + rng_.normal(0, 0.02);
          if (rng_.chance(share))
            add_vehicle(street_.site.world, street_.palette, vehicle,
                        street_.site.terrain.on_ground(s, middle, yaw), true, rng_);
          out += vehicle.length + rng_.uniform(0.8, 6);
        }
      }
    }
  }

  void tram() {
    const double spread = left_ - right_ > 8 ? 1.6 : 0;
    for (const double side : {-1.0, 1.0}) {
      ground_.tram_track(side * spread, -90, 90, 1.435);
      if (spread == 0) break;
    }
    for (double s = -80; s < 80; s += 28) {
      for (const double d : {left_ + 0.5, right_ - 0.5}) {
        if (!street_.site.claim(s, d, 0.3)) continue;
        add_catenary_pole(street_.site.world, street_.palette,
                          street_.site.terrain.upright(s, d, d > 0 ? 0 : std::numbers::pi), rng_);
      }
    }
  }

  /// A lane that is closed: barriers or fences about a heap, materials and cones.
  void works() {
    World& world = street_.site.world;
    const Terrain& terrain = street_.site.terrain;
    const double half = rng_.uniform(4, 12);
    const double s = any_s(50);
    const double side = rng_.chance(0.5) ? 1 : -1;
    const double edge = side > 0 ? left_ : right_;
    const double d = edge - side * 1.5;
    if (!street_.site.claim(s, d, 0, half, 1.5)) return;
    constexpr Boundary kKinds[] = {Boundary::jersey, Boundary::site_fence, Boundary::hoarding,
                                   Boundary::site_fence};
    const Boundary kind = kKinds[rng_.index(4)];
    for (const double across : {-1.3, 1.3}) {
      for (double x = s - half; x + 2.5 <= s + half; x += 2.5)
        add_boundary(world, street_.palette, kind, terrain.on_ground(x, d + across), 2.5, 1);
    }
    for (double x = s - half + 2; x < s + half - 2; x += rng_.uniform(2, 6)) {
      const SE3 T = terrain.upright(x, d, rng_.uniform(-3, 3));
      (rng_.chance(0.5) ? any_small_thing(rng_) : any_middling_thing(rng_))
          .add(world, street_.palette, T, rng_);
    }
    for (double x = s - half - 12; x < s - half; x += 2)
      add_bollard_row(world, street_.palette, terrain.upright(x, d + 1.3), rng_);
  }

  void bridge() {
    const double s = any_s(60);
    if (crossing(s, 9)) return;
    const double span = std::max(left_, -right_) * 2 + rng_.uniform(4, 10);
    add_bridge(street_.site.world, street_.palette, span, street_.site.terrain.upright(s, 0), rng_);
  }

  void gantry() {
    const double width = left_ - right_ + 1.5;
    add_gantry(street_.site.world, street_.palette,
               street_.site.terrain.upright(any_s(60), right_ - 0.75), width, rng_);
  }

  StreetSite& street_;
  GroundPainter ground_;
  core::Rng& rng_;
  double left_, right_;
  bool divided_;  ///< by a median
};

/// Drives, paths and steps from the walk to the houses; heaps beside the road.
void paint_side(StreetSite& street, const std::vector<Strip>& strips, double side) {
  core::Rng& rng = street.rng;
  World& world = street.site.world;
  const Terrain& terrain = street.site.terrain;
  GroundPainter ground(world, street.palette, terrain);
  const MaterialId drive =
      labelled(world, rng.chance(0.5) ? street.palette.parking : street.palette.gravel,
               rng.chance(0.5) ? kParking : kOtherGround);
  double d = 0;
  for (const Strip& strip : strips) {
    const bool walk = strip.use == Use::sidewalk || strip.use == Use::square;
    if (strip.use == Use::garden) {
      for (double s = -85; s < 85; s += rng.uniform(7, 20)) {
        if (terrain.in_crossing(s, 3)) continue;
        ground.path(s, side * d, side * (d + strip.width), rng.uniform(0.5, 1.7), drive);
      }
    }
    if (walk && street.theme.wet > 0) {
      const MaterialId water = labelled(world, street.palette.water, kSidewalk);
      for (int i = 0; i < static_cast<int>(12 * street.theme.wet); ++i)
        ground.blot(rng.uniform(-80, 80), side * (d + 0.5 * strip.width),
                    std::min(0.45 * strip.width, rng.uniform(0.2, 1.2)), 0.5, water, rng);
    }
    const bool edge = walk || strip.use == Use::verge;
    if (edge && street.theme.winter) {
      for (double s = -85; s < 85; s += rng.uniform(2, 9)) {
        const double r = rng.uniform(0.3, 1.1);
        if (!street.site.claim(s, side * (d + 0.4), r)) continue;
        const SE3 T = terrain.upright(s, side * (d + 0.4));
        Pen(world.mesh, T).ellipsoid({0, 0, 0}, {1.4 * r, r, 0.6 * r}, street.palette.snow);
      }
    }
    d += strip.width;
  }
}

}  // namespace

void paint_street(StreetSite& street) {
  RoadPainter(street).paint();
  const CrossSection& section = street.site.terrain.section();
  paint_side(street, section.left, 1);
  paint_side(street, section.right, -1);
}

}  // namespace saker::simulation
