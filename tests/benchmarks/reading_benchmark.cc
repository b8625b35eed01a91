/// Reading a recording alone, one thread, the file in the system's cache: bags and MCAP files of
/// clouds of 131,072 points of 32 bytes, by their messages (bytes a second as unpacked; wanted 500
/// MB/s of an uncompressed bag, 150 MB/s of lz4) and to scans; packets of a VLP-16 to scans.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "../lidar/made_bag.h"
#include "../lidar/made_spinning.h"
#include "saker/core/rng.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {
namespace {

constexpr int kScans = 24;
constexpr std::size_t kPoints = 131072;

/// Ranges that vary as those of a street do, so that they compress as such.
std::vector<testing::MadePoint> street(int scan) {
  core::Rng rng(static_cast<std::uint64_t>(scan));
  std::vector<testing::MadePoint> points(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double azimuth = 2 * M_PI * static_cast<double>(i / 64) / (kPoints / 64);
    const double range = 10 + 5 * std::sin(7 * azimuth) + 0.02 * rng.normal();
    points[i] = {static_cast<float>(range * std::cos(azimuth)),
                 static_cast<float>(range * std::sin(azimuth)),
                 static_cast<float>(0.1 * static_cast<double>(i % 64) - 2),
                 static_cast<float>(rng.index(256)),
                 static_cast<std::uint32_t>(i / 64 * 48000),
                 static_cast<std::uint16_t>(i % 64)};
  }
  return points;
}

std::vector<testing::MadeMessage> messages(Encoding encoding) {
  std::vector<testing::MadeMessage> all;
  for (int scan = 0; scan < kScans; ++scan) {
    const Time begin = testing::kDriveBegin + scan * 100'000'000LL;
    all.push_back({"/points", "sensor_msgs/PointCloud2", begin,
                   testing::made_cloud(street(scan), begin, encoding)});
  }
  return all;
}

/// A recording that is written once and gone with the program.
class Made {
 public:
  Made() { std::filesystem::create_directories(folder_); }
  ~Made() { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& kind, const std::string& compression) {
    const auto path = folder_ / (kind + "_" + compression);
    if (std::filesystem::exists(path)) return path;
    const testing::BagOptions options{compression, 1, true, true};
    if (kind == "bag") {
      testing::write_bytes(path, testing::made_ros1_bag(messages(Encoding::kRos1), options));
    } else {
      testing::write_bytes(path,
                           testing::made_mcap(messages(Encoding::kCdr), Encoding::kCdr, options));
    }
    return path;
  }
  std::filesystem::path packets() {
    const auto path = folder_ / "packets.pcap";
    testing::MadeSpinning made = testing::made_spinning(SpinningKind::kVlp16);
    made.turns = 50;
    if (!std::filesystem::exists(path)) write_capture(testing::made_packets(made), path);
    return path;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / "saker_reading_benchmark";
};

Made& made() {
  static Made made;
  return made;
}

void by_messages(benchmark::State& state, const std::string& kind, const std::string& compression) {
  const auto path = made().file(kind, compression);
  std::int64_t bytes = 0;
  for (auto _ : state) {
    const auto file = open_messages(recording_kind(path), path);
    while (const auto message = file->next())
      bytes += static_cast<std::int64_t>(message->bytes.size());
  }
  state.SetBytesProcessed(bytes);
  state.counters["packed"] = static_cast<double>(std::filesystem::file_size(path)) /
                             (static_cast<double>(bytes) / static_cast<double>(state.iterations()));
}

void to_scans(benchmark::State& state, const std::filesystem::path& path) {
  std::int64_t points = 0, bytes = 0;
  for (auto _ : state) {
    const auto source = open_recording(path);
    while (const auto frame = source->next())
      points += static_cast<std::int64_t>(frame->scan.size());
    bytes += static_cast<std::int64_t>(std::filesystem::file_size(path));
  }
  state.SetItemsProcessed(points);
  state.SetBytesProcessed(bytes);
}

BENCHMARK_CAPTURE(by_messages, bag_none, "bag", "none")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(by_messages, bag_lz4, "bag", "lz4")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(by_messages, mcap_none, "mcap", "none")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(by_messages, mcap_lz4, "mcap", "lz4")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(by_messages, mcap_zstd, "mcap", "zstd")->Unit(benchmark::kMillisecond);

void bag_to_scans(benchmark::State& state) { to_scans(state, made().file("bag", "none")); }
BENCHMARK(bag_to_scans)->Unit(benchmark::kMillisecond);

void packets_to_scans(benchmark::State& state) { to_scans(state, made().packets()); }
BENCHMARK(packets_to_scans)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::lidar
