#include "flight/bus/priority.h"

namespace saker::flight {

std::string take_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0) return "";
  return "no real-time priority (limit rtprio); it may be late";
}

RaisedPriority::RaisedPriority(int priority) {
  pthread_getschedparam(pthread_self(), &policy_, &parameters_);
  granted_ = take_priority(priority).empty();
}

RaisedPriority::~RaisedPriority() {
  if (granted_) pthread_setschedparam(pthread_self(), policy_, &parameters_);
}

}  // namespace saker::flight
