#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <optional>

#include "flight/base_station/base_station.h"
#include "flight/bus/multicast.h"
#include "flight/bus/presence.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using Steady = BaseStation::Steady;

constexpr const char* kRole = "saker-base";

/// One of the base's networks, and the proof that no other base is on it.
struct Side {
  Side(const std::string& url, int receive_buffer_kb, const std::string& name)
      : bus(Bus::on_network(url, receive_buffer_kb, name)),
        presence(bus, kRole, Presence::Among::whole_network) {}

  void announce() {
    presence.announce();
    if (presence.outranked()) throw Error(presence.other());
  }

  Bus bus;
  Presence presence;
};

/// The folder is this process's while it lives: two that write one store would not know of each
/// other's chunks.
class OwnFolder {
 public:
  explicit OwnFolder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (error || descriptor_ < 0)
      throw Error("base.folder " + folder + " cannot be made or opened");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw Error("base.folder " + folder + " is used by another saker-base");
  }
  ~OwnFolder() { ::close(descriptor_); }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

 private:
  int descriptor_ = -1;
};

/// Two sockets on one port hear each other's groups.
void check_apart(const std::string& robots, const std::string& ground) {
  const MulticastGroup a = multicast_group(robots), b = multicast_group(ground);
  if (a.address == b.address || a.port == b.port)
    throw Error("base.relay.ground_url " + ground +
                ", expected another group and another port than bus.control_url " + robots);
}

void claim(Side& robots, std::optional<Side>& ground) {
  std::future<void> other;
  if (ground)
    other = std::async(std::launch::async, [&presence = ground->presence] { presence.claim(); });
  robots.presence.claim();
  if (ground) other.get();
}

void serve(BaseStation& base, Side& robots, std::optional<Side>& ground) {
  Service service;
  service.ready();
  Steady::time_point next_announcement = Steady::now();
  while (stop_requests() == 0) {
    const auto until = std::min(base.next_due(), next_announcement);
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until - Steady::now());
    if (Bus::handle({&robots.bus, ground ? &ground->bus : nullptr}, wait) < 0)
      throw Error("the LCM network is gone");
    base.step(Steady::now());
    service.alive(Steady::now());
    if (Steady::now() < next_announcement) continue;
    robots.announce();
    if (ground) ground->announce();
    next_announcement = Steady::now() + Presence::kPeriod;
  }
  service.stopping();
}

int run(const ProcessOptions& options) {
  const ProcessConfig config = read_configuration(options.configuration);
  const std::string& ground_url = config.base.relay.ground_url;
  const int buffer_kb = config.bus.receive_buffer_kb;
  Side robots(config.bus.control_url, buffer_kb, options.robot);
  std::optional<Side> ground;
  if (!ground_url.empty()) {
    check_apart(config.bus.control_url, ground_url);
    ground.emplace(ground_url, buffer_kb, options.robot);
  }
  claim(robots, ground);
  const OwnFolder own(config.base.folder);
  DatabaseStore store(store_file(config.base), config.base.most_store_mb);
  BaseStation base(config, store, robots.bus, ground ? &ground->bus : nullptr);
  spdlog::info("listens as {}, holds {} streams, {}", options.robot, store.extents().size(),
               ground ? "relays to " + ground_url : "relays nothing");
  serve(base, robots, ground);
  base.say_totals();
  spdlog::info("ends as asked");
  return 0;
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  return saker::flight::run_program(
      {.name = "saker-base",
       .does = "The base station: keeps every robot's history, hands it to the others, relays "
               "between the robots' network and the ground's.",
       .robot = "BASE",
       .run = saker::flight::run},
      argc, argv);
}
