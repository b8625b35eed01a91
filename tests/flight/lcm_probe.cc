#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "flight/bus/bus.h"
#include "saker/exchange/seal.h"

/// Says and hears raw messages on an LCM network, for tests by processes.
///   lcm_probe say URL CHANNEL HEX COUNT RATE_HZ     COUNT messages: HEX and a number of 4 bytes
///   lcm_probe seal KEY SENDER CHANNEL HEX           prints it sealed, in hex
///   lcm_probe hear URL SECONDS SUFFIX…              prints CHANNEL HEX of what is heard
namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

constexpr int kBufferKb = 256;

Bytes of_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

void print_hex(Bus::Bytes bytes) {
  for (const std::uint8_t byte : bytes) std::printf("%02x", byte);
  std::printf("\n");
}

void say(const std::vector<std::string>& words) {
  Bus bus = Bus::on_network(words.at(0), kBufferKb, "PROBE");
  const int count = std::stoi(words.at(3));
  const std::chrono::duration<double> period(1 / std::stod(words.at(4)));
  auto next = Steady::now();
  for (int i = 0; i < count; ++i) {
    Bytes bytes = of_hex(words.at(2));
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(i >> shift));
    bus.publish_raw(words.at(1), bytes);
    next += std::chrono::duration_cast<Steady::duration>(period);
    std::this_thread::sleep_until(next);
  }
}

void seal(const std::vector<std::string>& words) {
  exchange::Sealer sealer(exchange::read_key(words.at(0)), words.at(1), "");
  const Bytes payload = of_hex(words.at(3));
  const auto sealed = sealer.seal(words.at(2), std::string(payload.begin(), payload.end()));
  print_hex(Bytes(sealed->begin(), sealed->end()));
}

void hear(const std::vector<std::string>& words) {
  Bus bus = Bus::on_network(words.at(0), kBufferKb, "PROBE");
  for (std::size_t i = 2; i < words.size(); ++i) {
    bus.subscribe_raw(words[i], [](const std::string& channel, Bus::Bytes bytes) {
      std::printf("%s ", channel.c_str());
      print_hex(bytes);
      return true;
    });
  }
  const auto seconds = std::chrono::duration<double>(std::stod(words.at(1)));
  const auto end = Steady::now() + std::chrono::duration_cast<Steady::duration>(seconds);
  while (Steady::now() < end) bus.handle(std::chrono::milliseconds(20));
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 2), argv + argc);
  const std::string verb = argc > 1 ? argv[1] : "";
  try {
    if (verb == "say") saker::flight::say(words);
    if (verb == "seal") saker::flight::seal(words);
    if (verb == "hear") saker::flight::hear(words);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
