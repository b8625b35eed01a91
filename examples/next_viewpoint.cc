// Where to look next: the viewpoint that a vehicle at (X, Y, Z) should fly to, given a map.
//   next_viewpoint MAP X Y Z [YAW]        m and degrees, in the map's frame
#include <saker/active/active.h>
#include <saker/objects/map_io.h>
#include <saker/uncertainty/uncertainty.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>

namespace {

using namespace saker;

int run(const char* file, const Eigen::Vector3d& place, double yaw) {
  const objects::ClassTable table;
  const objects::ObjectMap map = objects::read_map(file, table);
  const auto model = std::make_shared<const uncertainty::Model>(
      uncertainty::Model::load(MODELS "/uncertainty.yaml", table));
  const auto fence = [](const Eigen::Vector3d& p) { return p.z() > 1 && p.z() < 10; };
  active::ActiveConfig config;
  config.policy = active::PolicyName::saker;
  active::TargetTour tour = active::make_tour(config, table, map, fence, model);
  active::ActiveInput now;
  now.stamp = 1;
  now.T_world_body = active::level_pose(place, yaw);
  now.map = std::make_shared<const objects::ObjectMap>(map);
  const active::ActivePlan plan = tour.plan(now, core::Budget::iterations(1000));
  if (!plan.goal) {
    std::puts("nothing is left to be seen");
    return 1;
  }
  std::printf("object %d from %.2f %.2f %.2f m, yaw %.0f deg\n", plan.goal->target_id,
              plan.goal->position.x(), plan.goal->position.y(), plan.goal->position.z(),
              plan.goal->yaw * 180 / std::numbers::pi);
  if (plan.expected) std::printf("expected gain %.2f nat\n", plan.expected->gain);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const double yaw = argc == 6 ? std::atof(argv[5]) * std::numbers::pi / 180 : 0;
  if (argc == 5 || argc == 6)
    return run(argv[1], {std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])}, yaw);
  std::fprintf(stderr, "usage: next_viewpoint MAP X Y Z [YAW]\n");
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "next_viewpoint: %s\n", error.what());
  return 2;
}
