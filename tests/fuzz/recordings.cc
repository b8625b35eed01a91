#include "fuzz.h"

namespace saker::lidar::fuzz {

void expect_consistent(const Frame& frame) {
  const Scan& scan = frame.scan;
  expect(frame.fault.find('\n') == std::string::npos);
  expect(scan.points.empty() == !frame.fault.empty());
  expect(scan.reflectivity.size() == scan.size() && scan.offset_ns.size() == scan.size());
  expect(scan.ring.empty() || scan.ring.size() == scan.size());
  for (const float value : scan.reflectivity) expect(value >= 0 && value <= 1);
  for (const std::int32_t offset : scan.offset_ns) expect(offset <= 0);
  for (const ImuSample& sample : frame.imu) {
    expect(sample.acceleration.allFinite() && sample.angular_velocity.allFinite());
  }
}

void read_all(ScanSource& source) {
  expect(source.expected_scans() >= 0);
  while (const auto frame = source.next()) expect_consistent(*frame);
  expect(source.note().find('\n') == std::string::npos);
  expect(source.counters().summary().find('\n') == std::string::npos);
}

}  // namespace saker::lidar::fuzz
