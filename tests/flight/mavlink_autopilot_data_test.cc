#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "made_flight.h"
#include "mavlink_records.h"

/// The simulator's autopilot against what ArduCopter 4.6 did in its own simulator: the same script
/// at the recorded times, and the recorded answers come out in their order, their times to 20 %.
namespace saker::tools {
namespace {

using flight::mavlink::kNoRecords;
using Event = MadeFlight::Event;

constexpr double kGrid = 0.25;   // s, of streams and of the made craft's speeds
constexpr double kShare = 0.2;   // of the time since the script's last step
constexpr double kBooted = 4.5;  // s: what was said before is of no flight

/// Steps of the script; its other lines say what came of them.
const std::regex kDone("^(CMD|--|truth here|up True|ODOM STOP|QUALITY|HB STOP|BRIDGE DEAD)");

struct Record {
  std::vector<Event> script;  ///< what was done to it, as the lines say
  std::vector<Event> answers;
};

/// An answer that the model has to give; empty: another line.
std::string answer_of(const std::string& line) {
  static const std::regex ack(R"(ACK cmd (\d+) result (\d+).*)"), mode(R"(MODE (\d+).*)"),
      landed(R"(LANDED_STATE \d)"), armed("(ARMED|DISARMED) .*"),
      text(
          R"(TEXT \d (Arm: .*|Arming motors|Disarming motors|EKF Failsafe.*|GCS Failsafe|No such mode.*))");
  std::smatch m;
  if (std::regex_match(line, m, ack))
    return m[1] == "511" || m[1] == "512" ? "" : "ACK " + m[1].str() + " " + m[2].str();
  if (std::regex_match(line, m, mode)) return "MODE " + m[1].str();
  if (std::regex_match(line, m, landed)) return line;
  if (std::regex_match(line, m, armed)) return m[1];
  if (std::regex_match(line, m, text)) return "TEXT " + m[1].str();
  return "";
}

std::optional<Record> record_of(const std::string& name, double until) {
  std::ifstream file(flight::mavlink::records() / "behaviour" / (name + ".txt"));
  if (!file) return std::nullopt;
  const std::regex stamped(R"(\s*([0-9.]+) (.*))");
  Record record;
  std::smatch m;
  for (std::string line; std::getline(file, line);) {
    if (!std::regex_match(line, m, stamped) || std::stod(m[1]) > until) continue;
    const Event event{std::stod(m[1]), m[2]};
    const std::string answer = answer_of(event.what);
    if (answer.empty())
      record.script.push_back(event);
    else if (event.t > kBooted)
      record.answers.push_back({event.t, answer});
  }
  return record;
}

void send_command(MadeFlight& flight, const std::string& line) {
  std::string text = line;
  for (char& c : text)
    if (c == '[' || c == ']' || c == ',') c = ' ';
  std::istringstream words(text);
  std::string name;
  int number = 0;
  std::array<float, 7> p{};
  words >> name >> number;
  for (float& value : p) words >> value;
  flight.command(static_cast<std::uint16_t>(number), p);
}

/// Plays the script. Steps that are no commands are named by the beginnings of their lines.
std::vector<Event> played(const Record& record, const Quirks& quirks, double until,
                          const std::map<std::string, std::function<void(MadeFlight&)>>& steps) {
  MadeFlight flight(quirks);
  flight.odometry = false;
  bool origin = false;
  for (const Event& step : record.script) {
    flight.run_to(step.t);
    flight.odometry = flight.odometry || step.what.starts_with("truth here");
    if (step.what.starts_with("CMD ")) send_command(flight, step.what);
    if (!origin && step.what.find("origin set") != std::string::npos) flight.send_origin();
    origin = origin || step.what.find("origin set") != std::string::npos;
    for (const auto& [begin, act] : steps)
      if (step.what.starts_with(begin)) act(flight);
  }
  flight.run_to(until);
  std::erase_if(flight.events, [](const Event& e) {
    return e.t < kBooted || e.what.starts_with("TEXT EKF3") || e.what.starts_with("ACK 51");
  });
  return flight.events;
}

/// Of each kind in their order, each at its time; kinds among themselves by their times.
void expect_alike(const Record& record, const std::vector<Event>& events) {
  const auto kind = [](const Event& e) { return e.what.substr(0, e.what.find(' ')); };
  std::map<std::string, std::vector<Event>> expected, came;
  for (const Event& e : record.answers) expected[kind(e)].push_back(e);
  for (const Event& e : events) came[kind(e)].push_back(e);
  for (const auto& [name, list] : expected) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      ASSERT_LT(i, came[name].size()) << "no " << list[i].what << " of " << list[i].t;
      EXPECT_EQ(came[name][i].what, list[i].what) << "at " << list[i].t;
      double begin = 0;
      for (const Event& step : record.script)
        if (step.t <= list[i].t && std::regex_search(step.what, kDone)) begin = step.t;
      EXPECT_NEAR(came[name][i].t, list[i].t, kGrid + kShare * (list[i].t - begin)) << list[i].what;
    }
    EXPECT_EQ(came[name].size(), list.size()) << name;
  }
}

using Steps = std::map<std::string, std::function<void(MadeFlight&)>>;

void replay(const std::string& name, const Steps& steps, double until = 1e4,
            bool all_checks = false) {
  const auto record = record_of(name, until);
  if (!record) GTEST_SKIP() << kNoRecords;
  ASSERT_GT(record->answers.size(), 5u);
  const double end = std::min(until, std::max(record->answers.back().t, record->script.back().t));
  const Quirks quirks = quirks_of(Autopilot::ardupilot, all_checks);
  expect_alike(*record, played(*record, quirks, end, steps));
}

TEST(AutopilotRecord, AWholeFlightWithItsRefusals) { replay("basic_50_50", {}, 1e4, true); }

TEST(AutopilotRecord, CommandsOnTheGround) {
  const auto setpoints = [](MadeFlight& f) { f.target = MadeFlight::to(0, -3); };
  const auto none = [](MadeFlight& f) { f.target.reset(); };
  replay("more_acks",
         {{"-- origin sent at once", [](MadeFlight& f) { f.send_origin(); }},
          {"-- setpoints without", setpoints},
          {"-- wait for auto", none},
          {"-- setpoints at 3 m", setpoints},
          {"TIMEOUT climb", none}},
         43.5);
}

TEST(AutopilotRecord, CommandsInTheAir) {
  const auto mode = [](MadeFlight& f) {
    f.send(flight::mavlink::SetMode{.custom_mode = 5, .target_system = 1, .base_mode = 1});
  };
  replay("more_acks2", {{"-- SET_MODE msg to LOITER", mode}});
}

TEST(AutopilotRecord, OdometryStops) {
  replay("fail_odom_stop", {{"ODOM STOP", [](MadeFlight& f) { f.odometry = false; }}});
}

TEST(AutopilotRecord, OdometryIsSaidToBeBad) {
  replay("fail_qual_bad", {{"QUALITY", [](MadeFlight& f) { f.quality = -1; }}});
}

TEST(AutopilotRecord, TheBridgeDies) {
  replay("fail_all_stop", {{"BRIDGE DEAD", [](MadeFlight& f) { f.odometry = false; }}});
}

TEST(AutopilotRecord, HeartbeatStops) {
  const auto stop = [](MadeFlight& f) { f.heartbeats.reset(); };
  for (const auto& [name, system] : {std::pair("fail_hb_255", 255), std::pair("fail_hb_sys1", 1)})
    replay(name,
           {{"truth here", [s = system](MadeFlight& f) { f.heartbeats = s; }}, {"HB STOP", stop}});
}

/// How far it flies on: the recorded end of the flight.
TEST(AutopilotRecord, SetpointsStop) {
  for (const auto& [name, timeout, end] :
       {std::tuple("fail_sp_stop_t05", 0.5, 5.50), std::tuple("fail_sp_stop", 3.0, 8.00)}) {
    const auto record = record_of(name, 1e4);
    if (!record) GTEST_SKIP() << kNoRecords;
    Quirks quirks = quirks_of(Autopilot::ardupilot, false);
    quirks.setpoint_timeout_s = timeout;
    double place = NAN;
    (void)played(*record, quirks, 33,
                 {{"up True",
                   [](MadeFlight& f) {
                     f.target = MadeFlight::to(0, -3);
                     f.run_to(to_seconds(f.now) + 3);
                     f.target = MadeFlight::to(0, -3, 1);
                   }},
                  {"STOP setpoints", [](MadeFlight& f) { f.target.reset(); }},
                  {"end truth", [&](MadeFlight& f) { place = f.craft.place().x(); }}});
    EXPECT_NEAR(place, end, kShare * timeout) << name;
  }
}

}  // namespace
}  // namespace saker::tools
