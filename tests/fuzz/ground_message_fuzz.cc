#include <cstdlib>

#include "flight/ground/session.h"
#include "fuzz.h"

/// What clients of saker-ground send: the first byte says how many bytes the first message has and
/// whether it is binary; what follows is cut alike, so that one input is a whole conversation.
namespace saker::lidar {
namespace {

using namespace flight::ground;

void expect(bool right) {
  if (!right) std::abort();
}

class Conversation {
 public:
  void hear(ByteView message, bool binary) {
    const ClientMessage heard = parse_client_message(message, binary);
    if (const auto* garbage = std::get_if<Garbage>(&heard)) {
      expect(!garbage->why.empty() && garbage->why.find('\n') == std::string::npos);
    } else if (const auto* subscribe = std::get_if<Subscribe>(&heard)) {
      for (const Subscription& one : subscribe->subscriptions) session_.subscribe(one);
    } else if (const auto* unsubscribe = std::get_if<Unsubscribe>(&heard)) {
      for (const std::uint32_t id : unsubscribe->ids) session_.unsubscribe(id);
    } else if (const auto* call = std::get_if<ServiceCall>(&heard)) {
      expect(call->encoding.size() + call->payload.size() < message.size());
      session_.answer(service_response(call->service, call->call, call->payload), true, {});
      session_.answer(service_failure(call->service, call->call, call->payload), false, {});
    } else if (const auto* other = std::get_if<NotOffered>(&heard)) {
      session_.answer(status(1, other->what), false, {});
    }
    for (const auto& [channel, id] : session_.subscriptions()) {
      session_.offer(channel, 0, text_, {});
      expect(session_.waiting_bytes() <= (std::size_t{32} << 20));
    }
    while (session_.take({})) {
    }
    expect(!session_.has_output() && session_.waiting_bytes() == 0);
  }

 private:
  Session session_{"fuzz", false};
  Text text_ = std::make_shared<const std::string>("{}");
};

}  // namespace

void fuzz::run(ByteView input) {
  Conversation conversation;
  while (!input.empty()) {
    const bool binary = (input[0] & 1) != 0;
    const std::size_t size = input[0] < 254 ? input[0] / 2 : input.size() - 1;
    input = input.subspan(1);
    const std::size_t cut = std::min(size, input.size());
    conversation.hear(input.subspan(0, cut), binary);
    input = input.subspan(cut);
  }
}

}  // namespace saker::lidar
