#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "flight/orders/order_sender.h"
#include "saker/core/error.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

using flight::OrderSender;

struct OrderOptions {
  std::string robot;
  std::string order;
  std::string name = "OPERATOR";
  double wait_s = 5;
};

constexpr std::chrono::milliseconds kLook{20};  // at what the network brings

OrderSender::Progress wait_for(OrderSender& sender, flight::Bus& bus, std::int64_t id) {
  while (!is_over(sender.progress(id).state)) {
    if (bus.handle(kLook) < 0) throw Error("the LCM network is gone");
    sender.step(OrderSender::Steady::now());
  }
  return sender.progress(id);
}

const char* word(OrderSender::State state) {
  if (state == OrderSender::State::accepted) return "accepted";
  return state == OrderSender::State::refused ? "refused" : "no answer";
}

int order(const OrderOptions& options, const CommonOptions& common) {
  const auto kind = autonomy::order_kind_of(options.order);
  if (!kind) {
    throw Error(
        fmt::format("ORDER {}, expected hold, resume, return, land or abort", options.order));
  }
  const flight::ProcessConfig config = read_configuration(common);
  flight::Bus bus(config.bus, options.robot);
  flight::OrderSenderConfig timing;
  timing.deadline = std::chrono::milliseconds(static_cast<long>(1e3 * options.wait_s));
  const auto files = flight::sender_files(config.exchange.key_file, config.exchange.folder);
  OrderSender sender(timing, bus, files.key, options.name, files.folder);
  bus.subscribe<mission_t>([&](const mission_t& message) {
    sender.hear(options.robot, message);
    return true;
  });
  bus.subscribe<order_t>([&](const order_t& message) {
    sender.hear(options.robot, message);
    return true;
  });
  const std::int64_t id = sender.send(options.robot, *kind, OrderSender::Steady::now());
  const OrderSender::Progress progress = wait_for(sender, bus, id);
  fmt::print("{} {} {}: {}\n", options.robot, options.order, word(progress.state), progress.text);
  return progress.state == OrderSender::State::accepted ? 0 : 1;
}

}  // namespace

void add_order(Commands& commands) {
  auto options = std::make_shared<OrderOptions>();
  CLI::App& app = commands.add(
      {.name = "order",
       .does = "a sealed order to a robot in flight and its acknowledgement: hold, resume (also "
               "after a pilot flew), return, land (where it is), abort (down at once); status 1 "
               "when it is refused or not answered",
       .example = "saker order R1 hold"},
      [options](const CommonOptions& common) { return order(*options, common); });
  app.add_option("ROBOT", options->robot, "the robot's name")->required();
  app.add_option("ORDER", options->order, "hold, resume, return, land or abort")->required();
  app.add_option("--as", options->name,
                 "name of the sender, of its own for each who orders [OPERATOR]")
      ->type_name("NAME");
  app.add_option("--wait", options->wait_s, "for the acknowledgement [5]")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.1, 600.0));
}

}  // namespace saker::tools
