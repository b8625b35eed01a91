#include "flight/ground/hub.h"

#include <cmath>

#include "flight/viewers/schema_parts.h"

namespace saker::flight::ground {
namespace {

namespace schema = viewers::schema;

constexpr std::size_t kMostHistory = 240;  // messages in one answer

const std::string& history_request() {
  static const std::string text =
      schema::object({{"topic", schema::text()}, {"seconds", schema::number("s")}}).dump();
  return text;
}

const std::string& history_response() {
  const Json message =
      schema::object({{"t_s", schema::number("s")}, {"message", schema::object({})}});
  static const std::string text =
      schema::object({{"topic", schema::text()}, {"messages", schema::list(message)}}).dump();
  return text;
}

}  // namespace

Hub::Hub(ServerInfo info, const SessionLimits& limits) : info_(std::move(info)), limits_(limits) {
  add_service("history", history_request(), history_response(),
              [this](const Json& request, const std::string&, const Reply& reply) {
                serve_history(request, reply);
              });
}

void Hub::wake() const {
  if (wake_) wake_();
}

std::uint64_t Hub::add_channel(const std::string& topic, const std::string& schema_name,
                               const std::string& schema, int kept, bool at_once) {
  std::uint64_t id = 0;
  {
    const std::lock_guard lock(mutex_);
    id = channels_.size() + 1;
    ChannelState& state = channels_[id];
    state.channel = {id, topic, schema_name, schema};
    state.kept = static_cast<std::size_t>(std::max(kept, 1));
    state.at_once = at_once;
    const std::string text = advertise({state.channel});
    for (auto& [session_id, session] : sessions_) session.answer(text, false, Steady::now());
  }
  wake();
  return id;
}

void Hub::publish(std::uint64_t channel, Time time, std::string json) {
  const auto text = std::make_shared<const std::string>(std::move(json));
  {
    const std::lock_guard lock(mutex_);
    ChannelState& state = channels_.at(channel);
    state.messages.push_back({time, text});
    state.bytes += text->size();
    while (state.messages.size() > state.kept ||
           (state.bytes > kMostKeptBytes && state.messages.size() > 1)) {
      state.bytes -= state.messages.front().json->size();
      state.messages.pop_front();
    }
    if (state.wanted == 0) return;
    const auto now = Steady::now();
    for (auto& [id, session] : sessions_) session.offer(channel, time, text, now);
  }
  wake();
}

void Hub::tell_time(Time time) {
  {
    const std::lock_guard lock(mutex_);
    time_ = time;
    for (auto& [id, session] : sessions_) session.tell_time(time, Steady::now());
  }
  wake();
}

void Hub::tell_playback(PlaybackStatus status, Time now, double speed, bool did_seek,
                        const std::string& request) {
  {
    const std::lock_guard lock(mutex_);
    for (auto& [id, session] : sessions_) {
      if (session.sdk())
        session.answer(playback_state(status, now, speed, did_seek, request), true, Steady::now());
    }
  }
  wake();
}

void Hub::forget() {
  const std::lock_guard lock(mutex_);
  for (auto& [id, state] : channels_) {
    state.messages.clear();
    state.bytes = 0;
  }
}

bool Hub::wanted(std::uint64_t channel) const {
  const std::lock_guard lock(mutex_);
  const auto at = channels_.find(channel);
  return at != channels_.end() && at->second.wanted > 0;
}

void Hub::add_service(const std::string& name, const std::string& request_schema,
                      const std::string& response_schema, Serve serve) {
  const auto id = static_cast<std::uint32_t>(services_.size() + 1);
  services_.push_back({{id, name, request_schema, response_schema}, std::move(serve)});
}

Hub::SessionId Hub::open(const std::string& from, bool sdk, Steady::time_point now) {
  const std::lock_guard lock(mutex_);
  ++counters_.opened;
  const SessionId id = ++last_session_;
  greet(sessions_.try_emplace(id, from, sdk, limits_).first->second, now);
  return id;
}

void Hub::greet(Session& session, Steady::time_point now) {
  session.answer(server_info(info_), false, now);
  std::vector<Channel> channels;
  for (const auto& [id, state] : channels_) channels.push_back(state.channel);
  session.answer(advertise(channels), false, now);
  std::vector<Service> services;
  for (const ServiceState& state : services_) services.push_back(state.service);
  session.answer(advertise_services(services), false, now);
  if (time_) session.tell_time(*time_, now);
}

void Hub::close(SessionId session) {
  const std::lock_guard lock(mutex_);
  const auto at = sessions_.find(session);
  if (at == sessions_.end()) return;
  for (const auto& [channel, id] : at->second.subscriptions()) --channels_.at(channel).wanted;
  counters_.dropped += at->second.dropped();
  ++counters_.closed;
  stuck_.erase(session);
  sessions_.erase(at);
}

bool Hub::has_room(SessionId id) {
  const std::lock_guard lock(mutex_);
  const auto at = sessions_.find(id);
  if (at == sessions_.end()) return false;
  if (at->second.is_full()) count_stuck(id);
  return !at->second.is_full();
}

/// Once, however long it takes until it is closed.
void Hub::count_stuck(SessionId id) {
  if (stuck_.insert(id).second) ++counters_.stuck;
}

bool Hub::hear(SessionId id, std::span<const std::uint8_t> bytes, bool binary,
               Steady::time_point now) {
  if (!has_room(id)) return false;
  const ClientMessage message = parse_client_message(bytes, binary);
  if (const auto* service_call = std::get_if<ServiceCall>(&message)) {
    call(id, *service_call);
    return true;
  }
  if (const auto* control = std::get_if<PlaybackControl>(&message)) {
    if (playback_) playback_(*control);
    return true;
  }
  const std::lock_guard lock(mutex_);
  const auto at = sessions_.find(id);
  if (at == sessions_.end()) return false;
  if (std::holds_alternative<Garbage>(message)) {
    ++counters_.garbage;
    return false;
  }
  if (const auto* subscribe = std::get_if<Subscribe>(&message)) take(at->second, *subscribe, now);
  if (const auto* unsubscribe = std::get_if<Unsubscribe>(&message)) take(at->second, *unsubscribe);
  if (const auto* other = std::get_if<NotOffered>(&message))
    at->second.answer(status(1, other->what + " is not offered here"), false, now);
  return true;
}

void Hub::take(Session& session, const Subscribe& message, Steady::time_point now) {
  for (const Subscription& subscription : message.subscriptions) {
    const auto at = channels_.find(subscription.channel);
    if (at == channels_.end() || !session.subscribe(subscription)) {
      session.answer(status(2, "no such channel, or it or its id is subscribed to already"), false,
                     now);
      continue;
    }
    ChannelState& state = at->second;
    ++state.wanted;
    const std::size_t first =
        state.at_once || state.messages.empty() ? 0 : state.messages.size() - 1;
    for (std::size_t i = first; i < state.messages.size(); ++i)
      session.offer(at->first, state.messages[i].time, state.messages[i].json, now);
  }
}

void Hub::take(Session& session, const Unsubscribe& message) {
  for (const std::uint32_t id : message.ids) {
    if (const auto channel = session.unsubscribe(id)) --channels_.at(*channel).wanted;
  }
}

void Hub::call(SessionId id, const ServiceCall& message) {
  std::string from;
  {
    const std::lock_guard lock(mutex_);
    ++counters_.calls;
    const auto at = sessions_.find(id);
    if (at == sessions_.end()) return;
    from = at->second.from();
  }
  const auto answer = [this, id, message](const Answer& a) { reply(id, message, a); };
  if (message.service == 0 || message.service > services_.size())
    return answer({false, "no such service"});
  if (message.encoding != "json") return answer({false, "expected the encoding json"});
  const Json request = Json::parse(message.payload, nullptr, false);
  if (!request.is_object()) return answer({false, "expected a JSON object"});
  services_[message.service - 1].serve(request, from, answer);
}

void Hub::reply(SessionId id, const ServiceCall& message, const Answer& answer) {
  {
    const std::lock_guard lock(mutex_);
    const auto at = sessions_.find(id);
    if (at == sessions_.end()) return;
    const bool done = answer.done;
    at->second.answer(done ? service_response(message.service, message.call, answer.text)
                           : service_failure(message.service, message.call, answer.text),
                      done, Steady::now());
  }
  wake();
}

void Hub::serve_history(const Json& request, const Reply& reply) const {
  const auto topic = request.find("topic");
  const auto seconds = request.find("seconds");
  if (topic == request.end() || !topic->is_string() || seconds == request.end() ||
      !seconds->is_number())
    return reply({false, R"(expected {"topic": "/R1/objects", "seconds": 60})"});
  const auto list = history(topic->get<std::string>(), seconds->get<double>());
  if (!list) return reply({false, "no such topic: " + topic->get<std::string>()});
  reply({true, R"({"topic":)" + topic->dump() + R"(,"messages":[)" + *list + "]}"});
}

/// A reply locks: it is given by who asked, when this has ended.
std::optional<std::string> Hub::history(const std::string& topic, double seconds) const {
  const std::lock_guard lock(mutex_);
  const ChannelState* found = nullptr;
  for (const auto& [id, state] : channels_) {
    if (state.channel.topic == topic) found = &state;
  }
  if (found == nullptr) return std::nullopt;
  std::string list;
  const double span_ns = std::min(std::max(seconds, 0.0), 1e9) * 1e9;
  const Time newest = found->messages.empty() ? 0 : found->messages.back().time;
  const std::size_t count = found->messages.size();
  for (std::size_t i = count > kMostHistory ? count - kMostHistory : 0; i < count; ++i) {
    const Kept& kept = found->messages[i];
    if (static_cast<double>(newest - kept.time) > span_ns) continue;
    if (!list.empty()) list += ',';
    list += R"({"t_s":)" + Json(to_seconds(kept.time)).dump() + R"(,"message":)" + *kept.json + '}';
  }
  return list;
}

std::optional<Session::Outgoing> Hub::take(SessionId session, Steady::time_point now) {
  const std::lock_guard lock(mutex_);
  const auto at = sessions_.find(session);
  return at == sessions_.end() ? std::nullopt : at->second.take(now);
}

std::vector<Hub::SessionId> Hub::with_output() const {
  const std::lock_guard lock(mutex_);
  std::vector<SessionId> result;
  for (const auto& [id, session] : sessions_) {
    if (session.has_output()) result.push_back(id);
  }
  return result;
}

std::vector<Hub::SessionId> Hub::stuck(Steady::time_point now) {
  const std::lock_guard lock(mutex_);
  std::vector<SessionId> result;
  for (auto& [id, session] : sessions_) {
    if (session.is_stuck(now)) {
      result.push_back(id);
      count_stuck(id);
    } else {
      session.tell_drops(now);
    }
  }
  return result;
}

std::size_t Hub::sessions() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

Hub::Counters Hub::counters() const {
  const std::lock_guard lock(mutex_);
  Counters result = counters_;
  for (const auto& [id, session] : sessions_) result.dropped += session.dropped();
  return result;
}

}  // namespace saker::flight::ground
