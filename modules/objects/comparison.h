#pragma once

#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

/// A map against the truth: one-to-one within a class, nearest in x-y (Hungarian). Error = mapped −
/// true; means are signed.
namespace saker::objects {

struct ComparisonOptions {
  double cuboid_gate_m = 1.5;  ///< in x-y, for a pair
  /// The same of cylinders: as near as SLAM takes two for one (`cylinder_gate_m` of association).
  double cylinder_gate_m = 0.8;
  int least_points =
      0;  ///< truth that says it was hit by fewer returns does not count, mapped or not
};

/// One measured quantity over the found objects.
struct ErrorFigures {
  std::string quantity;                                        ///< with its unit: "length_m"
  double mean = 0, standard_deviation = 0, mean_absolute = 0;  ///< NaN of too few
};

/// Ids of a mapped object and of the true one that it is.
struct FoundPair {
  int mapped = -1, truth = -1;
};

struct ClassComparison {
  std::string name;
  Shape shape = Shape::none;
  int truth = 0;  ///< that counts
  int mapped = 0;
  int found = 0;        ///< pairs
  int missed = 0;       ///< true, without a mapped one
  int invented = 0;     ///< mapped, neither found nor duplicate
  int duplicates = 0;   ///< mapped; the nearest true one of any class is, within the gate, one of
                        ///< this class that another is paired with
  int front_right = 0;  ///< found cuboids whose front is in front
  std::vector<ErrorFigures> errors;
  std::vector<FoundPair> pairs;  ///< that were found, in the order of the mapped ids

  // Cuboids: whether size is measured or merely guessed. NaN below two different lengths.
  double length_slope = 0;  ///< of mapped on true length: 1 measured, 0 guessed
  double size_mae_m = 0;    ///< of length and width together
  double constant_size_mae_m =
      0;  ///< the same, had every object been given the true ones' mean size
};

/// One entry for each class of cuboids or cylinders.
[[nodiscard]] std::vector<ClassComparison> compare(const ObjectMap& mapped, const ObjectMap& truth,
                                                   const ClassTable& table,
                                                   const ComparisonOptions& options);

}  // namespace saker::objects
