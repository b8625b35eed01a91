#pragma once

#include <filesystem>
#include <optional>
#include <string>

/// Who may connect, and what is needed for it.
namespace saker::flight::ground {

/// What a client says when it opens its WebSocket.
struct Knock {
  std::string host;    ///< of the address that it was given, with the port
  std::string origin;  ///< of the page that opens it; empty: none, it is no browser
  std::string key;     ///< in the address
};

/// With the key everybody may. Without it, where only this machine is listened to, programs and
/// pages of this machine: a page of another site that a browser of this machine shows may not, nor
/// one that has made its name mean this machine.
class Gate {
 public:
  Gate(std::string key, bool this_machine_alone)
      : key_(std::move(key)), this_machine_alone_(this_machine_alone) {}

  [[nodiscard]] bool admits(const Knock& knock) const;

 private:
  std::string key_;
  bool this_machine_alone_;
};

/// "localhost:8765", "127.0.0.1", "[::1]:8765".
[[nodiscard]] bool is_this_machine(const std::string& host);

/// A file of the page for the path of a request ("/", "/main.js"); nothing for what leads out of
/// the folder, is hidden, is no file, or of a kind that no page is made of.
[[nodiscard]] std::optional<std::filesystem::path> page_file(const std::filesystem::path& page,
                                                             const std::string& path);
/// "text/html; charset=utf-8"; null for a kind that no page is made of.
[[nodiscard]] const char* media_type(const std::filesystem::path& file);

/// The folder of the page: flight/ground/page of the source tree beside the build's program, or
/// share/saker/ground beside an installed one. Throws Error where there is none.
[[nodiscard]] std::filesystem::path page_folder();

struct Credentials {
  std::string key;                 ///< 128 bits, for the address
  std::filesystem::path key_file;  ///< where it is
  std::filesystem::path certificate, private_key;
  std::string fingerprint;  ///< SHA-256 of the certificate, as browsers show it
};

/// Those of the folder, drawn where it has none: key, and a certificate that the server signs
/// itself for `address`. Readable by their owner alone. Throws Error where they cannot be written.
[[nodiscard]] Credentials credentials(const std::filesystem::path& folder,
                                      const std::string& address);

}  // namespace saker::flight::ground
