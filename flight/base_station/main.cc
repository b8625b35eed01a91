#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

#include "flight/base_station/base_station.h"
#include "flight/base_station/radio_thread.h"
#include "flight/bus/multicast.h"
#include "flight/bus/presence.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using Steady = BaseStation::Steady;

constexpr const char* kRole = "saker-base";

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

void serve(BaseStation& base, Bus& bus, Presence& presence, const RadioThread* radio) {
  Service service;
  service.ready();
  Steady::time_point next_announcement = Steady::now();
  while (stop_requests() == 0) {
    const auto until = std::min(base.next_due(), next_announcement);
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until - Steady::now());
    if (Bus::handle({&bus}, wait) < 0) throw Error("the LCM network is gone");
    base.step(Steady::now());
    if (radio == nullptr || radio->runs(Steady::now())) service.alive(Steady::now());
    if (Steady::now() < next_announcement) continue;
    presence.announce();
    if (presence.outranked()) throw Error(presence.other());
    next_announcement = Steady::now() + Presence::kPeriod;
  }
  service.stopping();
}

int run(const ProcessOptions& options) {
  const ProcessConfig config = read_configuration(options.configuration);
  require_on_machine("bus.control_url", config.bus.control_url);
  Bus bus = Bus::on_network(config.bus.control_url, config.bus.receive_buffer_kb, options.robot);
  Presence presence(bus, kRole, Presence::Among::whole_network);
  presence.claim();
  const OwnFolder own(config.base.folder);
  DatabaseStore store(store_file(config.base), config.base.most_store_mb);
  std::optional<RadioThread> radio;
  if (config.link.port != 0) radio.emplace(config, options.robot);
  BaseStation base(config, store, bus,
                   radio ? [&radio] { return radio->report(); } : LinkReports{});
  spdlog::info("listens as {}, holds {} streams, {}", options.robot, store.extents().size(),
               radio ? "robots call UDP port " + std::to_string(config.link.port)
                     : "hears no robot over the radio");
  serve(base, bus, presence, radio ? &*radio : nullptr);
  base.say_totals();
  spdlog::info("ends as asked");
  return 0;
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  return saker::flight::run_program(
      {.name = "saker-base",
       .does = "The base station: keeps every robot's history, hands it to the others, and opens "
               "what robots say over the radio onto this machine's LCM.",
       .robot = "BASE",
       .run = saker::flight::run},
      argc, argv);
}
