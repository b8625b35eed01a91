#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "flight/ground/access.h"
#include "flight/ground/hub.h"

namespace saker::flight::ground {

struct ServerConfig {
  std::string address = "127.0.0.1";  ///< of the interface
  int port = 8765;                    ///< 0: a free one
  std::filesystem::path page;         ///< folder of the page's files
  std::optional<Credentials> tls;     ///< none: plain, for this machine alone
  std::size_t most_clients = 64;
};

/// Page and WebSocket on one port (libwebsockets), in a thread of its own. Nothing that a client
/// does makes it wait for it: what one does not take waits in its session (session.h), bounded.
class Server {
 public:
  /// \param hub  outlives this. Throws Error where the port cannot be had.
  Server(const ServerConfig& config, Hub& hub);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] int port() const;
  /// What a person opens: "http://127.0.0.1:8765/"; a key, which no log is to hold, not with it.
  [[nodiscard]] std::string address() const;
  /// Connections that were refused: without the key, of another site, or one too many.
  [[nodiscard]] long refused() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace saker::flight::ground
