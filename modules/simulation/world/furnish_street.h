#pragma once

#include "saker/simulation/world/populate.h"
#include "saker/simulation/world/street_plants.h"

namespace saker::simulation {

/// How much of what a training street holds: factors about 1, some of them zero.
struct StreetTheme {
  double stand_ins = 0.1;  ///< of the parking places: taken by hedges, containers, stalls
  double plants = 1;
  double furniture = 1;
  double poles = 1;
  double fences = 1;
  double works = 0;  ///< building sites
  double wet = 0;    ///< puddles and wet lanes
  bool tram = false;
  bool winter = false;  ///< heaps of snow
  bool marked = true;   ///< crosswalks and lines
};

[[nodiscard]] StreetTheme random_theme(core::Rng& rng);

/// Where training's streets are furnished: the site and what its extra things are made of.
struct StreetSite {
  Site& site;
  const StreetPalette& palette;
  const StreetFlora& flora;
  StreetTheme theme;
  core::Rng& rng;

  [[nodiscard]] Nursery nursery() const {
    return {site.world, palette, site.flora, flora, theme.winter ? 0.95 : 0.25};
  }
};

/// Takes places where vehicles could stand, builds houses and borders: before populate().
void reserve_street(StreetSite& street);

/// Fills the room that populate() left: plants, furniture, poles.
void furnish_street(StreetSite& street);

/// Draws what lies on the roads: bumps, tracks, puddles, islands, heaps, works.
void paint_street(StreetSite& street);

// Parts, each for one side.
void build_houses(StreetSite& street, const Lot& lot);
void build_industry(StreetSite& street, const Lot& lot);
void build_border(StreetSite& street, const Lot& lot, double share);
void furnish_walk(StreetSite& street, const Lot& lot);
void furnish_square(StreetSite& street, const Lot& lot);
void furnish_green(StreetSite& street, const Lot& lot);

/// A place in the lot: across at `share` of its width, x along the street, y outwards.
[[nodiscard]] SE3 facing_outwards(const StreetSite& street, const Lot& lot, double s, double share);

/// How many of `per_100_m` on the lot, scaled.
[[nodiscard]] int count_of(StreetSite& street, const Lot& lot, double per_100_m, double factor);

}  // namespace saker::simulation
