#pragma once

#include <optional>
#include <span>
#include <string>

#include "saker/core/config.h"
#include "saker/core/vehicle.h"

namespace saker::autonomy {

struct CommandConfig {
  double repeat_s = 0.2;
  double deadline_s = 3.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("repeat_s", repeat_s, {0.02, 5}, "s", "until it is acknowledged: messages get lost");
    v.field("deadline_s", deadline_s, {0.1, 60}, "s", "for the acknowledgement");
  }
};

enum class CommandProgress { none, waiting, accepted, refused, expired };

/// One command at a time: sent again with the same id until it is acknowledged, or its deadline
/// passes.
class CommandSender {
 public:
  explicit CommandSender(const CommandConfig& config) : config_(config) {}

  /// Replaces what was under way.
  void issue(CommandKind kind, double height_m, Time now);

  /// Nothing is under way any more.
  void cancel() { progress_ = CommandProgress::none; }

  /// Takes acknowledgements in; gives what is to be sent now.
  [[nodiscard]] std::optional<Command> step(Time now, std::span<const CommandAck> acks);

  [[nodiscard]] CommandProgress progress() const { return progress_; }
  [[nodiscard]] CommandKind kind() const { return command_.kind; }
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< of the refusal

 private:
  CommandConfig config_;
  Command command_;
  CommandProgress progress_ = CommandProgress::none;
  std::string reason_;
  Time issued_ = 0;
  Time sent_ = 0;
};

}  // namespace saker::autonomy
