#include "saker/core/timings.h"

#include <fmt/format.h>

#include <algorithm>

#include "saker/core/statistics.h"

namespace saker::core {
namespace {

constexpr std::size_t kMostSamples = 1 << 16;
constexpr double kMilliseconds = 1e3;

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Keeps every second one, in order.
void halve(std::vector<double>& samples) {
  for (std::size_t i = 0; 2 * i < samples.size(); ++i) samples[i] = samples[2 * i];
  samples.resize((samples.size() + 1) / 2);
}

}  // namespace

Timings::Timings(const std::vector<std::string>& stages) {
  for (const std::string& name : stages) stage(name);
}

Timings::Stage& Timings::stage(const std::string& name) {
  for (Stage& stage : stages_) {
    if (stage.name == name) return stage;
  }
  return stages_.emplace_back(Stage{.name = name, .wall_s = {}});
}

void Timings::add(const std::string& name, double wall_s, double cpu_s) {
  const std::lock_guard lock(mutex_);
  Stage& s = stage(name);
  if (s.n++ % s.stride == 0) s.wall_s.push_back(wall_s);
  s.max_s = std::max(s.max_s, wall_s);
  s.cpu_s += cpu_s;
  if (s.wall_s.size() < kMostSamples) return;
  halve(s.wall_s);
  s.stride *= 2;
}

std::vector<Timings::Row> Timings::rows() const {
  const std::lock_guard lock(mutex_);
  std::vector<Row> rows;
  for (const Stage& s : stages_) {
    if (s.n == 0) continue;
    rows.push_back({s.name, s.n, kMilliseconds * median(s.wall_s),
                    kMilliseconds * percentile(s.wall_s, 0.95), kMilliseconds * s.max_s, s.cpu_s});
  }
  return rows;
}

std::string Timings::csv() const {
  std::string text = "stage,n,median_ms,p95_ms,max_ms,cpu_s\n";
  for (const Row& r : rows()) {
    text += fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.3f}\n", r.stage, r.n, r.median_ms, r.p95_ms,
                        r.max_ms, r.cpu_s);
  }
  return text;
}

Timings::Scope::Scope(Timings& timings, const std::string& stage)
    : timings_(timings),
      stage_(stage),
      start_(std::chrono::steady_clock::now()),
      cpu_start_s_(thread_cpu_s()) {}

Timings::Scope::~Scope() {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  timings_.add(stage_, wall.count(), thread_cpu_s() - cpu_start_s_);
}

}  // namespace saker::core
