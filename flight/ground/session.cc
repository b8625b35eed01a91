#include "flight/ground/session.h"

#include <algorithm>

namespace saker::flight::ground {

Session::Session(std::string from, bool sdk, const SessionLimits& limits)
    : from_(std::move(from)), sdk_(sdk), limits_(limits) {}

bool Session::subscribe(const Subscription& subscription) {
  if (by_id_.contains(subscription.id) || by_channel_.contains(subscription.channel)) return false;
  by_id_[subscription.id] = subscription.channel;
  by_channel_[subscription.channel] = subscription.id;
  return true;
}

std::optional<std::uint64_t> Session::unsubscribe(std::uint32_t id) {
  const auto at = by_id_.find(id);
  if (at == by_id_.end()) return std::nullopt;
  const std::uint64_t channel = at->second;
  by_id_.erase(at);
  by_channel_.erase(channel);
  for (std::size_t i = messages_.size(); i-- > 0;) {
    if (messages_[i].channel == channel) drop(messages_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return channel;
}

void Session::begin_wait(Steady::time_point now) {
  if (!has_output()) waits_since_ = now;
}

void Session::answer(std::string text, bool binary, Steady::time_point now) {
  begin_wait(now);
  answer_bytes_ += text.size();
  answers_.push_back({binary, {}, std::make_shared<const std::string>(std::move(text))});
}

void Session::tell_time(Time time, Steady::time_point now) {
  std::string text = time_message(time);
  const auto waits = std::ranges::find_if(answers_, [&](const Outgoing& answer) {
    return answer.binary && answer.body->size() == text.size() && answer.body->front() == text[0];
  });
  if (waits == answers_.end()) return answer(std::move(text), true, now);
  waits->body = std::make_shared<const std::string>(std::move(text));
}

void Session::drop(std::deque<Message>::iterator message) {
  bytes_ -= message->json->size();
  --waiting_[message->channel];
  messages_.erase(message);
}

void Session::offer(std::uint64_t channel, Time time, const Text& json, Steady::time_point now) {
  if (!by_channel_.contains(channel)) return;
  begin_wait(now);
  if (waiting_[channel] >= limits_.most_messages) {
    drop(std::find_if(messages_.begin(), messages_.end(),
                      [&](const Message& m) { return m.channel == channel; }));
    ++dropped_;
  }
  while (!messages_.empty() && bytes_ + json->size() > limits_.most_bytes) {
    drop(messages_.begin());
    ++dropped_;
  }
  messages_.push_back({channel, time, json});
  bytes_ += json->size();
  ++waiting_[channel];
}

std::optional<Session::Outgoing> Session::take(Steady::time_point now) {
  waits_since_ = now;
  if (!answers_.empty()) {
    Outgoing next = std::move(answers_.front());
    answers_.pop_front();
    answer_bytes_ -= next.body->size();
    return next;
  }
  if (messages_.empty()) return std::nullopt;
  const Message next = messages_.front();
  drop(messages_.begin());
  return Outgoing{true, message_head(by_channel_.at(next.channel), next.time), next.json};
}

void Session::tell_drops(Steady::time_point now) {
  if (dropped_ == told_drops_) return;
  told_drops_ = dropped_;
  answer(status(1, std::to_string(dropped_) + " messages were dropped: this connection is slow",
                "drops"),
         false, now);
}

bool Session::is_stuck(Steady::time_point now) const {
  if (is_full()) return true;
  return has_output() && now - waits_since_ > limits_.most_wait;
}

}  // namespace saker::flight::ground
