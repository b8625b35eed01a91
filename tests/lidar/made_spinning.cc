#include "made_spinning.h"

#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>

#include "saker/lidar/capture_writer.h"

namespace saker::lidar::testing {
namespace {

using enum SpinningKind;
constexpr double kDegree = M_PI / 180;

void put16(Bytes& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
}

void put32(Bytes& bytes, std::uint32_t value) {
  put16(bytes, value & 0xFFFF);
  put16(bytes, value >> 16);
}

bool of_hesai(SpinningKind kind) { return kind == kPandar64 || kind == kXt32 || kind == kQt64; }

/// How a packet is laid out.
struct Shape {
  std::size_t blocks, returns, return_bytes, banks;
  double block_us;
};

Shape shape_of(SpinningKind kind) {
  switch (kind) {
    case kVlp16:
    case kVlp16HiRes:
      return {12, 32, 3, 1, 110.592};
    case kVlp32c:
      return {12, 32, 3, 1, 55.296};
    case kHdl32e:
      return {12, 32, 3, 1, 46.08};
    case kHdl64e:
      return {12, 32, 3, 2, 48};
    case kPandar64:
      return {6, 64, 3, 1, 55.56};
    case kXt32:
      return {8, 32, 4, 1, 50};
    case kQt64:
      return {4, 64, 4, 1, 166.67};
  }
  return {};
}

class PacketMaker {
 public:
  explicit PacketMaker(const MadeSpinning& made) : made_(made), shape_(shape_of(made.model.kind)) {}

  [[nodiscard]] std::size_t groups() const {
    return shape_.blocks / shape_.banks / (made_.two_returns ? 2 : 1);
  }
  [[nodiscard]] double packet_us() const { return static_cast<double>(groups()) * shape_.block_us; }

  /// \param begin_us  of its first block after the first packet's
  Bytes packet(double begin_us, Time time) {
    Bytes bytes = head();
    for (std::size_t group = 0; group < groups(); ++group) {
      const double at = begin_us + static_cast<double>(group) * shape_.block_us;
      for (int echo = made_.two_returns ? 1 : 0; echo >= 0; --echo) {
        // An HDL-64E's first of two is taken, of all others the second.
        const bool other = made_.model.kind == kHdl64e ? made_.two_returns && echo == 0 : echo == 1;
        for (std::size_t bank = 0; bank < shape_.banks; ++bank) add_block(bytes, at, bank, other);
      }
    }
    add_tail(bytes, time);
    return bytes;
  }

 private:
  [[nodiscard]] double azimuth(double us) const {
    return std::fmod(made_.first_azimuth_deg + made_.turning_deg_us * us, 360);
  }

  [[nodiscard]] Bytes head() const {
    const int blocks = static_cast<int>(shape_.blocks), lasers = static_cast<int>(shape_.returns);
    const auto u8 = [](int value) { return static_cast<std::uint8_t>(value); };
    switch (made_.model.kind) {
      case kPandar64:
        return {0xEE, 0xFF, u8(lasers), u8(blocks), u8(made_.two_returns), 4, 0, 0};
      case kXt32:
        return {0xEE, 0xFF, 6, 1, 0, 0, u8(lasers), u8(blocks), u8(made_.two_returns), 4, 1, 1};
      case kQt64:
        return {0xEE, 0xFF, 3, 1, 0, 0, u8(lasers), u8(blocks), u8(made_.two_returns), 4, 1, 1};
      default:
        return {};
    }
  }

  void add_block(Bytes& bytes, double at_us, std::size_t bank, bool other) {
    if (!of_hesai(made_.model.kind)) put16(bytes, bank == 0 ? 0xEEFF : 0xDDFF);
    put16(bytes, static_cast<unsigned>(std::lround(azimuth(at_us) * 100)) % 36000);
    for (std::size_t i = 0; i < shape_.returns; ++i) {
      const SpinningBeam& beam = made_.model.beams[bank * 32 + i];
      const double a = (azimuth(at_us + beam.firing_us) + beam.azimuth_deg) * kDegree;
      const double e = beam.elevation_deg * kDegree;
      double range =
          box_range({std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), std::sin(e)});
      const bool weak = made_.two_returns && i % 7 == 0;  // then the other one holds it alone
      if (weak != other && made_.two_returns) range = weak ? 0 : range + 3;
      put16(bytes, static_cast<unsigned>(std::lround(range / made_.unit_m)));
      bytes.push_back(static_cast<std::uint8_t>(i + 100));
      if (shape_.return_bytes == 4) bytes.push_back(0xCC);  // confidence
    }
  }

  void add_tail(Bytes& bytes, Time first_block) {
    if (!of_hesai(made_.model.kind)) {
      put32(bytes, static_cast<std::uint32_t>(first_block / 1000 % 3'600'000'000LL));
      bytes.push_back(made_.two_returns ? 0x39 : 0x37);
      bytes.push_back(made_.model.kind == kVlp16        ? 0x22
                      : made_.model.kind == kVlp16HiRes ? 0x24
                      : made_.model.kind == kVlp32c     ? 0x28
                      : made_.model.kind == kHdl32e     ? 0x21
                                                        : 0x04);
      return;
    }
    const double last_us = static_cast<double>(groups() - 1) * shape_.block_us;
    const double clock_us = made_.model.kind == kPandar64 ? last_us + 42.58
                            : made_.model.kind == kXt32   ? last_us
                                                          : -25.71;
    const Time clock = first_block + static_cast<Time>(std::llround(1000 * clock_us));
    const std::time_t second = clock / kNanosecondsPerSecond;
    std::tm date{};
    gmtime_r(&second, &date);
    Bytes utc;
    for (const int part :
         {date.tm_year, date.tm_mon + 1, date.tm_mday, date.tm_hour, date.tm_min, date.tm_sec}) {
      utc.push_back(static_cast<std::uint8_t>(part));
    }
    const auto us = static_cast<std::uint32_t>(clock % kNanosecondsPerSecond / 1000);
    const std::uint8_t mode = made_.two_returns ? 0x39 : 0x37;
    const auto add_utc = [&] { bytes.insert(bytes.end(), utc.begin(), utc.end()); };
    bytes.insert(bytes.end(), made_.model.kind == kPandar64 ? 8 : 10, 0);
    if (made_.model.kind == kXt32) {
      bytes.push_back(mode);
      put16(bytes, 600);
      add_utc();
      put32(bytes, us);
      bytes.push_back(0x42);
    } else {
      put16(bytes, 600);
      put32(bytes, us);
      bytes.push_back(mode);
      bytes.push_back(0x42);
      add_utc();
    }
    put32(bytes, sequence_++);
  }

  const MadeSpinning& made_;
  Shape shape_;
  std::uint32_t sequence_ = 0;
};

SpinningModel made_hdl64e() {
  SpinningModel model = spinning_model(kHdl64e);
  for (std::size_t i = 0; i < model.beams.size(); ++i) {
    model.beams[i].elevation_deg = 2 - 0.425 * static_cast<double>(i * 37 % 64);
    model.beams[i].azimuth_deg = i % 2 == 0 ? 3.5 : -2.25;
  }
  model.needs_calibration = false;
  number_rings(model.beams);
  return model;
}

}  // namespace

double box_range(const Eigen::Vector3d& direction) {
  double range = INFINITY;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] > 0) range = std::min(range, kBoxMost[i] / direction[i]);
    if (direction[i] < 0) range = std::min(range, kBoxLeast[i] / direction[i]);
  }
  return range;
}

double off_the_box(const Eigen::Vector3d& point) {
  return std::min((point.array() - kBoxLeast).abs().minCoeff(),
                  (point.array() - kBoxMost).abs().minCoeff());
}

MadeSpinning made_spinning(SpinningKind kind) {
  MadeSpinning made;
  made.model = kind == kHdl64e ? made_hdl64e() : spinning_model(kind);
  if (kind == kVlp32c || of_hesai(kind)) made.unit_m = 0.004;
  return made;
}

std::vector<MadePacket> made_packets(const MadeSpinning& made) {
  PacketMaker maker(made);
  std::vector<MadePacket> packets;
  const double end_us = made.turns * 360 / made.turning_deg_us;
  for (double us = 0; us < end_us; us += maker.packet_us()) {
    const Time time = made.begin + static_cast<Time>(std::llround(1000 * us));
    packets.push_back({maker.packet(us, time), time});
  }
  return packets;
}

std::string made_calibration_yaml() {
  std::ostringstream text;
  text << std::setprecision(17) << "lasers:\n";
  const SpinningModel model = made_hdl64e();
  for (std::size_t i = 0; i < model.beams.size(); ++i) {
    text << "- {dist_correction: 0.0, dist_correction_x: 0, dist_correction_y: 0, focal_distance: "
            "0.0, focal_slope: 0.0, horiz_offset_correction: 0.0, laser_id: "
         << i << ", rot_correction: " << -model.beams[i].azimuth_deg * kDegree
         << ", vert_correction: " << model.beams[i].elevation_deg * kDegree
         << ", vert_offset_correction: 0.0}\n";
  }
  text << "num_lasers: 64\ndistance_resolution: 0.002\n";
  return text.str();
}

std::string made_calibration_xml() {
  std::ostringstream text;
  text << std::setprecision(17) << "<?xml version=\"1.0\"?>\n<boost_serialization><DB><points_>\n";
  const SpinningModel model = made_hdl64e();
  for (std::size_t i = 0; i < model.beams.size(); ++i) {
    text << "<item><px class_id=\"9\"><id_>" << i << "</id_><rotCorrection_>"
         << -model.beams[i].azimuth_deg << "</rotCorrection_><vertCorrection_>"
         << model.beams[i].elevation_deg
         << "</vertCorrection_><distCorrection_>0</distCorrection_>"
            "<vertOffsetCorrection_>0</vertOffsetCorrection_>"
            "<horizOffsetCorrection_>0</horizOffsetCorrection_></px></item>\n";
  }
  text << "</points_></DB></boost_serialization>\n";
  return text.str();
}

void write_capture(const std::vector<MadePacket>& packets, const std::filesystem::path& file,
                   int port) {
  constexpr Time kOnTheWay = 100'000;
  CaptureWriter writer(file);
  for (const MadePacket& packet : packets) {
    writer.write(packet.time + kOnTheWay, port, packet.bytes);
  }
  writer.finish();
}

std::vector<MadeMessage> made_packet_messages(const std::vector<MadePacket>& packets,
                                              const std::string& type, Encoding encoding) {
  constexpr std::size_t kAMessage = 100;
  std::vector<MadeMessage> messages;
  for (std::size_t first = 0; first < packets.size(); first += kAMessage) {
    const std::size_t count = std::min(kAMessage, packets.size() - first);
    MessageWriter writer(encoding);
    writer.header(packets[first].time, "lidar");
    writer.number(static_cast<std::uint32_t>(count));
    for (std::size_t i = first; i < first + count; ++i) {
      const MadePacket& packet = packets[i];
      writer.number(static_cast<std::uint32_t>(packet.time / kNanosecondsPerSecond));
      writer.number(static_cast<std::uint32_t>(packet.time % kNanosecondsPerSecond));
      const bool fixed = type == "velodyne_msgs/VelodyneScan" || type == "pandar_msgs/PandarScan";
      Bytes bytes = packet.bytes;
      if (type == "pandar_msgs/PandarScan") bytes.resize(1500);
      if (!fixed) writer.number(static_cast<std::uint32_t>(bytes.size()));
      for (const std::uint8_t byte : bytes) writer.number(byte);
      if (type != "velodyne_msgs/VelodyneScan") {
        writer.number(static_cast<std::uint32_t>(packet.bytes.size()));
      }
    }
    messages.push_back({"/packets", type, packets[first].time, writer.done()});
  }
  return messages;
}

}  // namespace saker::lidar::testing
