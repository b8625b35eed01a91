#include "flight/orders/order_sender.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

/// Two processes of one name and folder that begin at once do not begin the same epoch.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& file)
      : file_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX) != 0) {
      throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
    }
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& name,
                              const char* ending) {
  return folder / ("order-" + name + ending);
}

OrderSender::State state_of(autonomy::OrderState state) {
  switch (state) {
    case autonomy::OrderState::waiting:
      return OrderSender::State::waiting;
    case autonomy::OrderState::accepted:
      return OrderSender::State::accepted;
    case autonomy::OrderState::refused:
      break;
  }
  return OrderSender::State::refused;
}

}  // namespace

SenderFiles sender_files(const std::filesystem::path& key, const std::filesystem::path& folder,
                         const InstalledBase& installed) {
  std::error_code hidden;
  SenderFiles files{key, folder};
  if (!std::filesystem::exists(key, hidden) && std::filesystem::exists(installed.key, hidden))
    files.key = installed.key;
  if (!folder.empty()) return files;
  files.folder = files.key == installed.key ? installed.folder : files.key.parent_path();
  if (files.folder.empty()) files.folder = ".";
  return files;
}

bool is_over(OrderSender::State state) {
  return state != OrderSender::State::sending && state != OrderSender::State::waiting;
}

OrderSender::OrderSender(const OrderSenderConfig& config, Bus& bus, std::filesystem::path key_file,
                         const std::string& name, const std::filesystem::path& folder)
    : config_(config), bus_(bus), key_file_(std::move(key_file)), name_(name), folder_(folder) {
  if (!exchange::is_name(name)) {
    throw Error(fmt::format("name of a sender {}, expected up to {} capitals and digits", name,
                            exchange::kLongestName));
  }
  begin_life();
}

OrderSender::KeyFile OrderSender::key_there() const {
  struct stat there {};
  if (::stat(key_file_.c_str(), &there) != 0) return {};
  return {static_cast<std::int64_t>(there.st_ino), there.st_mtim.tv_sec, there.st_mtim.tv_nsec};
}

/// With the key that is there now, and a later epoch than any before.
void OrderSender::begin_life() {
  const KeyFile there = key_there();
  const exchange::Key key = exchange::read_key(key_file_);
  const FolderLock lock(file_of(folder_, name_, ".lock"));
  sealer_ = std::make_unique<exchange::Sealer>(key, name_, file_of(folder_, name_, ".epoch"));
  key_read_ = there;
  superseded_ = false;
}

void OrderSender::renew_life() {
  if (!superseded_ && key_there() == key_read_) return;
  try {
    begin_life();
  } catch (const Error&) {  // a key that is not there now: by the one before, while it holds
  }
}

std::int64_t OrderSender::send(const std::string& robot, autonomy::OrderKind kind,
                               Steady::time_point now) {
  renew_life();
  last_id_ = std::max(system_utime(), last_id_ + 1);
  for (auto& [id, earlier] : sent_) {
    if (earlier.robot == robot && !is_over(earlier.progress.state))
      earlier.progress = {State::overtaken, "a later order took its place"};
  }
  if (sent_.size() == kMost) sent_.erase(sent_.begin());
  Sent& sent = sent_[last_id_];
  sent = {robot, {last_id_, kind}, {State::sending, ""}, now, now};
  publish(sent, now);
  return last_id_;
}

void OrderSender::publish(Sent& sent, Steady::time_point now) {
  sent.again = now + config_.repeat;
  const auto message = sealed(*sealer_, sent.robot, sent.order, system_utime());
  if (!message) {
    sent.progress = {State::unanswered, "it cannot be sealed: this is the key of another robot"};
  } else if (!bus_.publish_as(sent.robot, *message)) {
    sent.progress.text = "the network does not take it";
  }
}

void OrderSender::hear(const std::string& robot, const mission_t& message) {
  auto reply = reply_of(message);
  if (!reply) return;
  const auto found = sent_.find(reply->order.id);
  if (found == sent_.end() || found->second.robot != robot) return;
  Sent& sent = found->second;
  if (reply->order != sent.order || is_over(sent.progress.state)) return;
  sent.progress = {state_of(reply->state), std::move(reply->text)};
}

void OrderSender::hear(const std::string& robot, const order_t& message) {
  const std::string_view bytes(reinterpret_cast<const char*>(message.data.data()),
                               message.data.size());
  const exchange::Opened other = sealer_->opened(channel_name<order_t>(robot), bytes);
  if (other.verdict != exchange::Verdict::genuine || other.sender != name_) return;
  if (other.epoch <= sealer_->epoch()) return;
  superseded_ = true;
  for (auto& [id, sent] : sent_) {
    if (sent.robot != robot || is_over(sent.progress.state)) continue;
    sent.progress = {State::overtaken, fmt::format("another process orders as {}: give each a name "
                                                   "of its own",
                                                   name_)};
  }
}

void OrderSender::step(Steady::time_point now) {
  for (auto& [id, sent] : sent_) {
    if (is_over(sent.progress.state)) continue;
    if (now - sent.begun >= config_.deadline) {
      sent.progress.state = State::unanswered;
      if (sent.progress.text.empty()) sent.progress.text = "nothing is heard of it";
    } else if (now >= sent.again) {
      publish(sent, now);
    }
  }
}

OrderSender::Progress OrderSender::progress(std::int64_t id) const {
  const auto found = sent_.find(id);
  return found == sent_.end() ? Progress{} : found->second.progress;
}

}  // namespace saker::flight
