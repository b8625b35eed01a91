#include <array>
#include <fstream>
#include <lcm/lcm-cpp.hpp>

#include "exchange/made_measurement.h"
#include "flight/base_station/store.h"
#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/bus/occupancy_messages.h"
#include "flight/bus/scan_messages.h"
#include "flight/link/fragments.h"
#include "flight/mavlink/codec.h"
#include "lcm_bytes.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/journal_store.h"
#include "saker/exchange/message.h"
#include "saker/exchange/packed_history.h"
#include "saker/objects/map_io.h"
#include "saker/objects/smap_geometry.h"
#include "seeds.h"

namespace saker::lidar::fuzz {
namespace {

SeedBytes with_size(const SeedBytes& bytes) {
  SeedBytes all = {static_cast<std::uint8_t>(bytes.size()),
                   static_cast<std::uint8_t>(bytes.size() >> 8)};
  all.insert(all.end(), bytes.begin(), bytes.end());
  return all;
}

SeedBytes as_bytes(std::string_view text) { return {text.begin(), text.end()}; }

std::string in_repository(const std::string& file) {
  return core::read_file(std::filesystem::path(SAKER_SOURCE_DIR) / file);
}

objects::ObjectMap made_map() {
  static const objects::ClassTable table;
  core::Rng rng(3);
  objects::ObjectMap map;
  for (int id = 0; id < 4; ++id) {
    const auto seen = exchange::some_measurement(rng, 0, id % 2 == 0);
    objects::MapObject object;
    object.id = id;
    object.class_id = seen.class_id;
    object.observations = 3;
    object.class_probability.assign(static_cast<std::size_t>(table.size()), 0);
    object.class_probability[object.class_id] = 1;
    object.model = seen.model;
    object.covariance = seen.covariance;
    map.objects.push_back(object);
  }
  return map;
}

autonomy::RegisteredScan made_scan() {
  autonomy::RegisteredScan scan;
  scan.stamp = kNanosecondsPerSecond;
  scan.points = std::make_shared<std::vector<Eigen::Vector3f>>(30, Eigen::Vector3f(1, 2, 3));
  return scan;
}

occupancy::OccupancyGrid made_grid() {
  occupancy::OccupancyGrid grid;
  grid.stamp = kNanosecondsPerSecond;
  grid.resolution_m = 0.25;
  grid.origin.setZero();
  grid.size.setConstant(4);
  grid.cells.assign(64, occupancy::Cell::free);
  grid.cells[20] = occupancy::Cell::occupied;
  return grid;
}

motion::Trajectory made_trajectory() {
  motion::Trajectory trajectory;
  trajectory.id = 3;
  trajectory.step_s = 0.1;
  for (int i = 0; i < 3; ++i) {
    motion::MotionState state;
    state.position = {0.1 * i, 0, 2};
    state.velocity = state.acceleration = Eigen::Vector3d::Zero();
    state.yaw = state.yaw_rate = 0;
    trajectory.states.push_back(state);
  }
  return trajectory;
}

/// In the order of bus_message_fuzz.cc.
void add_messages(Seeds& seeds) {
  std::uint8_t type = 0;
  const auto add = [&](const auto& message) {
    seeds.add("bus_message", behind(type++, body_of(message)));
  };
  add(flight::to_lcm(VehicleState()));
  add(flight::to_lcm(Command{1, 2, CommandKind::takeoff, 3}));
  add(flight::to_lcm(CommandAck{1, 2, false, "no"}));
  add(flight::to_lcm(Setpoint()));
  add(flight::to_lcm(VehicleOdometry()));
  add(flight::to_lcm(made_trajectory(), 0).value());
  add(flight::to_lcm(motion::Verdict()));
  const objects::ObjectMap map = made_map();
  add(flight::to_lcm(map.objects[0]));
  objects::Detections detections;
  core::Rng rng(5);
  detections.measurements = {exchange::some_measurement(rng, 0, true),
                             exchange::some_measurement(rng, 0, false)};
  add(flight::to_lcm(detections));
  add(flight::MapSender().next(map, 0));
  add(mission_t{});
  exchange_t datagram{};
  datagram.data.assign(20, 7);
  datagram.num_data = 20;
  add(datagram);
  add(order_t{});
  add(plan_t{});
  add(health_t{});
  add(presence_t{});
}

void add_chunks(Seeds& seeds) {
  const auto scan = flight::to_lcm(made_scan(), 1);
  seeds.add("bus_chunks", behind(0, with_size(body_of(scan.at(0)))));
  seeds.add("bus_chunks", behind(1, with_size(body_of(flight::to_lcm(made_grid(), 1).at(0)))));
  lcm::LogFile log(seeds.file("scan_log").string(), "w");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(scan[0].getEncodedSize()));
  scan[0].encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  lcm::LogEvent event{0, 1000, "R1_SCAN", static_cast<int32_t>(bytes.size()), bytes.data()};
  log.writeEvent(&event);
}

void add_exchange(Seeds& seeds) {
  using namespace exchange;
  const StreamId id{"R1", StreamKind::history, 1};
  const auto asks = to_bytes(HoldingsMessage{true, 1, 0, {{id, {700, {{2, kChunkBytes}}}, 7}}});
  SeedBytes talk = with_size(as_bytes(asks));
  const SeedBytes chunk = with_size(as_bytes(to_bytes(ChunkMessage{id, 0, "abcdef"})));
  talk.insert(talk.end(), chunk.begin(), chunk.end());
  seeds.add("exchange_message", talk);

  core::Rng rng(1);
  slam::History history{"R1", 1, {}};
  for (int i = 0; i < 5; ++i) {
    slam::HistoryEntry entry;
    entry.stamp = i * kNanosecondsPerSecond;
    entry.T_odom_lidar.translation() = some_vector(rng, 3);
    entry.motion_covariance = some_covariance(rng, 6);
    entry.measurements = {some_measurement(rng, entry.stamp, i % 2 == 0)};
    history.entries.push_back(entry);
  }
  seeds.add("packed_history", as_bytes(packed(history, kClasses)));

  const auto journal = seeds.file("journal"), base = seeds.file("base_store");
  JournalStore own(journal);
  flight::DatabaseStore store(base.string(), 10);
  for (Store* const each : {static_cast<Store*>(&own), static_cast<Store*>(&store)}) {
    (void)each->append(id, packed(history, kClasses));
    (void)each->append({"R2", StreamKind::prior_map, 1}, "a map");
  }
  store.note_contact("R1", 5);
  seeds.add("journal", behind(0, as_bytes(core::read_file(journal))));
  ByteWriter record;
  record.text("R1");
  for (int i = 0; i < 4; ++i) record.byte(i == 1 ? 1 : 0);  // kind, version, chunk, from
  record.text("abc");
  seeds.add("journal", behind(1, with_size(as_bytes(record.bytes()))));
}

void add_sealed(Seeds& seeds) {
  using namespace exchange;
  seeds.add("sealed", {0, 0, 0, 'a', 'b', 'c'});
  seeds.add("sealed", {9, 0, 1, 'a', 'b', 'c'});
  const std::string digits(64, 'a');
  seeds.add("key_file", as_bytes(digits + "\nR1 2\n"));
  seeds.add("key_file", as_bytes("R1 " + digits + "\n"));
  ByteWriter order;
  order.byte(1);
  order.text("R1");
  order.byte(0);
  for (const std::uint64_t number : {7ULL, 1'000'000'000ULL}) order.fixed(number);
  seeds.add("order", as_bytes(order.bytes()));
  SeedBytes link;
  for (const std::uint16_t index : {0, 1}) {
    const SeedBytes body =
        with_size(as_bytes(to_bytes(flight::Fragment{"_STATE", 1, index, 2, "state"})));
    for (const int byte : {1, 1, 1 + index}) link.push_back(static_cast<std::uint8_t>(byte));
    link.insert(link.end(), body.begin(), body.end());
  }
  seeds.add("link", link);
}

void add_maps(Seeds& seeds) {
  using namespace objects;
  const ClassTable table;
  const ObjectMap map = made_map();
  for (const std::string version : {"version_1", "version_2"}) {
    const std::string bytes = in_repository("tests/objects/" + version + ".smap");
    for (const std::uint8_t which : {0, 1}) seeds.add("smap", behind(which, bytes));
  }
  for (const std::uint8_t which : {0, 1}) seeds.add("smap", behind(which, to_smap(map, table)));
  SmapHead head;
  head.frame = "world";
  for (const ObjectClass& each : table.classes) head.classes.push_back({each.name, each.shape});
  head.tiles = {{0, 0, 1, 0, 10, 0, 0}};
  seeds.add("smap", behind(2, pack_head(head)));
  const GroundPlane plane{};
  seeds.add("smap", behind(8 + 3, pack_ground(std::vector{Listed<GroundPlane>{0, plane}})));
  const std::vector listed = {Listed<const MapObject*>{0, &map.objects[0]},
                              Listed<const MapObject*>{1, &map.objects[1]}};
  seeds.add("smap", behind(2 * 8 + 4, pack_details(listed)));
  const std::vector coarse_objects = {coarse(map.objects[0], table, head.steps)};
  seeds.add("smap", behind(8 + 6, pack_geometry(coarse_objects, head.classes, head.steps)));
  seeds.add("map_json", as_bytes(to_json(map, table)));
  seeds.add("map_json", as_bytes(in_repository("tests/objects/version_1.json")));
}

void add_files(Seeds& seeds) {
  seeds.add("configuration",
            behind(0,
                   "most: 7\nfilter: none\ngates:\n  - distance_m: 1\n    robust: false\n"
                   "weights: [1, 2]\nnames: [a, \"b: c\"]\ngate: {distance_m: 3}\n"));
  seeds.add("configuration", behind(0, "old: {far: 2}\ngone: 1\nmodel: x\n"));
  seeds.add("configuration", behind(1, "gates[1].distance_m=2"));
  seeds.add("configuration", behind(2, in_repository("configs/models/classes.yaml")));
  seeds.add("configuration", behind(3, in_repository("configs/autopilots/px4.yaml")));
  const std::string model = in_repository("configs/models/uncertainty-replica.yaml");
  seeds.add("model_file", behind(0, model));
  const std::size_t sum = model.find("sha256: ");
  seeds.add("model_file", behind('u', model.substr(model.find('\n', sum) + 1)));
  seeds.add("model_file", behind('s', in_repository("configs/models/segmentation.yaml")));
  seeds.add("model_file",
            behind('v',
                   "lasers:\n- {laser_id: 0, vert_correction: -0.1, rot_correction: 0.02, "
                   "dist_correction: 1.2}\nnum_lasers: 1\n"));
  seeds.add("model_file", behind('x',
                                 "<px class_id=\"9\"><id_>0</id_><rotCorrection_>1</rotCorrection_>"
                                 "<vertCorrection_>2</vertCorrection_></px>"));
  seeds.add("model_file", behind('c', "Channel,Elevation,Azimuth\n1,14.9,-1.04\n2,11.0,-1.04\n"));
}

/// A frame of each message of the table, its numbers zero and of ones.
void add_mavlink(Seeds& seeds) {
  using namespace flight::mavlink;
  for (const std::uint8_t autopilot : {0, 1}) {
    for (const std::uint8_t value : {0, 1}) {
      SeedBytes line = {autopilot};
      for (std::size_t i = 0; i < kDefinitions.size(); ++i) {
        line.push_back(static_cast<std::uint8_t>(2 * i));
        line.push_back(kDefinitions[i].length);
        line.insert(line.end(), kDefinitions[i].length, value);
      }
      seeds.add("mavlink", line);
    }
  }
}

}  // namespace

void add_flight(Seeds& seeds) {
  add_messages(seeds);
  add_chunks(seeds);
  add_exchange(seeds);
  add_sealed(seeds);
  add_maps(seeds);
  add_files(seeds);
  add_mavlink(seeds);
}

}  // namespace saker::lidar::fuzz
