#pragma once

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace saker::lidar::testing {

/// Allocations beyond what is held now and `most` bytes fail while it lives.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t most) {
    ::getrlimit(RLIMIT_DATA, &before_);
    rlimit limit = before_;
    limit.rlim_cur = held() + most + kQuarantine;
    ::setrlimit(RLIMIT_DATA, &limit);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_DATA, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
#ifdef __SANITIZE_ADDRESS__
  static constexpr rlim_t kQuarantine = rlim_t{1} << 30;  // the sanitiser keeps what was freed
#else
  static constexpr rlim_t kQuarantine = 0;
#endif

  static rlim_t held() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word && word != "VmData:") {
    }
    rlim_t kilobytes = 0;
    status >> kilobytes;
    return kilobytes << 10;
  }

  rlimit before_ = {};
};

}  // namespace saker::lidar::testing
