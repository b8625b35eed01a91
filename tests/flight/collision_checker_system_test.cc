#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "flight/bus/bus.h"
#include "flight/bus/occupancy_messages.h"
#include "made_hall.h"

// The process itself, over real LCM. Runs by tests/flight/in_namespace.sh.
namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using Steady = std::chrono::steady_clock;

constexpr int kStillRunning = -1;
constexpr int kSignalled = -2;

/// saker-collision-checker in a process of its own, ended with this object.
class Child {
 public:
  explicit Child(std::vector<std::string> arguments) {
    error_file_ = std::filesystem::temp_directory_path() /
                  ("checker-" + std::to_string(::getpid()) + "-" + std::to_string(++count_));
    arguments.insert(arguments.begin(), SAKER_BIN_DIR "/saker-collision-checker");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    const int errors = ::open(error_file_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(errors, STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~Child() {
    if (wait(milliseconds(0)) == kStillRunning) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    std::filesystem::remove(error_file_);
  }
  Child(const Child&) = delete;

  void signal(int number) const { ::kill(pid_, number); }

  /// Its exit status.
  int wait(milliseconds at_most) {
    const auto end = Steady::now() + at_most;
    while (status_ == kStillRunning) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled;
      } else if (Steady::now() >= end) {
        break;
      } else {
        ::usleep(10000);
      }
    }
    return status_;
  }
  [[nodiscard]] std::string errors() const {
    std::ostringstream text;
    text << std::ifstream(error_file_).rdbuf();
    return text.str();
  }

 private:
  static inline int count_ = 0;
  pid_t pid_ = 0;
  int status_ = kStillRunning;
  std::filesystem::path error_file_;
};

class CheckerInANamespace : public testing::Test {
 protected:
  void SetUp() override {
    const char* here = std::getenv("SAKER_NAMESPACE");
    if (!here || std::string(here) != "yes") GTEST_SKIP() << "runs in a namespace with a route";
  }
};

/// The executive's side.
class Executive {
 public:
  Executive() {
    bus_.subscribe<verdict_t>([this](const verdict_t& message) {
      verdict_ = from_lcm(message);
      ++verdicts_;
      return verdict_.has_value();
    });
    bus_.subscribe<occupancy_t>([this](const occupancy_t& chunk) {
      grids_ += joiner_.add(chunk).has_value();
      return joiner_.accepted();
    });
  }

  /// A scan now, and what comes back until `done` or the time is over.
  bool fly(bool with_pillar, bool scans, milliseconds at_most, const std::function<bool()>& done) {
    const auto end = Steady::now() + at_most;
    auto next = Steady::now();
    while (Steady::now() < end) {
      if (scans && Steady::now() >= next) {
        next += milliseconds(100);
        for (const scan_t& chunk : to_lcm(made::hall_scan(now(), with_pillar, rng_), sequence_++))
          bus_.publish(chunk);
      }
      bus_.handle(milliseconds(5));
      if (done()) return true;
    }
    return false;
  }
  void commit(std::int64_t id) { bus_.publish(*to_lcm(made::along_the_hall(id, now()), now())); }

  [[nodiscard]] bool clear() const { return verdict_ && verdict_->clear; }
  [[nodiscard]] bool refused_for(motion::VerdictReason reason) const {
    return verdict_ && !verdict_->clear && verdict_->reason == reason;
  }
  [[nodiscard]] int verdicts() const { return verdicts_; }
  [[nodiscard]] int grids() const { return grids_; }

 private:
  static Time now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Steady::now().time_since_epoch())
        .count();
  }

  Bus bus_{BusConfig{}, "R1"};
  core::Rng rng_{1};
  OccupancyJoiner joiner_;
  std::optional<motion::Verdict> verdict_;
  std::int32_t sequence_ = 0;
  int verdicts_ = 0;
  int grids_ = 0;
};

TEST_F(CheckerInANamespace, SeesAPillarComeAndGoAndTheScansStopAndEndsWhenAsked) {
  Child checker({"--robot", "R1"});
  Executive executive;
  ASSERT_TRUE(executive.fly(false, true, milliseconds(8000), [&] {
    return executive.verdicts() > 3;
  })) << checker.errors();
  executive.commit(1);
  EXPECT_TRUE(executive.fly(false, true, milliseconds(2000), [&] { return executive.clear(); }));
  EXPECT_TRUE(executive.fly(true, true, milliseconds(1000), [&] {
    return executive.refused_for(motion::VerdictReason::occupied);
  }));
  EXPECT_TRUE(executive.fly(false, true, milliseconds(2500), [&] { return executive.clear(); }));
  EXPECT_TRUE(executive.fly(false, false, milliseconds(1500), [&] {
    return executive.refused_for(motion::VerdictReason::stale_scan);
  }));
  checker.signal(SIGTERM);
  EXPECT_EQ(checker.wait(milliseconds(2000)), 0) << checker.errors();
}

TEST_F(CheckerInANamespace, ASecondOneOfTheSameRobotEndsWithOneLineAndStatus2) {
  Child first({"--robot", "R1"});
  Executive executive;
  ASSERT_TRUE(
      executive.fly(false, true, milliseconds(8000), [&] { return executive.verdicts() > 0; }));
  Child second({"--robot", "R1"});
  EXPECT_EQ(second.wait(milliseconds(8000)), 2);
  EXPECT_EQ(second.errors().rfind("saker-collision-checker: a second ", 0), 0u) << second.errors();
}

TEST_F(CheckerInANamespace, AnUnknownKeyIsOneLineAndStatus2) {
  Child checker({"--set", "collision_checker.map.resolutoin_m=0.5"});
  EXPECT_EQ(checker.wait(milliseconds(8000)), 2);
  const std::string errors = checker.errors();
  EXPECT_NE(errors.find("resolution_m"), std::string::npos) << errors;
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1);
}

TEST(CheckerWithoutARoute, EndsWithTheCommandThatMendsItAndStatus2) {
  const char* here = std::getenv("SAKER_NAMESPACE");
  if (!here || std::string(here) != "no") GTEST_SKIP() << "runs in a namespace without a route";
  Child checker({"--robot", "R1"});
  EXPECT_EQ(checker.wait(milliseconds(8000)), 2);
  EXPECT_NE(checker.errors().find("ip route add"), std::string::npos) << checker.errors();
}

}  // namespace
}  // namespace saker::flight
