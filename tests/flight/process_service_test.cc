#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "flight/process/service.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

/// A folder of its own, and what systemd sets in the environment, for one test.
class ProcessService : public testing::Test {
 protected:
  ProcessService() {
    char name[] = "/tmp/saker_service_XXXXXX";
    folder_ = ::mkdtemp(name);
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    const std::string path = folder_ / "notify";
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    ::setenv("RUNTIME_DIRECTORY", folder_.c_str(), 1);
  }
  ~ProcessService() override {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("RUNTIME_DIRECTORY");
    ::close(socket_);
    std::filesystem::remove_all(folder_);
  }

  /// The next thing that was said; empty: nothing.
  std::string heard() const {
    char text[256];
    const auto size = ::recv(socket_, text, sizeof text, MSG_DONTWAIT);
    return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "";
  }

  std::filesystem::path folder_;
  int socket_;
};

TEST_F(ProcessService, TheServiceManagerHearsWhatIsSaid) {
  Service service;
  service.ready();
  EXPECT_EQ(heard(), "READY=1");
  service.say("tour, target 2 of 8");
  EXPECT_EQ(heard(), "STATUS=tour, target 2 of 8");
  service.stopping();
  EXPECT_EQ(heard(), "STOPPING=1");
}

TEST_F(ProcessService, TheWatchdogIsFedTwiceASecondAtMost) {
  Service service;
  const auto begin = Service::Steady::now();
  service.alive(begin);
  EXPECT_EQ(heard(), "WATCHDOG=1");
  service.alive(begin + milliseconds(400));
  EXPECT_EQ(heard(), "");
  service.alive(begin + milliseconds(500));
  EXPECT_EQ(heard(), "WATCHDOG=1");
}

TEST_F(ProcessService, ARestartInTheMiddleOfAFlightIsRefused) {
  const FlightMark killed;
  ASSERT_TRUE(killed.set());
  EXPECT_THROW(FlightMark{}, Error);
}

TEST_F(ProcessService, ARestartBeforeAFlightIsNone) {
  const FlightMark killed;
  EXPECT_NO_THROW(FlightMark{});
}

TEST_F(ProcessService, AFlightThatEndedLeavesNoMark) {
  {
    const FlightMark mark;
    ASSERT_TRUE(mark.set());
  }
  EXPECT_NO_THROW(FlightMark{});
}

TEST_F(ProcessService, AMarkThatCannotBeWrittenIsSaid) {
  const FlightMark mark;
  std::filesystem::remove_all(folder_);
  EXPECT_FALSE(mark.set());
}

TEST_F(ProcessService, StartedByHandNothingIsMarked) {
  ::unsetenv("RUNTIME_DIRECTORY");
  const FlightMark first;
  EXPECT_TRUE(first.set());
  EXPECT_NO_THROW(FlightMark{});
}

TEST_F(ProcessService, OnlyTheJournalsOwnStreamIsTheJournal) {
  ::setenv("JOURNAL_STREAM", "1:1", 1);
  EXPECT_FALSE(to_journal());
  EXPECT_EQ(journal_error(), "");
  ::unsetenv("JOURNAL_STREAM");
}

}  // namespace
}  // namespace saker::flight
