#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/// Configuration: every stage owns a plain struct of defaults and lists its fields once, in
/// `visit`:
///
///     struct OdometryConfig {
///       double max_range_m = 80;
///       double map_sample_m = 0.2;
///       MapConfig map;
///
///       template <class Visitor>
///       void visit(Visitor& v) {
///         v.setting("max_range_m", max_range_m, {5, 500}, "m", "Farther points are left out.");
///         v.field("map_sample_m", map_sample_m, {0.02, 5}, "m", "one point a voxel of this size");
///         v.group("map", map, "the local map");
///       }
///     };
///
/// A `setting` is what the person who flies, mounts or buys sets; a `field` is a constant of an
/// algorithm or of a fit: a file may name both, but `saker config` shows settings alone. Loading,
/// saving, checking and documenting all come from that list (config_io.h). Keys are named as the
/// members; units that are not SI are in the name. The parent's struct contains its children's: the
/// file has the shape of the program.
namespace saker::core {

/// Closed interval of valid values; a value out of it (or NaN) is an Error that names the key.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Base of the visitors to which a setting is a field as any other. Fields are bool, int, double,
/// std::string, an enum with `enum_names(E)`, or vectors of double or std::string.
///
/// A visitor has, as `BoundsCheck` below:
///
///     field(name, value, bounds, unit, meaning) and the same without bounds,
///     group(name, child, meaning) and list(name, children, meaning).
template <class Visitor>
class EachField {
 public:
  template <class T>
  void setting(const char* name, T& value, Bounds bounds, const char* unit, const char* meaning) {
    static_cast<Visitor&>(*this).field(name, value, bounds, unit, meaning);
  }
  template <class T>
  void setting(const char* name, T& value, const char* unit, const char* meaning) {
    static_cast<Visitor&>(*this).field(name, value, unit, meaning);
  }
};

/// Visits a config and throws Error("key: value, expected low … high") on the first number out of
/// its bounds: what a stage's constructor calls, so that a config that did not come from a file is
/// checked too.
class BoundsCheck : public EachField<BoundsCheck> {
 public:
  explicit BoundsCheck(std::string prefix) : prefix_(std::move(prefix)) {}

  template <class T>
  void field(const char* name, T& value, Bounds bounds, const char*, const char*) {
    if constexpr (std::is_arithmetic_v<T>) {
      check(name, static_cast<double>(value), bounds);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      for (const double v : value) check(name, v, bounds);
    }
  }
  template <class T>
  void field(const char*, T&, const char*, const char*) {}
  template <class Config>
  void group(const char* name, Config& child, const char*) {
    BoundsCheck inner(prefix_ + name + ".");
    child.visit(inner);
  }
  template <class Config>
  void list(const char* name, std::vector<Config>& children, const char*) {
    for (std::size_t i = 0; i < children.size(); ++i) {
      BoundsCheck inner(prefix_ + name + "[" + std::to_string(i) + "].");
      children[i].visit(inner);
    }
  }

 private:
  void check(const char* name, double value, Bounds bounds) const;

  std::string prefix_;
};

/// The stage's config, checked. `name` is the prefix that messages show: checked(config,
/// "odometry").
template <class Config>
[[nodiscard]] Config checked(Config config, const std::string& name) {
  BoundsCheck visitor(name + ".");
  config.visit(visitor);
  return config;
}

}  // namespace saker::core
