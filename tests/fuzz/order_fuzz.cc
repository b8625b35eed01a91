#include "flight/bus/channels.h"
#include "flight/orders/order_messages.h"
#include "fuzz.h"

/// What somebody with the key could seal for an order, and an order that nobody sealed.
namespace saker {
namespace {

/// What is there is not taken for a window.
std::filesystem::path new_file() {
  std::filesystem::path file = lidar::fuzz::file_of({}, ".window");
  std::filesystem::remove(file);
  return file;
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  using namespace flight;
  constexpr std::int64_t kNow_us = 1'000'000'000;
  static const exchange::Key team{};
  static const std::string channel = channel_name<order_t>("R1");
  static exchange::Sealer sealer(exchange::key_of(team, "R1").value(), "GROUND", "");
  static exchange::Opener opener(team, "R1", new_file());
  const auto as_order = [](std::string_view bytes) {
    order_t message{};
    message.data.assign(bytes.begin(), bytes.end());
    message.num_data = static_cast<std::int32_t>(message.data.size());
    return message;
  };
  expect(opened(opener, "R1", as_order(text_of(input)), kNow_us, 0, 5).verdict ==
         OrderVerdict::forged);
  const auto bytes = sealer.seal(channel, text_of(input));
  if (!bytes) return;
  const OpenedOrder order = opened(opener, "R1", as_order(*bytes), kNow_us, 0, 5);
  expect(order.verdict != OrderVerdict::forged && order.verdict != OrderVerdict::replayed);
  if (order.verdict == OrderVerdict::genuine) {
    expect(to_string(order.order.kind) != nullptr && order.age_s <= 5);
  }
  expect(opened(opener, "R1", as_order(*bytes), kNow_us, 0, 5).verdict == OrderVerdict::replayed);
}

}  // namespace saker
