#pragma once

#include <chrono>
#include <ctime>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

namespace saker::core {

/// Times of the stages, taken by whoever drives them (a stage reads no clock) and passed in, never
/// global. Any number of threads may add.
///
///     auto labels = timings.time("segmentation", [&] { return segmentation.segment(scan); });
///
/// Cost: two readings of two clocks, under 1 µs. Memory: at most 64k samples a stage; beyond that
/// every second one is dropped, so that median and p95 stay those of the whole run.
class Timings {
 public:
  struct Row {
    std::string stage;
    long n = 0;
    double median_ms = 0, p95_ms = 0, max_ms = 0;
    double cpu_s = 0;  ///< of the threads that ran the stage, within it
  };

  /// \param stages  those that come first, in this order; others follow as they are met.
  explicit Timings(const std::vector<std::string>& stages = {});

  /// Runs f, adds its time to `stage` (even when it throws), gives its result.
  template <class F>
  auto time(const std::string& stage, F&& f) -> std::invoke_result_t<F> {
    const Scope scope(*this, stage);
    return f();
  }

  void add(const std::string& stage, double wall_s, double cpu_s);

  [[nodiscard]] std::vector<Row> rows() const;  ///< of stages that ran
  [[nodiscard]] std::string csv() const;        ///< `stage,n,median_ms,p95_ms,max_ms,cpu_s`

 private:
  class Scope {
   public:
    Scope(Timings& timings, const std::string& stage);
    ~Scope();

   private:
    Timings& timings_;
    const std::string& stage_;
    std::chrono::steady_clock::time_point start_;
    double cpu_start_s_;
  };

  struct Stage {
    std::string name;
    long n = 0;
    long stride = 1;  // every stride-th sample is kept
    double max_s = 0;
    double cpu_s = 0;
    std::vector<double> wall_s;
  };

  Stage& stage(const std::string& name);

  mutable std::mutex mutex_;
  std::vector<Stage> stages_;
};

}  // namespace saker::core
