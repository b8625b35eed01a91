#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "saker/lidar/recording.h"

namespace saker::autonomy {

/// A simulated flight of six seconds past parked cars, in a folder that is removed at the end.
class MadeFlight {
 public:
  MadeFlight();
  ~MadeFlight();
  MadeFlight(const MadeFlight&) = delete;
  MadeFlight& operator=(const MadeFlight&) = delete;

  [[nodiscard]] std::unique_ptr<lidar::ScanSource> open() const;
  [[nodiscard]] std::filesystem::path truth() const { return folder_ / "truth.json"; }

  static constexpr int kScans = 80;

 private:
  std::filesystem::path folder_;
};

/// Passes a recording on, but scan `empty` could not be read and scan `nan` holds only NaN.
class FaultySource : public lidar::ScanSource {
 public:
  FaultySource(std::unique_ptr<lidar::ScanSource> source, int empty, int nan)
      : source_(std::move(source)), empty_(empty), nan_(nan) {}

  [[nodiscard]] std::optional<lidar::Frame> next() override;
  [[nodiscard]] lidar::SourceCounters counters() const override { return source_->counters(); }

 private:
  std::unique_ptr<lidar::ScanSource> source_;
  int empty_, nan_;
  int next_ = 0;
};

}  // namespace saker::autonomy
