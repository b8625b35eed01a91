#pragma once

#include <vector>

#include "saker/simulation/world/fleet.h"
#include "saker/simulation/world/layout.h"
#include "saker/simulation/world/plants.h"
#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {

/// How full a world is; drawn anew for every world.
struct Population {
  double parked = 0.7;        ///< share of the parking places that are taken
  double traffic = 0.15;      ///< vehicles a 12 m of lane
  double lamp_spacing = 25;   ///< m
  double tree_spacing = 9;    ///< m, in rows
  bool street_trees = false;  ///< trees on the sidewalks
  double greenery = 1;        ///< factor on bushes and scattered trees
  double clutter = 1;         ///< factor on bins, people, bicycles, signs
  double heavy = 0.05;        ///< share of trucks, buses and trailers
  bool every_kind = false;    ///< the five kinds of cars in equal numbers, in a shuffled order
  FleetTheme fleet = FleetTheme::none;  ///< of training worlds: every kind of fleet.h, by theme
};

[[nodiscard]] Population random_population(core::Rng& rng);

/// Where the builders of a world build.
struct SiteParts {
  World& world;
  const Palette& palette;
  const Flora& flora;
  const Terrain& terrain;
  Population population;
  core::Rng& rng;
};

/// The same with what is taken.
class Site : public SiteParts {
 public:
  explicit Site(const SiteParts& parts) : SiteParts(parts) {}

  /// Takes the disc if it is free and out of the crossing.
  bool claim(double s, double d, double radius);
  /// Takes a rectangle, half_length along the direction `yaw` in street coordinates.
  bool claim(double s, double d, double yaw, double half_length, double half_width);

  [[nodiscard]] VehicleKind next_kind();

 private:
  struct Disc {
    double s, d, radius;
  };
  [[nodiscard]] bool free(double s, double d, double radius) const;

  std::vector<Disc> taken_;
  std::vector<VehicleKind> deck_;
};

/// One strip of one side: `d` is its middle line's inner edge, `side` +1 to the left.
struct Lot {
  const Strip* strip;
  double d;
  double side;
  double from = -90, to = 90;  ///< along the street

  [[nodiscard]] double at(double share) const { return side * (d + share * strip->width); }
};

/// Puts onto every strip what belongs there.
void populate(Site& site);

// The builders, by what the strip is used for.
void build_parallel_parking(Site& site, const Lot& lot);
void build_perpendicular_parking(Site& site, const Lot& lot);
void build_lane(Site& site, const Lot& lot);
void build_sidewalk(Site& site, const Lot& lot);
void build_verge(Site& site, const Lot& lot);
void build_island(Site& site, const Lot& lot);
void build_garden(Site& site, const Lot& lot);
void build_lawn(Site& site, const Lot& lot);
void build_tree_row(Site& site, const Lot& lot);
void build_forest(Site& site, const Lot& lot);
void build_buildings(Site& site, const Lot& lot);
void build_thicket(Site& site, const Lot& lot);
void build_barrier(Site& site, const Lot& lot);

}  // namespace saker::simulation
