#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saker/core/config.h"
#include "saker/objects/object_map.h"
#include "tools/saker/characterise/sample_matching.h"

namespace saker::tools {

/// The true size of an object of a recording.
struct Dimensions {
  std::string recording;
  int id = 0;
  std::string kind;
  double length_m = 0;
  double width_m = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("recording", recording, "", "name of the folder RUN");
    v.field("id", id, {0, 1e9}, "", "of the object in RUN/map.json");
    v.field("kind", kind, "", "of the object, for people");
    v.field("length_m", length_m, {0.05, 50}, "m", "by a tape, or from its maker");
    v.field("width_m", width_m, {0.05, 50}, "m", "without mirrors");
  }
};

/// dimensions.yaml.
struct DimensionsTable {
  std::vector<Dimensions> objects;

  template <class Visitor>
  void visit(Visitor& v) {
    v.list("objects", objects, "cuboids that were measured by hand; others are left out");
  }
};

/// Where the truth comes from. Neither: the converged map of each run alone.
struct KnownTruth {
  std::optional<objects::ObjectMap> map;      ///< in the frame of the run's map.json
  std::optional<DimensionsTable> dimensions;  ///< sizes; places come from the converged map
};

/// The samples of a run of saker replay or experiment: RUN/detections.jsonl, seen from
/// RUN/trajectory.txt. Of a map only objects that were seen often count as converged. Throws Error
/// on a file that is missing or malformed.
[[nodiscard]] std::vector<uncertainty::Sample> recorded_samples(const std::filesystem::path& run,
                                                                const KnownTruth& truth,
                                                                const objects::ClassTable& table);

}  // namespace saker::tools
