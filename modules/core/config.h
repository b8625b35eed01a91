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
///       double voxel_m = 1.0;
///       MapConfig map;
///
///       template <class Visitor>
///       void visit(Visitor& v) {
///         v.field("voxel_m", voxel_m, {0.05, 10}, "m", "edge of a voxel of the local map:
///         KISS-ICP's 1 % of the range"); v.group("map", map, "the local map");
///       }
///     };
///
/// Loading, saving, checking and documenting all come from that list (config_io.h). Keys are named
/// as the members; units that are not SI are in the name. The parent's struct contains its
/// children's: the file has the shape of the program.
namespace saker::core {

/// Closed interval of valid values; a value out of it (or NaN) is an Error that names the key.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// A visitor of configurations, for documentation. Fields are bool, int, double, std::string, an
/// enum with `enum_names(E)`, or vectors of double or std::string.
///
///     template <class T> void field(const char* name, T& value, Bounds bounds, const char* unit,
///     const char* meaning); template <class T> void field(const char* name, T& value, const char*
///     unit, const char* meaning); template <class Config> void group(const char* name, Config&
///     child, const char* meaning); template <class Config> void list(const char* name,
///     std::vector<Config>& children, const char* meaning);

/// Visits a config and throws Error("key: value, expected low … high") on the first number out of
/// its bounds: what a stage's constructor calls, so that a config that did not come from a file is
/// checked too.
class BoundsCheck {
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
