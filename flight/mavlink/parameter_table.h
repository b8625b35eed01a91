#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flight/mavlink/config.h"
#include "saker/core/config.h"

/// Which parameters of an autopilot matter, and what they have to be: configs/autopilots/*.yaml.
namespace saker::flight::mavlink {

/// One parameter. It fits where it lies within `least` … `most` if there are bounds, else where it
/// is one of `values`.
struct ExpectedParameter {
  std::string name;
  std::vector<double> values;  ///< the first is written; empty: a person has to choose
  double least = -1e9, most = 1e9;
  bool latency = false;
  bool our_system = false;
  bool optional = false;
  std::string why;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "as the autopilot names it, at most 16 characters");
    v.field("values", values, {-1e9, 1e9}, "",
            "each of which is right where there are no bounds; the first is written");
    v.field("least", least, {-1e9, 1e9}, "", "the least that is right");
    v.field("most", most, {-1e9, 1e9}, "", "the most that is right");
    v.field("latency", latency, "", "it has to be the measured latency of odometry, ms");
    v.field("our_system", our_system, "", "it has to be mavlink.system");
    v.field("optional", optional, "", "where the autopilot has no such parameter nothing is wrong");
    v.field("why", why, "", "what happens otherwise");
  }

  /// Of a value as it was read. \param latency_ms  measured; NaN: not known, then it fits.
  [[nodiscard]] bool fits(double value, double latency_ms) const;
  [[nodiscard]] bool bounded() const;
  /// What is written where it does not fit; NaN: nothing, a person has to choose.
  [[nodiscard]] double wanted(double latency_ms) const;
  /// "6", "6 or 7", "0.2 … 1", "45 ± 15"
  [[nodiscard]] std::string expected_text(double latency_ms) const;
};

struct ParameterTable {
  Autopilot autopilot = Autopilot::ardupilot;
  std::string firmware;
  std::string evidence;
  std::vector<ExpectedParameter> parameters;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("autopilot", autopilot, "", "px4 or ardupilot");
    v.field("firmware", firmware, "", "for which it holds");
    v.field("evidence", evidence, "", "flown, or read in the sources");
    v.list("parameters", parameters, "what has to be so");
  }
};

/// Throws Error that names file and key: an unknown key, a name twice or too long, nothing that is
/// expected. \param our_system  the value of those that have to be it
[[nodiscard]] ParameterTable read_parameter_table(const std::filesystem::path& file,
                                                  int our_system);

}  // namespace saker::flight::mavlink
