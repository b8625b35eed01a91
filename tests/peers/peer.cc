#include "peer.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "made_bag.h"
#include "paths.h"
#include "saker/lidar/cursor.h"

namespace saker::lidar::testing {
namespace {

namespace fs = std::filesystem;

bool of_node(const std::string& script) { return script.ends_with(".cjs"); }

/// Runs a command line; its status and output.
std::string run(const std::string& command) {
  std::FILE* pipe = ::popen(fmt::format("{} 2>&1", command).c_str(), "r");
  std::string said;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
  const int status = ::pclose(pipe);
  return status == 0 && said.empty() ? "" : fmt::format("status {}: {}", status, said);
}

std::string quoted(const std::string& text) { return fmt::format("'{}'", text); }

}  // namespace

fs::path node_modules() { return fs::path(source_dir()) / "build" / "peers" / "node_modules"; }

std::string missing_for(const std::string& script) {
  const bool ros = !of_node(script) || script == "write_mcap.cjs";  // its LZ4 is ROS's
  if (ros && !run("/usr/bin/python3 -c 'import rosbag, sensor_msgs, roslz4'").empty()) {
    return "no python3-rosbag: scripts/setup --peers installs it";
  }
  if (of_node(script) && (!fs::exists(node_modules()) || !run("node -e 0").empty())) {
    return "no npm packages of others: scripts/setup --peers installs them";
  }
  return "";
}

std::string run_peer(const std::string& script, const std::vector<std::string>& arguments) {
  const std::string path = fmt::format("{}/tests/peers/{}", source_dir(), script);
  std::string command = of_node(script)
                            ? fmt::format("NODE_PATH={} node", quoted(node_modules().string()))
                            : "/usr/bin/python3 -B";
  command += fmt::format(" {}", quoted(path));
  for (const std::string& argument : arguments) command += fmt::format(" {}", quoted(argument));
  return run(command);
}

void write_messages(const std::vector<MadeMessage>& messages, const fs::path& file) {
  MessageWriter writer(Encoding::kRos1);
  for (const MadeMessage& message : messages) {
    writer.text(message.topic);
    writer.text(message.type);
    writer.number(message.received);
    writer.bytes(message.bytes);
  }
  write_bytes(file, writer.done());
}

std::vector<MadeMessage> read_messages(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)),
                                        std::istreambuf_iterator<char>());
  Cursor cursor(bytes);
  const auto text = [&] {
    return std::string(text_of(cursor.take(cursor.number<std::uint32_t>())));
  };
  std::vector<MadeMessage> messages;
  while (cursor.left() > 0 && cursor.ok()) {
    MadeMessage message;
    message.topic = text();
    message.type = text();
    message.received = cursor.number<std::int64_t>();
    const ByteView content = cursor.take(cursor.number<std::uint32_t>());
    message.bytes.assign(content.begin(), content.end());
    messages.push_back(std::move(message));
  }
  return messages;
}

std::vector<double> numbers_of(const MadeMessage& message) {
  std::vector<double> numbers(message.bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), message.bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

}  // namespace saker::lidar::testing
