#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "flight/bus/bus.h"
#include "flight/bus/exchange_messages.h"
#include "saker/core/files.h"
#include "saker/core/rng.h"
#include "saker/exchange/exchange.h"
#include "saker/exchange/journal_store.h"

/// A robot's end of the exchange as a process: what the executive does, without flying, on a
/// network that loses and repeats messages and hands them over in another order.
///   exchange_robot ROBOT KEY FOLDER MADE_BYTES LOSS [URL]
/// Holds FOLDER/journal; tops its own history up to what FOLDER/history.bin has or else to
/// MADE_BYTES bytes that follow from its name.
/// Writes FOLDER/STREAM.bytes of all that it holds, and FOLDER/sent, when SIGTERM comes.
namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;

std::atomic<bool> stop = false;

struct Options {
  std::string robot, key, folder;
  std::size_t made_bytes = 0;
  double loss = 0;
  std::string url = BusConfig{}.control_url;
};

std::string made_bytes(const std::string& robot, std::size_t size) {
  core::Rng rng(std::hash<std::string>{}(robot));
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(rng.uniform(0, 256));
  return bytes;
}

std::string own_history(const Options& options) {
  const std::filesystem::path file = options.folder + "/history.bin";
  return std::filesystem::exists(file) ? core::read_file(file)
                                       : made_bytes(options.robot, options.made_bytes);
}

Time now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Steady::now().time_since_epoch())
      .count();
}

/// What the air does to messages.
class Air {
 public:
  explicit Air(double loss) : loss_(loss), rng_(static_cast<std::uint64_t>(now())) {}

  /// Calls `arrive` with messages that get through: this one, none, this one twice, or the one
  /// before it after it.
  template <class Arrive>
  void pass(const std::string& message, const Arrive& arrive) {
    if (rng_.uniform() < loss_) return;
    if (loss_ > 0 && held_.empty() && rng_.uniform() < 0.1) {
      held_ = message;
      return;
    }
    arrive(message);
    if (loss_ > 0 && rng_.uniform() < 0.1) arrive(message);
    if (!held_.empty()) arrive(std::exchange(held_, {}));
  }

 private:
  double loss_;
  core::Rng rng_;
  std::string held_;
};

void save(const exchange::Store& store, const exchange::Exchange& link, const Options& options) {
  for (const auto& [id, extent] : store.extents()) {
    std::string name = to_string(id);
    std::replace(name.begin(), name.end(), '/', '_');
    std::ofstream(options.folder + "/" + name + ".bytes", std::ios::binary) << store.bytes(id);
  }
  std::ofstream(options.folder + "/sent") << link.counters().sent_bytes << "\n";
}

void run(const Options& options) {
  std::filesystem::create_directories(options.folder);
  exchange::JournalStore store(options.folder + "/journal");
  const exchange::StreamId own{options.robot, exchange::StreamKind::history, 1};
  const std::string bytes = own_history(options);
  if (store.size(own) < bytes.size())
    (void)store.append(own, std::string_view(bytes).substr(store.size(own)));
  exchange::PeerConfig config;
  config.refused_again_s = 2;
  exchange::Exchange link(config, options.robot, exchange::read_key(options.key), options.folder,
                          store);
  link.add_link(channel_name<exchange_t>(options.robot), exchange::Role::calls);
  Bus bus = Bus::on_network(options.url, BusConfig{}.receive_buffer_kb, options.robot);
  Air up(options.loss), down(options.loss);
  bus.subscribe<exchange_t>([&](const exchange_t& message) {
    down.pass(std::string(datagram_of(message)), [&](const std::string& arrived) {
      (void)link.receive(now(), channel_name<exchange_t>(options.robot), arrived);
    });
    return true;
  });
  while (!stop) {
    bus.handle(std::chrono::milliseconds(20));
    while (const auto datagram = link.next(now())) {
      up.pass(datagram->bytes,
              [&](const std::string& departs) { bus.publish(to_lcm(system_utime(), departs)); });
    }
  }
  save(store, link, options);
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  std::signal(SIGTERM, [](int) { saker::flight::stop = true; });
  try {
    saker::flight::Options options{argv[1], argv[2], argv[3], std::stoul(argv[4]),
                                   std::stod(argv[5])};
    if (argc > 6) options.url = argv[6];
    saker::flight::run(options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
