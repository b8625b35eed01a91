#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "flight/base_station/store.h"
#include "flight/ground/hub.h"

namespace saker::flight::ground {

/// What the base station's store holds, for people (`/store`, saker.Store of topics.md): who told
/// what, and when. It is read beside the process that writes it, and never written.
class StoreNews {
 public:
  explicit StoreNews(std::string file) : file_(std::move(file)) {}

  /// All that it holds, where that changed since the last call; nothing where it did not, where it
  /// is not there or where it cannot be read. \param t  s, the system clock: of what came since
  [[nodiscard]] std::optional<Json> take(double t);

 private:
  void read(double t);

  std::string file_;
  bool read_before_ = false;
  StoreReport report_;
  std::map<exchange::StreamId, double> came_;  ///< t at which a stream was found to have grown
  std::string said_, fault_;
};

/// JSON Schema of `/store`.
[[nodiscard]] const std::string& store_schema();

/// Says the news of a store to the hub, in a thread of its own: a disk may take its time.
class StoreWatch {
 public:
  /// \param hub  outlives this
  StoreWatch(std::string file, Hub& hub);
  ~StoreWatch();
  StoreWatch(const StoreWatch&) = delete;
  StoreWatch& operator=(const StoreWatch&) = delete;

 private:
  void run();

  StoreNews news_;
  Hub& hub_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::thread thread_;  // last: it uses what stands above
};

}  // namespace saker::flight::ground
