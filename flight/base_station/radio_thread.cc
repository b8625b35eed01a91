#include "flight/base_station/radio_thread.h"

#include <pthread.h>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLongestWait{100};  // so soon it hears that it is to end
constexpr std::chrono::seconds kStuck{2};

}  // namespace

RadioThread::RadioThread(const ProcessConfig& config, const std::string& name)
    : bus_(Bus::on_network(config.bus.control_url, config.bus.receive_buffer_kb, name)),
      radio_(config.link, LinkEnd::End::ground, static_cast<std::uint16_t>(config.link.port),
             exchange::read_key(config.exchange.key_file), bus_, config.base.most_robots),
      turned_(Steady::now()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

LinkEnd::Report RadioThread::report() const { return report_.latest().value_or(LinkEnd::Report{}); }

bool RadioThread::runs(Steady::time_point now) const {
  if (failed_) throw Error("the LCM network is gone");
  return now - turned_.load() < kStuck;
}

void RadioThread::run(const std::stop_token& stop) {
  (void)::pthread_setname_np(::pthread_self(), "radio");
  while (!stop.stop_requested()) {
    const auto until = std::min(radio_.end().next_due(), Steady::now() + kLongestWait);
    const auto wait = std::chrono::ceil<milliseconds>(until - Steady::now());
    if (Bus::handle({&bus_}, wait, radio_.descriptor()) < 0) {
      failed_ = true;
      return;
    }
    radio_.step(Steady::now());
    report_.put(radio_.end().report());
    turned_ = Steady::now();
  }
  radio_.end().say_goodbye();
}

}  // namespace saker::flight
