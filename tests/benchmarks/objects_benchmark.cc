/// A million objects 5 m from each other on rough ground in a `.smap`: bytes an object (at most 9),
/// objects a second (at least a million, one thread), the largest errors of what is read back (2
/// cm, 1°), and a region read out of the file. Beside it the voxel map of the same ground: OctoMap
/// at 0.25 m over a patch of it and its .bt file, bytes a hectare of both.
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../objects/made_map.h"
#include "../objects/map_error.h"
#include "saker/objects/map_io.h"

namespace saker::objects {
namespace {

constexpr int kObjects = 1000000;
constexpr std::uint64_t kSeed = 1;
const ClassTable kTable;

const ObjectMap& map() {
  static const ObjectMap made = made::large_map(kObjects, kSeed);
  return made;
}

const std::string& packed() {
  static const std::string bytes = to_smap(map(), kTable, SmapContent::geometry);
  return bytes;
}

Region square(const Eigen::Vector2d& corner, double edge) {
  return {corner, corner + Eigen::Vector2d::Constant(edge)};
}

void count_objects(benchmark::State& state, std::size_t objects) {
  state.counters["objects"] = static_cast<double>(objects);
  state.counters["objects/s"] = benchmark::Counter(static_cast<double>(objects),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void smap_write(benchmark::State& state) {
  std::size_t bytes = 0;
  (void)map();
  for (auto _ : state) bytes = to_smap(map(), kTable, SmapContent::geometry).size();
  count_objects(state, map().objects.size());
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
  state.counters["bytes/object"] =
      static_cast<double>(bytes) / static_cast<double>(map().objects.size());
}
BENCHMARK(smap_write)->Unit(benchmark::kMillisecond)->Iterations(3);

void smap_read(benchmark::State& state) {
  (void)packed();
  ObjectMap read;
  for (auto _ : state) {
    read = {};
    read = from_smap(packed(), kTable, "map.smap");
  }
  count_objects(state, read.objects.size());
}
BENCHMARK(smap_read)->Unit(benchmark::kMillisecond)->Iterations(3);

void smap_errors(benchmark::State& state) {
  made::MapError worst;
  for (auto _ : state) {
    const ObjectMap read = from_smap(packed(), kTable, "map.smap");
    worst = made::largest_error(map(), read);
  }
  state.counters["position_cm"] = 100 * worst.position;
  state.counters["size_cm"] = 100 * worst.size;
  state.counters["radius_cm"] = 100 * worst.radius;
  state.counters["heading_deg"] = worst.heading * 180 / std::numbers::pi;
  state.counters["tilt_deg"] = worst.tilt * 180 / std::numbers::pi;
  state.counters["probability"] = worst.probability;
}
BENCHMARK(smap_errors)->Unit(benchmark::kMillisecond)->Iterations(1);

/// With identities and a covariance for each object: what a flight writes.
void smap_everything(benchmark::State& state) {
  ObjectMap full = map();
  core::Rng rng(kSeed);
  for (MapObject& object : full.objects) {
    const int rows = std::holds_alternative<Cuboid>(object.model) ? 9 : 6;
    object.covariance = Eigen::MatrixXd::Zero(rows, rows);
    for (int i = 0; i < rows; ++i) object.covariance(i, i) = rng.uniform(1e-4, 1e-2);
    object.observations = 1 + rng.index(30);
  }
  const std::string bytes = to_smap(full, kTable);
  const bool reading = state.range(0) != 0;
  ObjectMap read;
  for (auto _ : state) {
    if (reading) {
      read = {};
      read = from_smap(bytes, kTable, "map.smap");
    } else {
      benchmark::DoNotOptimize(to_smap(full, kTable));
    }
  }
  count_objects(state, full.objects.size());
  state.counters["MB"] = static_cast<double>(bytes.size()) / 1e6;
}
BENCHMARK(smap_everything)
    ->ArgName("read")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// 100 m × 100 m out of the file, the head included.
void smap_region(benchmark::State& state) {
  const auto file = std::filesystem::temp_directory_path() / "saker_objects_benchmark.smap";
  std::ofstream(file, std::ios::binary) << packed();
  MapRead read;
  for (auto _ : state) {
    read = read_map_part(file, kTable, square({2000, 3000}, 100));
  }
  std::filesystem::remove(file);
  state.counters["objects"] = static_cast<double>(read.map.objects.size());
  state.counters["tiles"] = static_cast<double>(read.tiles_decoded);
}
BENCHMARK(smap_region)->Unit(benchmark::kMillisecond);

/// The voxel map of a patch of the same ground.

constexpr double kVoxel_m = 0.25, kPatch_m = 200, kFlightHeight_m = 5;
const Region kPatch = square({3000, 3000}, kPatch_m);

bool inside(const Model& model, const Eigen::Vector3d& p) {
  if (const auto* cuboid = std::get_if<Cuboid>(&model)) {
    const Eigen::Vector3d at = cuboid->pose.inverse() * p;
    return (at.cwiseAbs() - cuboid->size / 2).maxCoeff() <= 0;
  }
  const auto& cylinder = std::get<Cylinder>(model);
  const double up = (p - cylinder.root).dot(cylinder.axis);
  const double out = (p - cylinder.root - up * cylinder.axis).norm();
  return up >= 0 && up <= cylinder.height && out <= std::max(cylinder.radius, kVoxel_m / 2);
}

/// Half the edge of a cube about the object's middle that holds it.
double reach(const Model& model) {
  if (const auto* cuboid = std::get_if<Cuboid>(&model)) return cuboid->size.norm() / 2;
  return std::get<Cylinder>(model).height + std::get<Cylinder>(model).radius;
}

void fill(octomap::OcTree& tree, const Model& model) {
  const Eigen::Vector3d middle = place(model);
  const double far = std::ceil(reach(model) / kVoxel_m) * kVoxel_m;
  for (double x = -far; x <= far; x += kVoxel_m)
    for (double y = -far; y <= far; y += kVoxel_m)
      for (double z = -far; z <= far; z += kVoxel_m) {
        const octomap::point3d near(static_cast<float>(middle.x() + x),
                                    static_cast<float>(middle.y() + y),
                                    static_cast<float>(middle.z() + z));
        const octomap::point3d centre = tree.keyToCoord(tree.coordToKey(near));
        const Eigen::Vector3d p(centre.x(), centre.y(), centre.z());
        if (inside(model, p)) tree.setNodeValue(tree.coordToKey(near), 1.F, true);
      }
}

/// Ground, and with `free` what a flight at 5 m sees free below itself.
void fill_ground(octomap::OcTree& tree, const simulation::Terrain& ground, bool free) {
  for (double x = kPatch.min().x() + kVoxel_m / 2; x < kPatch.max().x(); x += kVoxel_m)
    for (double y = kPatch.min().y() + kVoxel_m / 2; y < kPatch.max().y(); y += kVoxel_m) {
      const double z = ground.height(x, y);
      const auto key = [&](double height) { return tree.coordToKey(x, y, height); };
      for (double up = kVoxel_m; free && up < kFlightHeight_m; up += kVoxel_m)
        tree.setNodeValue(key(z + up), -1.F, true);
      tree.setNodeValue(key(z), 1.F, true);
    }
}

void voxel_map(benchmark::State& state) {
  core::Rng rng(kSeed);
  const simulation::Terrain ground = made::rough_ground(rng);
  const ObjectMap patch = clipped(map(), kPatch);
  std::stringstream file;
  for (auto _ : state) {
    octomap::OcTree tree(kVoxel_m);
    fill_ground(tree, ground, state.range(0) != 0);
    for (const MapObject& object : patch.objects) fill(tree, object.model);
    tree.updateInnerOccupancy();
    tree.writeBinary(file);
  }
  const double hectares = kPatch_m * kPatch_m / 1e4;
  const double objects = static_cast<double>(patch.objects.size());
  const double smap = static_cast<double>(packed().size()) / static_cast<double>(kObjects);
  state.counters["bt_bytes/ha"] = static_cast<double>(file.str().size()) / hectares;
  state.counters["smap_bytes/ha"] = smap * objects / hectares;
  state.counters["ratio"] = static_cast<double>(file.str().size()) / (smap * objects);
  state.counters["bt_GB_all"] =  // as if all of the ground were like the patch
      static_cast<double>(file.str().size()) * kObjects / objects / 1e9;
  state.counters["objects/ha"] = objects / hectares;
}
BENCHMARK(voxel_map)->ArgName("free")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace saker::objects
