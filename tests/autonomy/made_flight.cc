#include "made_flight.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "saker/simulation/mission/flight.h"

namespace saker::autonomy {

MadeFlight::MadeFlight()
    : folder_(std::filesystem::path(testing::TempDir()) /
              ("saker_made_flight_" + std::to_string(::getpid()))) {
  std::filesystem::create_directories(folder_);
  simulation::FlightConfig config;
  config.duration_s = kScans / 10.0;
  config.capture.columns = 512;
  simulation::write_flight(config, 5, folder_, nullptr);
}

MadeFlight::~MadeFlight() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::unique_ptr<lidar::ScanSource> MadeFlight::open() const {
  return lidar::open_recording(folder_ / "flight.pcap");
}

std::optional<lidar::Frame> FaultySource::next() {
  auto frame = source_->next();
  if (!frame) return frame;
  const int index = next_++;
  if (index == empty_) {
    const Time stamp = frame->scan.stamp;
    frame->scan = {};
    frame->scan.stamp = stamp;
    frame->fault = "cut off";
  }
  if (index == nan_) {
    for (Eigen::Vector3f& point : frame->scan.points) point.setConstant(NAN);
  }
  return frame;
}

}  // namespace saker::autonomy
