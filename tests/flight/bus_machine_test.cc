#include <gtest/gtest.h>

#include "flight/bus/machine.h"
#include "flight/bus/multicast.h"
#include "saker/core/error.h"
#include "saker/lidar/udp_receiver.h"

namespace saker::flight {
namespace {

TEST(Machine, AGroupIsReadFromAUrl) {
  const MulticastGroup group = multicast_group("udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(group.address, "239.255.76.67");
  EXPECT_EQ(group.port, 7667);
}

TEST(Machine, APortThatIsTakenGrounds) {
  const lidar::UdpReceiver taken(0);
  const Finding finding = check_port(taken.port());
  EXPECT_EQ(finding.weight, Weight::grounding);
  EXPECT_NE(finding.remedy.find(std::to_string(taken.port())), std::string::npos);
}

TEST(Machine, APortThatWasGivenBackIsFree) {
  int port = 0;
  {
    const lidar::UdpReceiver taken(0);
    port = taken.port();
  }
  EXPECT_EQ(check_port(port).weight, Weight::fine);
}

TEST(Machine, AReceiveBufferThatNoKernelGrantsGrounds) {
  const Finding finding = check_receive_buffer(1 << 30);
  EXPECT_EQ(finding.weight, Weight::grounding);
  EXPECT_EQ(finding.remedy, "sysctl -w net.core.rmem_max=1073741824");
}

TEST(Machine, AReceiveBufferOfOnePageIsGranted) {
  EXPECT_EQ(check_receive_buffer(4096).weight, Weight::fine);
}

TEST(Machine, TheFirstGroundingFindingIsOneLineWithItsRemedy) {
  const std::vector<Finding> findings = {{"a", Weight::fine, "good", ""},
                                         {"b", Weight::drawback, "so so", "c"},
                                         {"d", Weight::grounding, "bad", "mend d"},
                                         {"e", Weight::grounding, "bad too", "mend e"}};
  try {
    require_fit(findings);
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "d: bad, mend with: mend d");
  }
}

TEST(Machine, DrawbacksDoNotGround) {
  EXPECT_NO_THROW(require_fit({{"b", Weight::drawback, "so so", "c"}}));
}

}  // namespace
}  // namespace saker::flight
