#pragma once

#include <filesystem>

#include "flight/ground/order_desk.h"
#include "flight/orders/order_sender.h"

namespace saker::flight::ground {

/// Orders sealed by the team's key, as `saker order` sends them (flight/orders/order_sender.h).
class TeamOrderLine : public OrderLine {
 public:
  /// \param bus  has to outlive what is sent by this, and is not handled after it
  /// \param name  under which this process seals; \param folder  where its epoch is kept
  /// Subscribes to the bus. Throws Error where key or folder cannot be used.
  TeamOrderLine(Bus& bus, const std::filesystem::path& key_file, const std::string& name,
                const std::filesystem::path& folder)
      : sender_({}, bus, key_file, name, folder) {
    bus.subscribe_all<order_t>([this](const std::string& robot, const order_t& message) {
      sender_.hear(robot, message);
      return true;
    });
  }

  std::int64_t send(const std::string& robot, const std::string& kind,
                    Steady::time_point now) override;
  [[nodiscard]] Progress progress(std::int64_t id) const override;
  void hear(const std::string& robot, const mission_t& message) override {
    sender_.hear(robot, message);
  }
  void step(Steady::time_point now) override { sender_.step(now); }

 private:
  OrderSender sender_;
};

}  // namespace saker::flight::ground
