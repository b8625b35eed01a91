#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include "damage.h"
#include "made_bag.h"
#include "made_spinning.h"
#include "saker/core/error.h"
#include "saker/lidar/capture_writer.h"
#include "saker/lidar/recording.h"
#include "saker/lidar/spinning/spinning_clock.h"
#include "saker/lidar/spinning/spinning_stream.h"

/// Velodyne's and Hesai's packets in a box whose walls are known.
namespace saker::lidar {
namespace {

using testing::made_packets;
using testing::made_spinning;
using testing::MadePacket;
using testing::MadeSpinning;
using testing::TemporaryFolder;
using enum SpinningKind;

constexpr SpinningKind kAll[] = {kVlp16,  kVlp16HiRes, kVlp32c, kHdl32e,
                                 kHdl64e, kPandar64,   kXt32,   kQt64};

std::vector<Frame> scans_of(const MadeSpinning& made, const std::vector<MadePacket>& packets) {
  SpinningStream stream(made.model);
  for (const MadePacket& packet : packets) stream.add(packet.bytes, packet.time);
  stream.finish();
  std::vector<Frame> frames;
  while (auto frame = stream.take()) frames.push_back(std::move(*frame));
  return frames;
}

std::vector<Frame> all_of(ScanSource& source) {
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(std::move(*frame));
  return frames;
}

std::string refusal(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class SpinningOf : public ::testing::TestWithParam<SpinningKind> {};
INSTANTIATE_TEST_SUITE_P(All, SpinningOf, ::testing::ValuesIn(kAll), [](const auto& of) {
  std::string name = spinning_model(of.param).name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

TEST_P(SpinningOf, PointsLieOnTheWallsOfTheBoxToTheRangesUnit) {
  const MadeSpinning made = made_spinning(GetParam());
  double worst = 0;
  for (const Frame& frame : scans_of(made, made_packets(made))) {
    for (const auto& p : frame.scan.points) {
      worst = std::max(worst, testing::off_the_box(p.cast<double>()));
    }
  }
  // Half a unit of the range, and half a hundredth of a degree 18 m away; a firing that is not
  // turned on to its time lies up to 90 mm off.
  EXPECT_LT(worst, made.unit_m / 2 + 0.0025);
}

TEST_P(SpinningOf, TimesAreThoseAtWhichTheRotorLookedThere) {
  const MadeSpinning made = made_spinning(GetParam());
  const bool still = GetParam() == kHdl64e;  // its calibration holds for the block's azimuth
  for (const Frame& frame : scans_of(made, made_packets(made))) {
    for (std::size_t i = 0; i < frame.scan.size(); i += 7) {
      const Eigen::Vector3f& p = frame.scan.points[i];
      const double us = static_cast<double>(frame.scan.time_of(i) - made.begin) / 1000;
      const double rotor = made.first_azimuth_deg + made.turning_deg_us * us;
      const double seen = std::atan2(-p.y(), p.x()) * 180 / M_PI;
      double off = 180;  // beams of one elevation may look to two sides
      for (const SpinningBeam& beam : made.model.beams) {
        if (beam.ring != frame.scan.ring[i]) continue;
        off = std::min(off, std::abs(std::remainder(seen - rotor - beam.azimuth_deg, 360)));
      }
      ASSERT_LT(off, still ? 0.02 : 0.016) << i;  // the block's and the turn's hundredths
    }
  }
}

TEST_P(SpinningOf, AScanIsATurnFromAzimuthZero) {
  const MadeSpinning made = made_spinning(GetParam());
  const auto frames = scans_of(made, made_packets(made));
  // 300° to 1200°: 60° are left out, two turns, then 120° are left out.
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_NEAR(to_seconds(frames[1].scan.stamp - frames[0].scan.stamp), 0.1, 4e-4);
  for (const Frame& frame : frames) {
    EXPECT_NEAR(
        to_seconds(-*std::min_element(frame.scan.offset_ns.begin(), frame.scan.offset_ns.end())),
        0.1, 4e-4);
    testing::expect_consistent(frame);
  }
}

TEST_P(SpinningOf, RingsRiseFromTheLowestBeam) {
  const MadeSpinning made = made_spinning(GetParam());
  const auto frames = scans_of(made, made_packets(made));
  std::map<int, double> elevations;
  for (std::size_t i = 0; i < frames[0].scan.size(); ++i) {
    const Eigen::Vector3f& p = frames[0].scan.points[i];
    elevations[frames[0].scan.ring[i]] = std::atan2(p.z(), std::hypot(p.x(), p.y()));
  }
  const std::size_t beams = GetParam() == kVlp16 || GetParam() == kVlp16HiRes
                                ? made.model.beams.size() / 2
                                : made.model.beams.size();
  ASSERT_EQ(elevations.size(), beams);
  double before = -2;
  for (const auto& [ring, elevation] : elevations) {
    EXPECT_GT(elevation, before) << ring;
    before = elevation;
  }
}

TEST_P(SpinningOf, OfTwoReturnsTheStrongerCountsAndTheOtherWhereItIsAlone) {
  MadeSpinning made = made_spinning(GetParam());
  made.two_returns = true;
  const auto frames = scans_of(made, made_packets(made));
  ASSERT_EQ(frames.size(), 2U);
  for (const Frame& frame : frames) {
    for (const auto& p : frame.scan.points) {
      ASSERT_LT(testing::off_the_box(p.cast<double>()), made.unit_m / 2 + 0.0025);
    }
  }
  made.two_returns = false;
  const auto once = scans_of(made, made_packets(made));
  EXPECT_NEAR(static_cast<double>(frames[0].scan.size()), static_cast<double>(once[0].scan.size()),
              0.01 * static_cast<double>(once[0].scan.size()));
}

TEST_P(SpinningOf, ACaptureIsToldByItsPackets) {
  const TemporaryFolder folder;
  const MadeSpinning made = made_spinning(GetParam());
  const auto packets = made_packets(made);
  testing::write_capture(packets, folder / "a.pcap");
  RecordingOptions options;
  if (GetParam() == kHdl64e) {
    std::ofstream(folder / "a.yaml") << testing::made_calibration_yaml();
  }
  const auto source = open_recording(folder / "a.pcap", options);
  EXPECT_EQ(source->sensor_name(), made.model.name);
  const auto read = all_of(*source);
  const auto truth = scans_of(made, packets);
  ASSERT_EQ(read.size(), truth.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    ASSERT_EQ(read[i].scan.size(), truth[i].scan.size());
    for (std::size_t k = 0; k < read[i].scan.size(); k += 11) {
      ASSERT_LT((read[i].scan.points[k] - truth[i].scan.points[k]).norm(), 1e-5F);
    }
    EXPECT_LE(std::abs(read[i].scan.stamp - truth[i].scan.stamp), 1000);
  }
  EXPECT_EQ(source->counters().summary(), "");
}

TEST_P(SpinningOf, PacketsThatDoNotComeAreCounted) {
  const MadeSpinning made = made_spinning(GetParam());
  auto packets = made_packets(made);
  packets.erase(packets.begin() + 20, packets.begin() + 23);
  SpinningStream stream(made.model);
  for (const MadePacket& packet : packets) stream.add(packet.bytes, packet.time);
  const auto a_packet = read_spinning_packet(packets[0].bytes)->blocks.size();
  EXPECT_EQ(stream.counters().missing_columns,
            3 * static_cast<int>(a_packet) / (GetParam() == kHdl64e ? 2 : 1));
}

TEST(Spinning, AnHdl64eNeedsItsCalibrationAndTakesEitherForm) {
  const TemporaryFolder folder;
  const MadeSpinning made = made_spinning(kHdl64e);
  testing::write_capture(made_packets(made), folder / "a.pcap");
  EXPECT_NE(refusal([&] { (void)open_recording(folder / "a.pcap"); }).find("--meta FILE"),
            std::string::npos);
  std::ofstream(folder / "b.yaml") << testing::made_calibration_yaml();
  std::ofstream(folder / "b.xml") << testing::made_calibration_xml();
  RecordingOptions options;
  options.metadata = folder / "b.yaml";
  const auto by_yaml = all_of(*open_recording(folder / "a.pcap", options));
  options.metadata = folder / "b.xml";
  const auto by_xml = all_of(*open_recording(folder / "a.pcap", options));
  ASSERT_EQ(by_yaml.size(), 2U);
  ASSERT_EQ(by_yaml[0].scan.size(), by_xml[0].scan.size());
  for (std::size_t i = 0; i < by_yaml[0].scan.size(); ++i) {
    ASSERT_LT((by_yaml[0].scan.points[i] - by_xml[0].scan.points[i]).norm(), 1e-4F);
  }
}

TEST(Spinning, ACalibrationOfAnotherSensorIsRefused) {
  const TemporaryFolder folder;
  testing::write_capture(made_packets(made_spinning(kVlp16)), folder / "a.pcap");
  RecordingOptions options;
  options.metadata = folder / "b.yaml";
  for (const std::string& text : {testing::made_calibration_yaml(), std::string("lasers: [{}]"),
                                  std::string("lasers:\n  \x01: ["), std::string()}) {
    std::ofstream(options.metadata) << text;
    const std::string line = refusal([&] { (void)open_recording(folder / "a.pcap", options); });
    EXPECT_NE(line.find("no calibration of a VLP-16"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(Spinning, ACsvOfHesaiTurnsTheBeams) {
  const TemporaryFolder folder;
  const MadeSpinning made = made_spinning(kXt32);
  testing::write_capture(made_packets(made), folder / "a.pcap");
  std::ofstream csv(folder / "a.csv");
  csv << "Channel,Elevation,Azimuth\r\n";
  for (int i = 0; i < 32; ++i) csv << i + 1 << "," << 15.5 - i << ",90\r\n";
  csv.close();
  const auto turned = all_of(*open_recording(folder / "a.pcap"));
  const auto plain = scans_of(made, made_packets(made));
  const Eigen::Vector3f a = plain[0].scan.points[5], b = turned[0].scan.points[5];
  EXPECT_NEAR(
      std::atan2(b.z(), std::hypot(b.x(), b.y())) - std::atan2(a.z(), std::hypot(a.x(), a.y())),
      0.5 * M_PI / 180, 1e-5);
  EXPECT_NEAR(
      std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()) + M_PI / 2, 2 * M_PI), 0,
      1e-4);
}

TEST(Spinning, OfSeveralSensorsOneIsChosen) {
  const TemporaryFolder folder;
  CaptureWriter writer(folder / "a.pcap");
  const auto low = made_packets(made_spinning(kVlp16));
  const auto high = made_packets(made_spinning(kHdl32e));
  for (std::size_t i = 0; i < low.size(); ++i) {
    writer.write(low[i].time, 2368, low[i].bytes);
    writer.write(high[i].time, 2369, high[i].bytes);
  }
  writer.finish();
  const std::string line = refusal([&] { (void)open_recording(folder / "a.pcap"); });
  EXPECT_NE(line.find(":2368 (VLP-16)"), std::string::npos) << line;
  EXPECT_NE(line.find(":2369 (HDL-32E)"), std::string::npos) << line;
  RecordingOptions options;
  const auto begin = line.find("sensors, ") + 9;
  options.sensor = line.substr(begin, line.find(" (VLP-16)") - begin);
  const auto source = open_recording(folder / "a.pcap", options);
  EXPECT_EQ(source->sensor_name(), "VLP-16");
  EXPECT_EQ(all_of(*source).size(), 2U);
  EXPECT_EQ(source->counters().other_sensors, static_cast<int>(low.size()));
}

TEST(Spinning, AModelThatIsNotReadIsNamed) {
  const TemporaryFolder folder;
  auto packets = made_packets(made_spinning(kVlp16));
  for (MadePacket& packet : packets) packet.bytes[1205] = 0xA1;
  testing::write_capture(packets, folder / "a.pcap");
  const std::string line = refusal([&] { (void)open_recording(folder / "a.pcap"); });
  EXPECT_NE(line.find("maker's byte 0xA1"), std::string::npos) << line;
}

TEST(Spinning, NumberedCapturesInAFolderAreOneRecording) {
  const TemporaryFolder folder;
  const MadeSpinning made = made_spinning(kVlp16);
  const auto packets = made_packets(made);
  const auto third = static_cast<std::ptrdiff_t>(packets.size() / 3);
  const auto part = [&](auto from, auto to, const char* name) {
    testing::write_capture({packets.begin() + from, packets.begin() + to}, folder / name);
  };
  part(0, third, "drive-000.pcap");
  part(third, 2 * third, "drive-001.pcap");
  part(2 * third, static_cast<std::ptrdiff_t>(packets.size()), "drive-002.pcap");
  const auto read = all_of(*open_recording(folder.path()));
  const auto truth = scans_of(made, packets);
  ASSERT_EQ(read.size(), truth.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    EXPECT_EQ(read[i].scan.size(), truth[i].scan.size());
}

TEST(Spinning, CapturesOfOtherNamesInAFolderAreNotOne) {
  const TemporaryFolder folder;
  const auto packets = made_packets(made_spinning(kVlp16));
  testing::write_capture(packets, folder / "drive-000.pcap");
  testing::write_capture(packets, folder / "street-001.pcap");
  EXPECT_NE(refusal([&] { (void)open_recording(folder.path()); }).find("2 captures"),
            std::string::npos);
}

TEST(Spinning, MessagesOfPacketsAreTheCapture) {
  struct Case {
    SpinningKind kind;
    const char* type;
  };
  for (const auto& [kind, type] :
       {Case{kVlp16, "velodyne_msgs/VelodyneScan"}, Case{kXt32, "pandar_msgs/PandarScan"},
        Case{kPandar64, "hesai_lidar/PandarScan"}, Case{kQt64, "hesai_ros_driver/UdpFrame"}}) {
    SCOPED_TRACE(type);
    const TemporaryFolder folder;
    const MadeSpinning made = made_spinning(kind);
    const auto packets = made_packets(made);
    const auto truth = scans_of(made, packets);
    testing::write_bytes(folder / "a.bag", testing::made_ros1_bag(testing::made_packet_messages(
                                               packets, type, Encoding::kRos1)));
    testing::write_bytes(folder / "a.mcap", testing::made_mcap(testing::made_packet_messages(
                                                                   packets, type, Encoding::kCdr),
                                                               Encoding::kCdr));
    for (const char* name : {"a.bag", "a.mcap"}) {
      const auto source = open_recording(folder / name);
      EXPECT_EQ(source->sensor_name(), made.model.name);
      const auto read = all_of(*source);
      ASSERT_EQ(read.size(), truth.size());
      for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].scan.points, truth[i].scan.points);
        EXPECT_EQ(read[i].scan.offset_ns, truth[i].scan.offset_ns);
        EXPECT_EQ(read[i].scan.stamp, truth[i].scan.stamp);
      }
    }
  }
}

TEST(Spinning, DamagedCapturesAreRefusedOrGiveConsistentScans) {
  for (const SpinningKind kind : {kVlp16, kQt64}) {
    const TemporaryFolder folder;
    MadeSpinning made = made_spinning(kind);
    made.turns = 1.2;
    testing::write_capture(made_packets(made), folder / "whole.pcap");
    std::ifstream in(folder / "whole.pcap", std::ios::binary);
    const testing::Bytes whole((std::istreambuf_iterator<char>(in)),
                               std::istreambuf_iterator<char>());
    testing::expect_survives_damage(whole, folder / "a.pcap");
  }
}

TEST(SpinningClock, TakesTheHourFromTheRecording) {
  constexpr Time kHour = 3600 * kNanosecondsPerSecond;
  SpinningClock clock;
  const Time received = 490'000 * kHour - 500'000'000;
  EXPECT_EQ(clock.time(kHour - 500'000'100, kHour, received), received - 100);
  EXPECT_EQ(clock.time(1'000'000, kHour, received + 501'000'000), received + 501'000'000);
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SpinningClock, OfASensorThatNobodySetBeginsAtTheFirstReception) {
  constexpr Time kHour = 3600 * kNanosecondsPerSecond;
  SpinningClock clock;
  const Time received = 490'000 * kHour;
  EXPECT_EQ(clock.time(17 * kNanosecondsPerSecond, kHour, received), received);
  EXPECT_EQ(clock.time(17 * kNanosecondsPerSecond + 5'000, kHour, received + 9'000),
            received + 5'000);
}

TEST(SpinningClock, GoesOnWhereTheRecordingsClockSteps) {
  SpinningClock clock;
  const Time begin = testing::kDriveBegin;
  (void)clock.time(begin, 0, begin);
  EXPECT_EQ(clock.time(begin + 1'000'000, 0, begin + 7 * kNanosecondsPerSecond), begin + 1'000'000);
  EXPECT_EQ(clock.time(begin + 2'000'000, 0, begin + 2'000'000), begin + 2'000'000);
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SpinningClock, ThatStepsIsTakenBackAndCounted) {
  SpinningClock clock;
  const Time begin = testing::kDriveBegin;
  (void)clock.time(begin, 0, begin);
  for (const Time step : {5 * kNanosecondsPerSecond, -3 * kNanosecondsPerSecond}) {
    const Time at = begin + std::abs(step) / 1000;
    EXPECT_NEAR(to_seconds(clock.time(at + step, 0, at) - at), 0, 1e-6);
  }
  EXPECT_EQ(clock.steps(), 2);
}

}  // namespace
}  // namespace saker::lidar
