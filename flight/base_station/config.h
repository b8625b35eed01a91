#pragma once

#include <string>

#include "saker/core/config.h"

namespace saker::flight {

struct BaseConfig {
  static constexpr int kMostRobots = 64;  // whom its seals' windows take (exchange/seal.h)

  std::string folder = "saker-base";
  int most_store_mb = 4096;
  int most_robots = 32;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting(
        "folder", folder, "",
        "The base station keeps what the robots said in this folder (base.db), made if need be.");
    v.setting("most_store_mb", most_store_mb, {1, 1 << 20}, "MB",
              "The store grows to this size; what is more is refused.");
    v.setting("most_robots", most_robots, {1, kMostRobots}, "",
              "The base station exchanges with at most so many robots.");
  }
};

/// The file of the store.
[[nodiscard]] inline std::string store_file(const BaseConfig& config) {
  return config.folder + "/base.db";
}

}  // namespace saker::flight
