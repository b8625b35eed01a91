#include "saker/autonomy/command_sender.h"

namespace saker::autonomy {
namespace {

constexpr std::size_t kLongestReason = 200;  // of COMMAND_ACK: room from the first command on

}  // namespace

void CommandSender::issue(CommandKind kind, double height_m, Time now) {
  command_ = {.stamp = now, .id = command_.id + 1, .kind = kind, .height_m = height_m};
  progress_ = CommandProgress::waiting;
  reason_.clear();
  reason_.reserve(kLongestReason);
  issued_ = now;
  sent_ = 0;
}

std::optional<Command> CommandSender::step(Time now, std::span<const CommandAck> acks) {
  if (progress_ != CommandProgress::waiting) return std::nullopt;
  for (const CommandAck& ack : acks) {
    if (ack.id != command_.id) continue;
    progress_ = ack.accepted ? CommandProgress::accepted : CommandProgress::refused;
    reason_ = ack.reason;
    return std::nullopt;
  }
  if (now - issued_ > from_seconds(config_.deadline_s)) {
    progress_ = CommandProgress::expired;
    return std::nullopt;
  }
  if (sent_ != 0 && now - sent_ < from_seconds(config_.repeat_s)) return std::nullopt;
  sent_ = now;
  command_.stamp = now;
  return command_;
}

}  // namespace saker::autonomy
