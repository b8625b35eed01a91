#include "flight_viewers/made_robot.h"

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "flight/bus/bus.h"
#include "flight/bus/scan_messages.h"

/// A robot that flies a circle, for tests by processes: says what an executive, a flight controller
/// and a collision checker say, at their rates, on the networks of the default configuration.
///   made_robot ROBOT SECONDS OBJECTS
namespace saker::flight {
namespace {

using namespace viewers::testing;

class MadeRobot {
 public:
  MadeRobot(const std::string& robot, int objects) : bus_({}, robot) {
    for (int id = 0; id < objects; ++id) map_.objects.push_back(made_vehicle(id, 5.0 * id, 2));
    for (const objects::MapObject& object : map_.objects) {
      objects::MapObject told = object;
      told.id = 100 + object.id;
      tour_.push_back(told.id);
    }
  }

  /// The hundredth of a second `i`.
  void step(int i) {
    const double t = 0.01 * i;
    const auto utime = static_cast<std::int64_t>(t * 1e6) + 1;
    bus_.publish(made_odometry(utime, 10 * std::cos(t / 5), 10 * std::sin(t / 5)));
    if (i % 2 == 0) bus_.publish(made_state());
    if (i % 2 == 1) bus_.publish(setpoint_t{});
    if (i % 10 == 0) bus_.publish(verdict_t{});
    if (i % 10 == 0) {
      for (const scan_t& chunk : to_lcm(made_scan(20000), i)) bus_.publish(chunk);
    }
    if (i % 100 == 0) slow(utime);
    if (i % 200 == 0) bus_.publish(sender_.next(map_, from_utime(utime)));
  }

 private:
  void slow(std::int64_t utime) {
    bus_.publish(made_mission("tour", autonomy::Cause::took_off, "3 m"));
    bus_.publish(made_plan(tour_, 1 + utime / 3000000));
    bus_.publish(made_trajectory(1 + utime / 3000000, 60));
    health_t health{};
    health.utime = utime;
    health.process = "saker-flight";
    health.loops.resize(8);
    health.num_loops = 8;
    for (loop_health_t& loop : health.loops) loop.name = "odometry";
    bus_.publish(health);
  }

  Bus bus_;
  objects::ObjectMap map_;
  std::vector<int> tour_;
  MapSender sender_;
};

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  saker::flight::MadeRobot robot(argv[1], std::stoi(argv[3]));
  const int steps = static_cast<int>(100 * std::stod(argv[2]));
  auto next = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) {
    robot.step(i);
    next += std::chrono::milliseconds(10);
    std::this_thread::sleep_until(next);
  }
  return 0;
}
