#include "tools/saker/mission/team_link.h"

#include <map>
#include <utility>

#include "saker/exchange/seal.h"

namespace saker::tools {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;  // the rate at which peers are asked

class Link {
 public:
  Link(const LinkConfig& config, exchange::Store& robot, exchange::Store& base, core::Rng rng)
      : config_(config),
        robot_(robot),
        base_(base),
        calling_(config.peer, exchange::Role::calls, robot),
        answering_(config.peer, exchange::Role::answers, base),
        rng_(std::move(rng)) {}

  ContactFigures run() {
    const Time end = from_seconds(config_.longest_contact_s);
    for (now_ = kStep; now_ <= end && !figures_.complete; now_ += kStep) {
      deliver();
      send(calling_, answering_);
      send(answering_, calling_);
      figures_.complete = settled();
    }
    figures_.seconds = to_seconds(now_);
    return figures_;
  }

 private:
  struct OnItsWay {
    exchange::Peer* to;
    std::string message;
  };

  void deliver() {
    while (!air_.empty() && air_.begin()->first <= now_) {
      const OnItsWay next = std::move(air_.extract(air_.begin()).mapped());
      next.to->receive(now_, next.message);
    }
  }

  void send(exchange::Peer& from, exchange::Peer& to) {
    while (const auto message = from.next(now_, exchange::kSealBytes)) {
      ++figures_.datagrams;
      figures_.bytes += static_cast<long>(message->size() + exchange::kSealBytes);
      if (rng_.chance(config_.loss)) {
        ++figures_.lost;
        continue;
      }
      const int copies = rng_.chance(config_.duplication) ? 2 : 1;
      for (int i = 0; i < copies; ++i) air_.emplace(now_ + delay(), OnItsWay{&to, *message});
    }
  }

  Time delay() {
    return from_seconds(rng_.uniform(config_.shortest_delay_s, config_.longest_delay_s));
  }

  bool settled() const {
    return robot_.extents() == base_.extents() && calling_.in_contact(now_) &&
           answering_.in_contact(now_) && calling_.all_sent() && answering_.all_sent();
  }

  LinkConfig config_;
  exchange::Store& robot_;
  exchange::Store& base_;
  exchange::Peer calling_;
  exchange::Peer answering_;
  core::Rng rng_;
  std::multimap<Time, OnItsWay> air_;
  Time now_ = 0;
  ContactFigures figures_;
};

}  // namespace

ContactFigures exchange_at_base(const LinkConfig& config, exchange::Store& robot,
                                exchange::Store& base, core::Rng rng) {
  return Link(config, robot, base, std::move(rng)).run();
}

}  // namespace saker::tools
