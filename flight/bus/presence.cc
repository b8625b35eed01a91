#include "flight/bus/presence.h"

#include <unistd.h>

#include <algorithm>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kSlice{50};  // of listening, between two announcements

std::int64_t microseconds_of_the_system() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// No two starts share the microsecond and the process number.
std::int64_t new_instance() {
  constexpr std::int64_t kProcesses = 1 << 22;  // the kernel's ceiling of process numbers
  constexpr std::int64_t kTimes = std::int64_t{1} << 40;
  return microseconds_of_the_system() % kTimes * kProcesses + ::getpid() % kProcesses;
}

}  // namespace

Presence::Presence(Bus& bus, const std::string& role, Among among)
    : bus_(bus), role_(role), instance_(new_instance()) {
  const auto hear = [other = other_, role = role_, instance = instance_](
                        const std::string& robot, const presence_t& message) {
    if (message.role != role || message.instance == instance) return true;
    const std::lock_guard lock(other->mutex);
    other->heard = true;
    other->robot = robot;
    other->last = message;
    return true;
  };
  if (among == Among::whole_network) {
    bus.subscribe_all<presence_t>(hear);
  } else {
    bus.subscribe<presence_t>(
        [hear, robot = bus.robot()](const presence_t& message) { return hear(robot, message); });
  }
}

void Presence::claim(std::chrono::milliseconds listen) {
  const auto end = steady_clock::now() + listen;
  while (steady_clock::now() < end) {
    announce();
    listen_until(std::min(end, steady_clock::now() + kSlice));
  }
  const std::lock_guard lock(other_->mutex);
  other_->heard = false;
  running_ = true;
}

/// The time counts, not the messages: own announcements come back too.
void Presence::listen_until(steady_clock::time_point until) {
  for (auto now = steady_clock::now(); now < until; now = steady_clock::now()) {
    if (bus_.handle(std::chrono::ceil<std::chrono::milliseconds>(until - now)) < 0)
      throw Error("the LCM network is gone");
    if (must_give_way()) throw Error(other());
  }
}

void Presence::announce() { bus_.publish(own()); }

bool Presence::contested() const {
  const std::lock_guard lock(other_->mutex);
  return running_ && other_->heard && other_->last.running;
}

bool Presence::outranked() const {
  const std::lock_guard lock(other_->mutex);
  return running_ && other_->heard && other_->last.running && other_->last.instance < instance_;
}

std::string Presence::other() const {
  const std::lock_guard lock(other_->mutex);
  return "a second " + role_ + " of robot " + other_->robot + " is on the network (process " +
         std::to_string(other_->last.pid) + ")";
}

presence_t Presence::own() const {
  presence_t message{};
  message.utime = microseconds_of_the_system();
  message.role = role_;
  message.instance = instance_;
  message.pid = ::getpid();
  message.running = running_;
  return message;
}

bool Presence::must_give_way() const {
  const std::lock_guard lock(other_->mutex);
  return other_->heard && (other_->last.running || other_->last.instance < instance_);
}

}  // namespace saker::flight
