#include "flight/ground/run_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flight/viewers/json_value.h"
#include "flight/viewers/schema_parts.h"

namespace saker::flight::ground {
namespace {

namespace schema = viewers::schema;

constexpr double kSlowest = 0.1, kFastest = 100;
constexpr double kSay_s = 0.2;  // between two words of where it is

}  // namespace

RunSource::RunSource(viewers::Run& run, const viewers::Site& site, Hub& hub)
    : run_(run),
      views_(std::make_shared<const viewers::Site>(site), std::numeric_limits<double>::infinity()),
      hub_(hub),
      publisher_(hub, nullptr, false) {
  state_ = {.t_s = run.end_s(), .begin_s = run.begin_s(), .end_s = run.end_s()};
  channel_ = hub.add_channel(viewers::kPlaybackTopic, viewers::kPlaybackSchema,
                             viewers::playback_schema(), 1, false);
  run_.advance(run.end_s(), views_);
  publisher_.publish_due(views_, run.end_s());
  say(false, "");
}

void RunSource::offer() {
  const Json play =
      schema::object({{"playing", schema::flag()}, {"speed?", schema::number("0.1 … 100")}});
  const Json seek = schema::object({{"t_s", schema::number("s, the recording's clock")}});
  hub_.add_service("play", play.dump(), viewers::playback_schema(),
                   [this](const Json& request, const std::string&, Hub::Reply reply) {
                     ask_play(request, std::move(reply));
                   });
  hub_.add_service("seek", seek.dump(), viewers::playback_schema(),
                   [this](const Json& request, const std::string&, Hub::Reply reply) {
                     ask_seek(request, std::move(reply));
                   });
  hub_.on_playback([this](const PlaybackControl& control) {
    Wish wish{.playing = control.playing,
              .speed = control.speed,
              .seek = {},
              .reply = {},
              .request = control.request};
    if (control.seek) wish.seek = to_seconds(*control.seek);
    ask(std::move(wish));
  });
}

void RunSource::ask(Wish wish) {
  const std::lock_guard lock(mutex_);
  if (wishes_.size() < kMostWishes) return wishes_.push_back(std::move(wish));
  if (wish.reply) wish.reply({false, "too much was asked at once"});
}

void RunSource::ask_play(const Json& request, Hub::Reply reply) {
  const auto playing = request.find("playing"), speed = request.find("speed");
  const bool fine = playing != request.end() && playing->is_boolean() &&
                    (speed == request.end() || speed->is_number());
  if (!fine) return reply({false, R"(expected {"playing": true, "speed": 1})"});
  Wish wish{.playing = playing->get<bool>(),
            .speed = {},
            .seek = {},
            .reply = std::move(reply),
            .request = {}};
  if (speed != request.end()) wish.speed = speed->get<double>();
  ask(std::move(wish));
}

void RunSource::ask_seek(const Json& request, Hub::Reply reply) {
  const auto t = request.find("t_s");
  if (t == request.end() || !t->is_number()) return reply({false, R"(expected {"t_s": 12.5})"});
  ask({.playing = {},
       .speed = {},
       .seek = t->get<double>(),
       .reply = std::move(reply),
       .request = {}});
}

RunSource::State RunSource::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Json RunSource::state_json() const {
  const State now = state();
  return {{"playing", now.playing},
          {"speed", viewers::rounded(now.speed)},
          {"t_s", viewers::rounded(now.t_s)},
          {"begin_s", viewers::rounded(now.begin_s)},
          {"end_s", viewers::rounded(now.end_s)}};
}

void RunSource::jump(double t) {
  const State before = state();
  if (t < before.t_s) run_.rewind(views_);
  run_.advance(t, views_);
  hub_.forget();
  for (auto& [robot, view] : views_.all()) view.say_again();
  const std::lock_guard lock(mutex_);
  state_.t_s = t;
}

void RunSource::fulfil(const Wish& wish) {
  if (wish.seek) jump(std::clamp(*wish.seek, state().begin_s, state().end_s));
  // From its end it plays from its beginning.
  const State now = state();
  if (wish.playing.value_or(false) && !now.playing && !wish.seek && now.t_s >= now.end_s)
    jump(now.begin_s);
  {
    const std::lock_guard lock(mutex_);
    if (wish.playing) state_.playing = *wish.playing;
    if (wish.speed && std::isfinite(*wish.speed))
      state_.speed = std::clamp(*wish.speed, kSlowest, kFastest);
  }
  if (wish.reply) wish.reply({true, state_json().dump()});
  say(wish.seek.has_value(), wish.request);
}

void RunSource::say(bool jumped, const std::string& request) {
  const State now = state();
  const Time time = viewers_time(now.t_s);
  hub_.publish(channel_, time, state_json().dump());
  hub_.tell_time(time);
  const bool ended = !now.playing && now.t_s >= now.end_s;
  if (jumped || !request.empty() || (ended && !said_ended_))
    hub_.tell_playback(now.playing ? PlaybackStatus::playing
                                   : (ended ? PlaybackStatus::ended : PlaybackStatus::paused),
                       time, now.speed, jumped, request);
  said_ended_ = ended;
  since_said_s_ = 0;
}

void RunSource::step(double passed_s) {
  views_.want_bulk(publisher_.wanted(viewers::Topic::points),
                   publisher_.wanted(viewers::Topic::occupancy));
  std::vector<Wish> wishes;
  {
    const std::lock_guard lock(mutex_);
    wishes.swap(wishes_);
  }
  for (const Wish& wish : wishes) fulfil(wish);
  const State before = state();
  if (before.playing) {
    const double t = std::min(before.t_s + passed_s * before.speed, before.end_s);
    run_.advance(t, views_);
    const std::lock_guard lock(mutex_);
    state_.t_s = t;
    state_.playing = t < before.end_s;
  }
  publisher_.publish_due(views_, state().t_s);
  since_said_s_ += passed_s;
  const bool ended = before.playing && !state().playing;
  if (since_said_s_ >= kSay_s || ended) say(false, "");
}

}  // namespace saker::flight::ground
