#pragma once

#include <istream>
#include <limits>
#include <string>
#include <vector>

#include "saker/objects/object_map.h"
#include "saker/objects/smap_details.h"
#include "saker/objects/smap_head.h"

/// Large maps in few bytes, read by region: `.smap` version 2.
///
///     head   steps, frame, classes, and every tile's place and length: the spatial index
///     tiles  squares of the ground along a Morton curve, each with up to three parts:
///            geometry (smap_geometry.h), ground planes and details (smap_details.h)
///     head   once more, and its length
///
/// Heads are framed as `framed` says; a part begins with the CRC-32 of its bytes. What is damaged
/// loses its tile, or the details of one, and nothing else. The head says the steps of the
/// geometry, so that a later writer may choose others.
namespace saker::objects {

enum class SmapContent {
  everything,  ///< all that the map's JSON says, and as exact
  geometry,    ///< class, place, size, heading and probability in steps; ground planes
};

/// Throws Error on what no file can hold.
[[nodiscard]] std::string pack_smap(const ObjectMap& map, const ClassTable& table,
                                    SmapContent content = SmapContent::everything,
                                    const SmapSteps& steps = {});

/// A part of the ground, in x and y of the map's frame; what lies on its rim is inside.
using Region = Eigen::AlignedBox2d;
inline const Region kEverywhere{Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity()),
                                Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity())};

/// Objects with their place, and ground planes with their point, in `region`.
[[nodiscard]] ObjectMap clipped(ObjectMap map, const Region& region);

struct MapRead {
  ObjectMap map;
  std::vector<std::string> damage;  ///< a line for each part that could not be read
  std::size_t tiles_decoded = 0;
};

/// An open `.smap`: of a read, only the head and the tiles that meet the region are touched.
class SmapReader {
 public:
  /// `in` must outlive the reader. Throws Error("NAME: …") where neither head can be read.
  SmapReader(std::istream& in, std::string name);

  [[nodiscard]] const SmapHead& head() const { return head_; }
  [[nodiscard]] std::size_t bytes() const { return size_; }        ///< of the whole file
  [[nodiscard]] std::size_t head_bytes() const { return begin_; }  ///< of one of both heads

  /// Objects without an identity in the file are numbered in its order, from 0. Throws Error where
  /// a class is not in the table.
  [[nodiscard]] MapRead read(const ClassTable& table, const Region& region = kEverywhere);

 private:
  struct Collected;

  void read_heads();
  [[nodiscard]] std::string bytes_at(std::size_t at, std::size_t count);
  [[nodiscard]] std::string content_at(std::size_t at, std::size_t count);  ///< of a head's frame
  [[nodiscard]] std::string part_at(std::size_t at, std::int64_t count);
  [[nodiscard]] std::vector<Listed<MapObject>> objects_at(const SmapTile& tile, std::size_t at,
                                                          std::int64_t objects_before,
                                                          const Collected& all);
  [[nodiscard]] std::size_t expected_objects(const Region& region) const;
  void read_tile(const SmapTile& tile, std::size_t begin, std::int64_t objects_before,
                 Collected& all);
  template <class Read>
  bool guarded(const SmapTile& tile, const std::string& loss, Collected& all, Read read);

  std::istream& in_;
  std::string name_;
  std::size_t size_ = 0, begin_ = 0;
  SmapHead head_;
  std::vector<std::string> damage_;  ///< of the heads
};

}  // namespace saker::objects
