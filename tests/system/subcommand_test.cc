#include "flight/command_line/subcommand.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

/// A program with `copy INPUT -o OUT` and `map info MAP`.
class SubcommandTest : public testing::Test {
 protected:
  int call(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "saker");
    const auto add = [this](Commands& commands) { add_commands(commands); };
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int status =
        run_command_line({add}, check_, static_cast<int>(arguments.size()), arguments.data());
    error_ = testing::internal::GetCapturedStderr();
    output_ = testing::internal::GetCapturedStdout();
    return status;
  }

  void add_commands(Commands& commands) {
    CLI::App& copy = commands.add({.name = "copy",
                                   .does = "copies",
                                   .output = Output::folder,
                                   .example = "saker copy a -o b"},
                                  [this](const CommonOptions& common) {
                                    common_ = common;
                                    return run_();
                                  });
    copy.add_option("INPUT", input_, "what")->required();
    CLI::App& map = commands.add_group("map", "maps");
    commands.add(map,
                 {.name = "info", .does = "says what it holds", .example = "saker map info m.json"},
                 [](const CommonOptions&) -> int { throw Error("m.json: no map"); });
  }

  std::function<void(const CommonOptions&)> check_ = [](const CommonOptions&) {};
  std::function<int()> run_ = [] { return 0; };
  std::string input_;
  CommonOptions common_;
  std::string error_, output_;
};

TEST_F(SubcommandTest, CommonOptionsArrive) {
  EXPECT_EQ(call({"copy", "a", "-o", "b", "--preset", "paper", "--config", "c.yaml", "--set", "x=1",
                  "--set", "y.z=[1,2]", "--seed", "7", "--threads", "3", "-v", "--force"}),
            0);
  EXPECT_EQ(input_, "a");
  EXPECT_EQ(common_.out, "b");
  EXPECT_EQ(common_.configuration.preset, "paper");
  EXPECT_EQ(common_.configuration.file, "c.yaml");
  EXPECT_EQ(common_.configuration.settings, (std::vector<std::string>{"x=1", "y.z=[1,2]"}));
  EXPECT_EQ(common_.seed, 7u);
  EXPECT_EQ(common_.threads, 3);
  EXPECT_TRUE(common_.verbose);
  EXPECT_TRUE(common_.force);
}

TEST_F(SubcommandTest, DefaultsHold) {
  EXPECT_EQ(call({"copy", "a", "-o", "b"}), 0);
  EXPECT_EQ(common_.seed, 1u);
  EXPECT_GE(common_.threads, 1);
  EXPECT_FALSE(common_.force);
  EXPECT_TRUE(common_.configuration.settings.empty());
}

TEST_F(SubcommandTest, ASettingDoesNotSwallowTheInput) {
  EXPECT_EQ(call({"copy", "--set", "x=1", "a", "-o", "b"}), 0);
  EXPECT_EQ(input_, "a");
}

TEST_F(SubcommandTest, TheStatusOfTheCommandIsThatOfTheProgram) {
  run_ = [] { return 1; };
  EXPECT_EQ(call({"copy", "a", "-o", "b"}), 1);
}

TEST_F(SubcommandTest, AnErrorIsOneLineWithTheCommandAndStatus2) {
  EXPECT_EQ(call({"map", "info"}), 2);
  EXPECT_EQ(error_, "saker map info: m.json: no map\n");
  run_ = []() -> int { throw std::bad_alloc(); };
  EXPECT_EQ(call({"copy", "a", "-o", "b"}), 2);
  EXPECT_EQ(error_, "saker copy: not enough memory\n");
}

TEST_F(SubcommandTest, WhatTheCheckRefusesIsNotRun) {
  run_ = []() -> int { throw Error("run"); };
  check_ = [](const CommonOptions& common) {
    throw Error(common.configuration.settings.at(0) + ": unknown key");
  };
  EXPECT_EQ(call({"copy", "a", "-o", "b", "--set", "x=1"}), 2);
  EXPECT_EQ(error_, "saker copy: x=1: unknown key\n");
}

TEST_F(SubcommandTest, WrongUsageHasStatus2) {
  EXPECT_EQ(call({}), 2);
  EXPECT_EQ(call({"fly"}), 2);
  EXPECT_EQ(call({"map"}), 2);
  EXPECT_EQ(call({"copy", "a"}), 2);
  EXPECT_EQ(error_.substr(0, 12), "saker copy: ");
  EXPECT_EQ(call({"copy", "a", "-o", "b", "--threads", "0"}), 2);
  EXPECT_EQ(call({"copy", "a", "-o", "b", "--seed", "x"}), 2);
  EXPECT_EQ(call({"copy", "a", "-o", "b", "--no-such"}), 2);
  EXPECT_EQ(std::count(error_.begin(), error_.end(), '\n'), 1) << error_;
}

TEST_F(SubcommandTest, HelpHasStatus0AndAnExample) {
  EXPECT_EQ(call({"copy", "--help"}), 0);
  EXPECT_NE(output_.find("Example:\n  saker copy a -o b"), std::string::npos) << output_;
  EXPECT_EQ(call({"--help"}), 0);
  EXPECT_EQ(call({"--version"}), 0);
}

}  // namespace
}  // namespace saker::flight
