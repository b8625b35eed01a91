#pragma once

#include <utility>
#include <vector>

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

/// The materials of one vehicle, all with the label of its kind.
struct Parts {
  std::uint16_t label = 0;
  MaterialId paint = 0;   ///< of the cab or the body
  MaterialId second = 0;  ///< of what it carries: box, tarpaulin, drum
  MaterialId glass = 0, interior = 0, rubber = 0, rim = 0, plate = 0, dark = 0, chrome = 0;
};

/// Paint from black (a third of the fleet is dark) to white; it mirrors, so that it is lost at
/// grazing angles. `dullest`: the least gloss.
[[nodiscard]] Material any_paint(std::uint16_t label, double dullest, core::Rng& rng);

/// Parts of a random vehicle: paint from black to white, glass from clear to tinted.
[[nodiscard]] Parts make_parts(World& world, const Palette& palette, std::uint16_t label,
                               core::Rng& rng);

/// The palette with what belongs to vehicles taken from `parts`.
[[nodiscard]] Palette with_parts(const Palette& palette, const Parts& parts);

/// A convex outline in x and z, drawn out from y = `low` to `high`.
void draw_prism(const Pen& pen, const std::vector<Eigen::Vector2d>& outline, double low,
                double high, MaterialId material);

/// From one point to the other, square.
void draw_bar(const Pen& pen, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              double thickness, MaterialId material);

struct AxleShape {
  double x = 0;           ///< of its middle
  double half_width = 1;  ///< to the tyres' outer faces
  double radius = 0.5;
  double tyre = 0.3;  ///< width
  bool twin = false;  ///< two tyres a side
};
/// Wheels with rims, and the beam between them.
void draw_axle(const Pen& pen, const AxleShape& axle, const Parts& parts);

/// Heights of a wall with windows.
struct WallHeights {
  double low, sill, lintel, top;
};
using Panes = std::vector<std::pair<double, double>>;  ///< from and to, m

/// A wall along x at `y`, with glass from sill to lintel between each pane's x.
void draw_glazed_side(const Pen& pen, double from, double to, double y, const WallHeights& heights,
                      const Panes& panes, const Parts& parts);

/// A wall across at the x of each height (low, sill, lintel, top), with one pane.
void draw_glazed_end(const Pen& pen, const std::array<double, 4>& x, double half_width,
                     const WallHeights& heights, const Parts& parts);

/// Two rails with cross-members, their upper edge at `top`.
void draw_ladder_frame(const Pen& pen, double rear, double front, double top, const Parts& parts);

/// The bars that keep bicycles from under a truck, at both sides and the rear.
void draw_guards(const Pen& pen, double rear, double from, double to, double half_width,
                 const Parts& parts);

/// A pair on arms, in front of the side windows.
void draw_mirrors(const Pen& pen, double x, double half_width, double low, double high,
                  const Parts& parts);

/// A seat with its back, facing x, its middle at the pen's origin on the floor.
void draw_seat(const Pen& pen, double width, double back_height, MaterialId material);

}  // namespace saker::simulation
