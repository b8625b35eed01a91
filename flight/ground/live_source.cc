#include "flight/ground/live_source.h"

#include <spdlog/spdlog.h>

#include <thread>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight::ground {
namespace {

using viewers::Topic;

constexpr std::chrono::milliseconds kPeriod{50};  // messages wait in the queues of LCM meanwhile

}  // namespace

double system_seconds() { return static_cast<double>(system_utime()) * 1e-6; }

LiveSource::LiveSource(const BusConfig& config, const std::string& name,
                       std::shared_ptr<const viewers::Site> site, Hub& hub, OrderDesk& orders,
                       viewers::Recording* recording)
    : config_(config),
      name_(name),
      control_(Bus::on_network(config.control_url, config.receive_buffer_kb, name)),
      views_(std::move(site), kLost_s),
      publisher_(hub, recording, true),
      orders_(orders) {
  subscribe();
}

void LiveSource::subscribe() {
  const auto hear = [this](const std::string& channel, Bus::Bytes bytes) {
    return views_.hear(channel, bytes, system_seconds());
  };
  for (const char* suffix :
       {kChannel<vehicle_state_t>.suffix, kChannel<odometry_t>.suffix,
        kChannel<trajectory_t>.suffix, kChannel<plan_t>.suffix, kChannel<verdict_t>.suffix,
        kChannel<detections_t>.suffix, kChannel<object_map_t>.suffix, kChannel<health_t>.suffix,
        kChannel<mission_t>.suffix})
    control_.subscribe_raw(suffix, hear);
  control_.subscribe_all<mission_t>([this](const std::string& robot, const mission_t& message) {
    orders_.hear(robot, message);
    return true;
  });
}

/// Its bytes are most of what a robot says; the network is joined once somebody wants them.
void LiveSource::join_bulk() {
  const bool scans = publisher_.wanted(Topic::points);
  const bool occupancy = publisher_.wanted(Topic::occupancy);
  views_.want_bulk(scans, occupancy);
  if (!scans && !occupancy) {
    bulk_.reset();
    return;
  }
  if (bulk_ || bulk_failed_) return;
  try {
    bulk_.emplace(Bus::on_network(config_.bulk_url, config_.receive_buffer_kb, name_));
  } catch (const Error& error) {
    bulk_failed_ = true;
    spdlog::warn("no scans and no occupancy: {}", error.what());
    return;
  }
  const auto hear = [this](const std::string& channel, Bus::Bytes bytes) {
    return views_.hear(channel, bytes, system_seconds());
  };
  bulk_->subscribe_raw(kChannel<scan_t>.suffix, hear);
  bulk_->subscribe_raw(kChannel<occupancy_t>.suffix, hear);
}

void LiveSource::step() {
  const auto now = std::chrono::steady_clock::now();
  next_ = std::max(next_ + kPeriod, now);
  std::this_thread::sleep_until(next_);
  if (control_.handle(std::chrono::milliseconds(0)) < 0) throw Error("the LCM network is gone");
  if (bulk_ && bulk_->handle(std::chrono::milliseconds(0)) < 0) bulk_.reset();
  const double t = system_seconds();
  orders_.step(t, std::chrono::steady_clock::now(),
               [&](const std::string& robot, const Json& order) {
                 viewers::RobotView* const view = views_.find(robot);  // a name makes no robot
                 if (view == nullptr) return;
                 view->say_order(order, t);
                 view->log(viewers::LogLevel::info,
                           "order " + order.at("kind").get<std::string>() + ": " +
                               order.at("state").get<std::string>(),
                           t);
               });
  publisher_.publish_due(views_, t);
  join_bulk();
}

}  // namespace saker::flight::ground
