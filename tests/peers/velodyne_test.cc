#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "made_bag.h"
#include "made_spinning.h"
#include "peer.h"
#include "saker/lidar/spinning/calibration_file.h"
#include "saker/lidar/spinning/spinning_stream.h"

/// Velodyne packets against @foxglove/velodyne-cloud, point by point. It takes a block's azimuth
/// for all of its beams: the packets are of a rotor that stands still, where that makes no
/// difference.
namespace saker::lidar {
namespace {

using testing::MadeMessage;
using testing::MadePacket;
using testing::MadeSpinning;
using testing::TemporaryFolder;
using enum SpinningKind;

/// Packets all around, each of a rotor that stands.
std::vector<MadePacket> standing_packets(MadeSpinning made) {
  std::vector<MadePacket> packets;
  made.turning_deg_us = 1e-9;
  made.turns = 1e-12;
  for (int degrees = 1; degrees < 360; degrees += 7) {
    made.first_azimuth_deg = degrees + 0.25;
    packets.push_back(testing::made_packets(made).front());
  }
  return packets;
}

/// Scans of one packet each, with the points in the order of the packet.
Scan decoded(const SpinningModel& model, const MadePacket& packet) {
  SpinningStream stream(model);
  stream.add(packet.bytes, packet.time);
  stream.finish();
  auto frame = stream.take();
  return frame ? frame->scan : Scan{};
}

/// \param timed  whether times are compared, too: of a VLP-16
void expect_equal(const SpinningModel& model, const std::vector<MadePacket>& packets,
                  const std::vector<std::string>& calibration, bool timed) {
  const TemporaryFolder folder;
  std::vector<MadeMessage> messages;
  for (const MadePacket& packet : packets)
    messages.push_back({"/p", "p", packet.time, packet.bytes});
  testing::write_messages(messages, folder / "packets");
  std::vector<std::string> arguments = {folder / "packets", folder / "points"};
  arguments.insert(arguments.end(), calibration.begin(), calibration.end());
  ASSERT_EQ(testing::run_peer("velodyne.cjs", arguments), "");
  const auto read = testing::read_messages(folder / "points");
  ASSERT_EQ(read.size(), packets.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    const std::vector<double> theirs = testing::numbers_of(read[k]);
    const Scan ours = decoded(model, packets[k]);
    ASSERT_EQ(5 * ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
      const Eigen::Vector3d p(theirs[5 * i], theirs[5 * i + 1], theirs[5 * i + 2]);
      ASSERT_LT((ours.points[i].cast<double>() - p).norm(), 1e-4) << k << " " << i;
      if (!timed) continue;
      // It lets half a block of a VLP-16, 55.296 us, grow with the beam.
      const auto beam = static_cast<double>(i % 16);
      ASSERT_NEAR(static_cast<double>(ours.time_of(i) - ours.time_of(0)),
                  theirs[5 * i + 4] - theirs[4] - 3456 * beam, 2)
          << i;
    }
  }
}

class VelodynePeer : public ::testing::TestWithParam<SpinningKind> {};
INSTANTIATE_TEST_SUITE_P(Models, VelodynePeer,
                         ::testing::Values(kVlp16, kVlp16HiRes, kVlp32c, kHdl32e));

TEST_P(VelodynePeer, AgreesOnEveryPoint) {
  SKIP_WITHOUT("velodyne.cjs");
  const MadeSpinning made = testing::made_spinning(GetParam());
  // It gives the HDL-32E's beams, which fire one by one, the times of pairs; and the VLP-32C's
  // pairs times between.
  const bool timed = GetParam() == kVlp16 || GetParam() == kVlp16HiRes;
  expect_equal(made.model, standing_packets(made), {}, timed);
}

TEST(VelodynePeer, AgreesOnAnHdl64eByEachOfItsCalibrations) {
  SKIP_WITHOUT("velodyne.cjs");
  for (const char* name : {"64e_utexas", "64e_s2.1-sztaki", "64e_s3-xiesc"}) {
    SCOPED_TRACE(name);
    const auto file = testing::node_modules() / "@foxglove/velodyne-cloud/dist/data/calibration" /
                      (std::string(name) + ".json");
    const TemporaryFolder folder;
    std::ifstream in(file);
    std::ofstream(folder / "a.yaml") << nlohmann::json::parse(in).dump(1);  // YAML, too
    MadeSpinning made = testing::made_spinning(kHdl64e);
    SpinningModel model = spinning_model(kHdl64e);
    read_calibration(folder / "a.yaml", model);
    // Of a rotor that turns: an HDL-64E's azimuth is the block's.
    made.turns = 1;
    auto packets = testing::made_packets(made);
    packets.resize(300);
    expect_equal(model, packets, {file}, false);
  }
}

}  // namespace
}  // namespace saker::lidar
