#include "flight/ground/order_desk.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>

#include "flight/bus/channels.h"
#include "flight/viewers/json_value.h"
#include "flight/viewers/schema_parts.h"

namespace saker::flight::ground {
namespace {

namespace schema = viewers::schema;

constexpr std::array kKinds = {"hold", "resume", "return", "land", "abort"};

const char* word(OrderLine::State state) {
  constexpr const char* kWords[] = {"sent", "acknowledged", "refused", "silent"};
  return kWords[static_cast<int>(state)];
}

std::string text_at(const Json& request, const char* key) {
  const auto at = request.find(key);
  return at != request.end() && at->is_string() ? at->get<std::string>() : std::string();
}

}  // namespace

OrderDesk::OrderDesk(std::unique_ptr<OrderLine> line, std::filesystem::path log)
    : line_(std::move(line)), log_(std::move(log)) {}

void OrderDesk::offer_to(Hub& hub) {
  const Json request = schema::object(
      {{"robot", schema::text()}, {"kind", schema::text("hold, resume, return, land or abort")}});
  const Json response = schema::object({{"id", schema::integer()},
                                        {"state", schema::text()},
                                        {"text", schema::text()},
                                        {"took_s", schema::number("s")}});
  hub.add_service("order", request.dump(), response.dump(),
                  [this](const Json& asked, const std::string& from, Hub::Reply reply) {
                    take(asked, from, std::move(reply));
                  });
}

void OrderDesk::take(const Json& request, const std::string& from, Hub::Reply reply) {
  static const std::regex robots(kAnyRobot);
  Wanted wanted{.robot = text_at(request, "robot"),
                .kind = text_at(request, "kind"),
                .by = from,
                .reply = std::move(reply)};
  if (!std::regex_match(wanted.robot, robots))
    return wanted.reply({false, "robot: expected a name like R1"});
  if (std::ranges::find(kKinds, wanted.kind) == kKinds.end())
    return wanted.reply({false, "kind: expected hold, resume, return, land or abort"});
  const std::lock_guard lock(mutex_);
  if (wanted_.size() >= kMostWaiting) return wanted.reply({false, "too many orders at once"});
  wanted_.push_back(std::move(wanted));
}

Json OrderDesk::order_json(const Open& open, double t, const OrderLine::Progress& progress) const {
  return {{"id", open.id},
          {"t_s", viewers::rounded(t)},
          {"robot", open.wanted.robot},
          {"kind", open.wanted.kind},
          {"by", open.wanted.by},
          {"state", word(progress.state)},
          {"text", progress.text},
          {"took_s", viewers::rounded(t - open.begun)}};
}

void OrderDesk::note(const Json& order) {
  const std::string line = order.dump(-1, ' ', false, Json::error_handler_t::replace);
  spdlog::info("order: {}", line);
  if (log_.empty()) return;
  std::error_code failed;  // is seen by what is written then
  if (log_.has_parent_path()) std::filesystem::create_directories(log_.parent_path(), failed);
  std::ofstream file(log_, std::ios::app);
  file << line << '\n';
  if (!file) spdlog::warn("cannot write {}", log_.string());
}

void OrderDesk::hear(const std::string& robot, const mission_t& message) {
  if (line_) line_->hear(robot, message);
}

void OrderDesk::step(double t, OrderLine::Steady::time_point now, const Say& say) {
  std::deque<Wanted> fresh;
  {
    const std::lock_guard lock(mutex_);
    fresh.swap(wanted_);
  }
  for (Wanted& wanted : fresh) {
    Open open{.wanted = std::move(wanted), .id = 0, .begun = t};
    if (!line_) {
      const OrderLine::Progress none{OrderLine::State::refused,
                                     "this ground sends no orders: it has no key of the team"};
      const Json json = order_json(open, t, none);
      note(json);
      say(open.wanted.robot, json);
      open.wanted.reply({true, json.dump()});
      continue;
    }
    open.id = line_->send(open.wanted.robot, open.wanted.kind, now);
    const Json json = order_json(open, t, {OrderLine::State::sent, ""});
    note(json);
    say(open.wanted.robot, json);
    open_.push_back(std::move(open));
  }
  if (line_) line_->step(now);
  std::erase_if(open_, [&](const Open& open) {
    const OrderLine::Progress progress = line_->progress(open.id);
    if (progress.state == OrderLine::State::sent) return false;
    const Json json = order_json(open, t, progress);
    note(json);
    say(open.wanted.robot, json);
    open.wanted.reply({true, json.dump(-1, ' ', false, Json::error_handler_t::replace)});
    return true;
  });
}

}  // namespace saker::flight::ground
