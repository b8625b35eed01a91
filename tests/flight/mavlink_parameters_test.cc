#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/parameter_exchange.h"
#include "flight/mavlink/parameter_table.h"
#include "paths.h"
#include "saker/core/error.h"
#include "tools/sim/mavlink/parameters.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;
constexpr std::uint8_t kFloat = 9, kInt32 = 6, kUint32 = 5, kInt8 = 2;

ParamValue value(const std::string& name, float field, std::uint8_t type) {
  ParamValue message;
  write_text(name, message.param_id);
  message.param_value = field;
  message.param_type = type;
  return message;
}

std::string asked(const ParameterExchange::Request& request) {
  return std::visit([](const auto& message) { return text_of(message.param_id); }, request);
}

TEST(MavlinkParameters, OneIsAskedForAfterTheOther) {
  ParameterExchange exchange({{.name = "A"}, {.name = "B"}}, 1, 1, false);
  EXPECT_EQ(asked(*exchange.due(0)), "A");
  EXPECT_FALSE(exchange.due(kMs));
  exchange.hear(value("A", 3, kInt8));
  EXPECT_EQ(asked(*exchange.due(2 * kMs)), "B");
  exchange.hear(value("B", 0.5F, kFloat));
  ASSERT_TRUE(exchange.done());
  EXPECT_EQ(exchange.parameters()[0].value, 3);
  EXPECT_EQ(exchange.parameters()[1].value, 0.5);
  EXPECT_EQ(exchange.parameters()[0].outcome, ParameterOutcome::known);
}

TEST(MavlinkParameters, ALostAnswerIsAskedForAgain) {
  ParameterExchange exchange({{.name = "A"}}, 1, 1, false);
  ASSERT_TRUE(exchange.due(0));
  EXPECT_FALSE(exchange.due(ParameterExchange::kAnswer - 1));
  EXPECT_EQ(asked(*exchange.due(ParameterExchange::kAnswer)), "A");
  exchange.hear(value("A", 1, kInt8));
  EXPECT_TRUE(exchange.done());
}

TEST(MavlinkParameters, WithoutAnAnswerItIsMissing) {
  ParameterExchange exchange({{.name = "A"}, {.name = "B"}}, 1, 1, false);
  int sent = 0;
  Time now = 0;
  for (; !exchange.done() && now < 20 * kNanosecondsPerSecond; now += 10 * kMs) {
    const auto request = exchange.due(now);
    if (request && asked(*request) == "A") ++sent;
    if (request && asked(*request) == "B") exchange.hear(value("B", 2, kInt8));
  }
  EXPECT_EQ(sent, ParameterExchange::kMostTries);
  EXPECT_EQ(exchange.parameters()[0].outcome, ParameterOutcome::missing);
  EXPECT_TRUE(std::isnan(exchange.parameters()[0].value));
  EXPECT_EQ(exchange.parameters()[1].outcome, ParameterOutcome::known);
}

TEST(MavlinkParameters, WhatWasNotAskedForIsIgnored) {
  ParameterExchange exchange({{.name = "A"}}, 1, 1, false);
  exchange.hear(value("A", 7, kInt8));
  EXPECT_FALSE(exchange.done());
  ASSERT_TRUE(exchange.due(0));
  exchange.hear(value("B", 7, kInt8));
  EXPECT_FALSE(exchange.done());
}

TEST(MavlinkParameters, Px4PutsTheBytesOfWholeNumbersIntoTheFloat) {
  for (const double number : {0.0, 1.0, 280.0, -7.0}) {
    const float field = field_of(number, kInt32, true);
    EXPECT_EQ(value_of(field, kInt32, true), number);
    EXPECT_EQ(std::bit_cast<std::int32_t>(field), static_cast<std::int32_t>(number));
  }
  EXPECT_EQ(value_of(field_of(4e9, kUint32, true), kUint32, true), 4e9);
  EXPECT_EQ(value_of(field_of(0.5, kFloat, true), kFloat, true), 0.5);
}

TEST(MavlinkParameters, ArdupilotCastsThem) {
  EXPECT_EQ(field_of(6, kInt8, false), 6.0F);
  EXPECT_EQ(value_of(6.0F, kInt32, false), 6);
}

TEST(MavlinkParameters, AWritingIsDoneWhenTheValueComesBack) {
  ParameterExchange exchange({{.name = "A", .set = 6, .type = kInt8}}, 1, 1, false);
  const auto request = exchange.due(0);
  ASSERT_TRUE(std::holds_alternative<ParamSet>(*request));
  EXPECT_EQ(std::get<ParamSet>(*request).param_value, 6.0F);
  EXPECT_EQ(std::get<ParamSet>(*request).param_type, kInt8);
  exchange.hear(value("A", 6, kInt8));
  EXPECT_EQ(exchange.parameters()[0].outcome, ParameterOutcome::known);
}

TEST(MavlinkParameters, AnotherValueThatComesBackIsARefusal) {
  ParameterExchange exchange({{.name = "A", .set = 6, .type = kInt8}}, 1, 1, false);
  ASSERT_TRUE(exchange.due(0));
  exchange.hear(value("A", 5, kInt8));
  EXPECT_EQ(exchange.parameters()[0].outcome, ParameterOutcome::refused);
}

class Expected : public testing::Test {
 protected:
  static ExpectedParameter with(std::vector<double> values) {
    ExpectedParameter parameter;
    parameter.name = "A";
    parameter.values = std::move(values);
    return parameter;
  }
};

TEST_F(Expected, AnyOfTheValuesFitsAndTheFirstIsWritten) {
  const auto parameter = with({1, 3});
  EXPECT_TRUE(parameter.fits(1, NAN));
  EXPECT_TRUE(parameter.fits(3, NAN));
  EXPECT_FALSE(parameter.fits(2, NAN));
  EXPECT_FALSE(parameter.fits(NAN, NAN));
  EXPECT_EQ(parameter.wanted(NAN), 1);
  EXPECT_EQ(parameter.expected_text(NAN), "1 or 3");
}

TEST_F(Expected, AFloatFitsByItsDigits) {
  EXPECT_TRUE(with({0.3}).fits(static_cast<double>(0.3F), NAN));
  EXPECT_FALSE(with({0.3}).fits(0.301, NAN));
}

TEST_F(Expected, BoundsHoldBesideTheValueThatIsWritten) {
  auto parameter = with({0.5});
  parameter.least = 0.2;
  parameter.most = 1;
  EXPECT_TRUE(parameter.fits(0.9, NAN));
  EXPECT_FALSE(parameter.fits(3, NAN));
  EXPECT_EQ(parameter.wanted(NAN), 0.5);
  EXPECT_EQ(parameter.expected_text(NAN), "0.2 … 1");
}

TEST_F(Expected, TheLatencyIsTheMeasuredOne) {
  auto parameter = with({});
  parameter.latency = true;
  EXPECT_TRUE(parameter.fits(50, 45));
  EXPECT_FALSE(parameter.fits(100, 45));
  EXPECT_TRUE(parameter.fits(100, NAN));  // nobody has measured it
  EXPECT_EQ(parameter.wanted(45.3), 45);
  EXPECT_TRUE(std::isnan(parameter.wanted(NAN)));
}

class Tables : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / "table.yaml";
    std::ofstream(file) << text;
    return file;
  }
  void expect_refused(const std::string& text, const std::string& words) {
    try {
      (void)read_parameter_table(written(text), 255);
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("table.yaml"), std::string::npos) << error.what();
    }
  }
};

TEST_F(Tables, WhatIsWrongInOneIsNamed) {
  expect_refused("parameters: [{name: A, values: [1]}, {name: A, values: [2]}]", "A named twice");
  expect_refused("parameters: [{name: A}]",
                 "expected values, least or most, latency or our_system");
  expect_refused("parameters: [{name: ABCDEFGHIJKLMNOPQ, values: [1]}]", "1 to 16 characters");
  expect_refused("parameters: [{name: A, value: 1}]", "value");
  expect_refused("autopilot: px4", "no parameters");
}

TEST_F(Tables, ThoseThatAreShippedFitTheSimulatedAutopilots) {
  for (const Autopilot autopilot : {Autopilot::ardupilot, Autopilot::px4}) {
    const auto file = std::filesystem::path(source_dir()) / "configs/autopilots" /
                      (std::string(to_string(autopilot)) + ".yaml");
    const ParameterTable table = read_parameter_table(file, 255);
    EXPECT_EQ(table.autopilot, autopilot);
    std::vector<Parameter> names;
    for (const ExpectedParameter& expected : table.parameters)
      names.push_back({.name = expected.name});
    ParameterExchange exchange(names, 1, 1, autopilot == Autopilot::px4);
    tools::AutopilotParameters simulated(autopilot);
    for (Time now = 0; !exchange.done(); now += 10 * kMs) {
      const auto request = exchange.due(now);
      if (!request) continue;
      if (const auto answer = simulated.answer(std::get<ParamRequestRead>(*request)))
        exchange.hear(*answer);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Parameter& read = exchange.parameters()[i];
      const ExpectedParameter& expected = table.parameters[i];
      if (read.outcome == ParameterOutcome::missing) {
        EXPECT_TRUE(expected.optional) << read.name;
      } else {
        EXPECT_TRUE(expected.fits(read.value, NAN)) << read.name << " " << read.value;
      }
      EXPECT_FALSE(expected.why.empty()) << read.name;
    }
  }
}

TEST_F(Tables, TheFailsafesSystemIsOurs) {
  const auto table =
      read_parameter_table(written("parameters: [{name: SYSID_MYGCS, our_system: true}]"), 250);
  EXPECT_TRUE(table.parameters[0].fits(250, NAN));
  EXPECT_FALSE(table.parameters[0].fits(255, NAN));
  EXPECT_EQ(table.parameters[0].wanted(NAN), 250);
}

TEST_F(Tables, AllThatAreShippedCanBeRead) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(source_dir()) /
                                                               "configs/autopilots")) {
    EXPECT_FALSE(read_parameter_table(entry.path(), 255).parameters.empty()) << entry.path();
    ++read;
  }
  EXPECT_GE(read, 4);
}

TEST(MavlinkParameters, TheSimulatedAutopilotTakesWhatIsSet) {
  for (const Autopilot autopilot : {Autopilot::ardupilot, Autopilot::px4}) {
    const bool px4 = autopilot == Autopilot::px4;
    tools::AutopilotParameters simulated(autopilot);
    ParamSet request;
    write_text(px4 ? "EKF2_EV_CTRL" : "VISO_TYPE", request.param_id);
    request.param_type = px4 ? kInt32 : kInt8;
    request.param_value = field_of(3, request.param_type, px4);
    const auto answer = simulated.set(request);
    ASSERT_TRUE(answer);
    EXPECT_EQ(value_of(answer->param_value, answer->param_type, px4), 3);
    write_text("NOSUCH", request.param_id);
    EXPECT_FALSE(simulated.set(request));
    EXPECT_GE(simulated.all().size(), 11U);
  }
}

}  // namespace
}  // namespace saker::flight::mavlink
