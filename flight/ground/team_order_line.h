#pragma once

#include <filesystem>

#include "flight/ground/order_desk.h"
#include "flight/orders/order_sender.h"

namespace saker::flight::ground {

/// Orders sealed by the team's key, as `saker order` sends them (flight/orders/order_sender.h).
class TeamOrderLine : public OrderLine {
 public:
  /// \param bus  has to outlive what is sent by this
  /// \param name  under which this process seals; \param folder  where its counter is kept
  /// Throws Error where the folder cannot be used.
  TeamOrderLine(Bus& bus, const exchange::Key& key, const std::string& name,
                const std::filesystem::path& folder)
      : sender_({}, bus, key, name, folder) {}

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
