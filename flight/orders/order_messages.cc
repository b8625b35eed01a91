#include "flight/orders/order_messages.h"

#include <cmath>

#include "flight/bus/channels.h"
#include "flight/bus/fields.h"
#include "flight/bus/messages.h"
#include "saker/exchange/bytes.h"

namespace saker::flight {
namespace {

constexpr std::uint8_t kVersion = 1;
static_assert(exchange::kSealBytes + 3 + exchange::kLongestName + 16 <= order_t::MAX_DATA);

OrderVerdict verdict_of(exchange::Verdict verdict) {
  switch (verdict) {
    case exchange::Verdict::genuine:
      return OrderVerdict::genuine;
    case exchange::Verdict::replayed:
    case exchange::Verdict::superseded:
      return OrderVerdict::replayed;
    default:
      return OrderVerdict::forged;
  }
}

}  // namespace

const char* to_string(OrderVerdict verdict) {
  constexpr const char* kNames[] = {
      "genuine",
      "not sealed by the team's key for this robot",
      "heard before",
      "not an order that this version knows",
      "for another robot",
      "held back, or sealed by another clock",
      "overtaken by a later order of its sender",
  };
  return kNames[static_cast<int>(verdict)];
}

std::optional<order_t> sealed(exchange::Sealer& sealer, const std::string& robot,
                              const autonomy::Order& order, std::int64_t utime) {
  exchange::ByteWriter payload;
  payload.byte(kVersion);
  payload.text(robot);
  payload.byte(static_cast<std::uint8_t>(order.kind));
  payload.fixed(static_cast<std::uint64_t>(order.id));
  payload.fixed(static_cast<std::uint64_t>(utime));
  const auto bytes = sealer.seal(channel_name<order_t>(robot), payload.bytes());
  if (!bytes) return std::nullopt;
  order_t message{};
  message.utime = utime;
  message.data.assign(bytes->begin(), bytes->end());
  message.num_data = static_cast<std::int32_t>(message.data.size());
  return message;
}

OpenedOrder opened(exchange::Opener& opener, const std::string& robot, const order_t& message,
                   std::int64_t now_utime, std::int64_t since_utime, double most_age_s) {
  const std::string_view bytes(reinterpret_cast<const char*>(message.data.data()),
                               message.data.size());
  exchange::Opened open = opener.open(channel_name<order_t>(robot), bytes);
  OpenedOrder result{verdict_of(open.verdict), std::move(open.sender), {}, 0};
  if (result.verdict != OrderVerdict::genuine) return result;
  exchange::ByteReader in(open.payload);
  const std::uint8_t version = in.byte();
  const std::string_view name = in.text();
  const auto kind = enumerator_of(in.byte(), autonomy::OrderKind::abort);
  result.order.id = static_cast<std::int64_t>(in.fixed<std::uint64_t>());
  const auto utime = static_cast<std::int64_t>(in.fixed<std::uint64_t>());
  if (!in.done() || version != kVersion || !kind || result.order.id <= 0) {
    result.verdict = OrderVerdict::malformed;
    return result;
  }
  result.order.kind = *kind;
  result.age_s = 1e-6 * (static_cast<double>(now_utime) - static_cast<double>(utime));
  if (name != robot) {
    result.verdict = OrderVerdict::elsewhere;
  } else if (std::abs(result.age_s) > most_age_s || utime < since_utime) {
    result.verdict = OrderVerdict::late;
  }
  return result;
}

void write_reply(const autonomy::OrderReply& reply, mission_t& message) {
  message.order_id = reply.order.id;
  message.order_kind = static_cast<std::int8_t>(reply.order.kind);
  message.order_state = static_cast<std::int8_t>(reply.state);
  message.order_text = shortened(reply.text, mission_t::MAX_ORDER);
}

std::optional<autonomy::OrderReply> reply_of(const mission_t& message) {
  const auto kind = enumerator_of(message.order_kind, autonomy::OrderKind::abort);
  const auto state = enumerator_of(message.order_state, autonomy::OrderState::refused);
  if (message.order_id <= 0 || !kind || !state) return std::nullopt;
  return autonomy::OrderReply{{message.order_id, *kind}, *state, message.order_text};
}

}  // namespace saker::flight
