#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flight/mavlink/dialect.h"
#include "mavlink/messages.h"
#include "saker/core/vehicle.h"

/// Orders of the executive → COMMAND_LONG, with acknowledgement, time-out and retry.
///
/// One order at a time: a newer one ends it. An order is one command or two (the mode, then the
/// arming). Reads COMMAND_ACK and STATUSTEXT, which gives a refusal its cause. Times are the
/// host's.
namespace saker::flight::mavlink {

struct CommanderConfig {
  double answer_s = 0.5;   ///< without one the command is sent again …
  int most_tries = 6;      ///< … so often
  double cause_s = 0.2;    ///< after a refusal, for its text: it comes up to 10 ms later
  double again_s = 2.0;    ///< between tries of what may yet be accepted
  double patience_s = 60;  ///< for it: an autopilot that has just booted levels its sensors
};

/// A command as the autopilot knows it.
struct Step {
  std::uint16_t command = 0;
  std::array<float, 7> parameters{};
};

/// Numbers of commands and of their results, MAV_CMD and MAV_RESULT.
inline constexpr std::uint16_t kNavLand = 21, kNavTakeoff = 22, kDoSetMode = 176, kArmDisarm = 400,
                               kSetMessageInterval = 511, kRequestMessage = 512;
enum class AckResult : std::uint8_t {
  accepted = 0,
  temporarily_rejected = 1,
  denied = 2,
  unsupported = 3,
  failed = 4,
  in_progress = 5,
  cancelled = 6,
};

/// What an order is in commands. Empty: none is needed.
[[nodiscard]] std::vector<Step> steps_of(const Command& command, const Dialect& dialect);
[[nodiscard]] Step mode_step(const ModeNumber& mode);

class Commander {
 public:
  explicit Commander(const CommanderConfig& config = {}) : config_(config) {}

  /// Begins an order; one that runs is ended as overtaken. The same id again changes nothing while
  /// it runs, and is answered as before once it is done.
  void begin(std::int64_t id, std::vector<Step> steps, Time now);

  /// What to send now, if anything.
  [[nodiscard]] std::optional<CommandLong> due(Time now);

  /// An answer that is addressed to us. False where nothing was asked.
  bool hear(const CommandAck& ack, Time now);
  void hear_text(int severity, const std::string& text, Time now);

  /// The answers to orders that are done since the last call, in their order; stamps are 0.
  [[nodiscard]] std::vector<saker::CommandAck> take_done(Time now);

  [[nodiscard]] bool busy() const { return order_.has_value(); }
  /// The command that is waited for.
  [[nodiscard]] std::optional<Step> current() const;
  /// What the autopilot said last of importance; empty: nothing.
  [[nodiscard]] const std::string& last_text() const { return text_; }

 private:
  struct Order {
    std::int64_t id = 0;
    std::vector<Step> steps;
    std::size_t at = 0;  // the step
    int tries = 0;       // of this step without an answer
    Time began = 0, next_send = 0;
    std::optional<AckResult> refused;  // and its cause is waited for
    Time refused_at = 0;
  };

  void finish(bool accepted, const std::string& reason);
  void settle(Time now);
  [[nodiscard]] std::string cause(AckResult result) const;

  CommanderConfig config_;
  std::optional<Order> order_;
  std::vector<saker::CommandAck> done_;
  std::optional<saker::CommandAck> last_;
  std::string text_;
  Time text_at_ = 0;
};

}  // namespace saker::flight::mavlink
