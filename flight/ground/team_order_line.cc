#include "flight/ground/team_order_line.h"

namespace saker::flight::ground {

std::int64_t TeamOrderLine::send(const std::string& robot, const std::string& kind,
                                 Steady::time_point now) {
  return sender_.send(robot, autonomy::order_kind_of(kind).value(), now);  // the desk looked at it
}

OrderLine::Progress TeamOrderLine::progress(std::int64_t id) const {
  using Sent = OrderSender::State;
  const OrderSender::Progress progress = sender_.progress(id);
  switch (progress.state) {
    case Sent::sending:
    case Sent::waiting:
      return {State::sent, progress.text};
    case Sent::accepted:
      return {State::acknowledged, progress.text};
    case Sent::refused:
    case Sent::overtaken:
      return {State::refused, progress.text};
    case Sent::unanswered:
      break;
  }
  return {State::silent, progress.text};
}

}  // namespace saker::flight::ground
