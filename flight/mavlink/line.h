#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "saker/core/time.h"

/// The wire to the autopilot: a serial port, UDP or TCP. Nothing blocks; what breaks is opened
/// again every second.
namespace saker::flight::mavlink {

/// `serial:DEVICE:BAUD`, `udp:HOST:PORT`, `udp:listen:PORT` or `tcp:HOST:PORT`, hosts as IPv4
/// addresses.
struct Address {
  enum class Kind { serial, udp, udp_listen, tcp } kind = Kind::udp_listen;
  std::string place;  ///< device or host
  int number = 0;     ///< baud or port
};

/// Throws Error where it is none of these.
[[nodiscard]] Address parsed_address(const std::string& text);

class Line {
 public:
  struct Counters {
    long opened = 0;
    long received = 0, sent = 0;  ///< bytes
    long dropped = 0;             ///< frames for which there was no room
    long lost = 0;                ///< times that it broke
  };

  static constexpr Time kRetry = kNanosecondsPerSecond;
  static constexpr Time kSilence = 5 * kNanosecondsPerSecond;  ///< then another UDP sender may come
  static constexpr std::size_t kQueue = 4096;                  ///< bytes that wait to be sent

  explicit Line(const Address& address) : address_(address) {}
  ~Line() { close(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// Opens what is closed when it is due, and sends what waits.
  void step(Time now);

  /// What came, up to the buffer's size; of UDP one datagram. Empty: nothing is there.
  [[nodiscard]] std::span<const std::uint8_t> read(std::span<std::uint8_t> buffer, Time now);

  /// One frame, whole or not at all.
  void write(std::span<const std::uint8_t> frame);

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  /// For poll(2); negative: it is not open.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Whether what comes are whole datagrams.
  [[nodiscard]] bool in_datagrams() const {
    return address_.kind != Address::Kind::serial && address_.kind != Address::Kind::tcp;
  }
  /// Why it was not opened or broke, last; empty: it did not.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  void open();
  void open_serial();
  void open_socket();
  void close();
  void broke(const char* what, int error = 0);
  void flush();

  Address address_;
  int descriptor_ = -1;
  bool has_peer_ = false;
  Time next_open_ = 0, heard_at_ = 0;
  std::array<std::uint8_t, kQueue> queue_{};
  std::size_t queued_ = 0;
  std::string fault_;
  Counters counters_;
};

}  // namespace saker::flight::mavlink
