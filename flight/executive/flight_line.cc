#include "flight/executive/flight_line.h"

#include <fmt/format.h>

#include "flight/process/process.h"

namespace saker::flight {
namespace {

std::string known(double value, int digits, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.{}f} {}", value, digits, unit) : "-";
}

}  // namespace

std::string flight_line(const FlightStatus& status) {
  std::string line = status.phase;
  if (status.targets > 0) line += fmt::format("  target {} of {}", status.target, status.targets);
  line += fmt::format("  height {}  battery {}  clearance {}", known(status.height_m, 1, "m"),
                      known(100 * status.battery_share, 0, "%"), known(status.clearance_m, 1, "m"));
  if (!status.worst_loop.empty()) {
    line += fmt::format("  worst loop {} {} late", status.worst_loop,
                        known(status.lateness_ms, 1, "ms"));
  }
  return line;
}

FlightLine::FlightLine() {
  if (line_.on_terminal()) log_above_a_line(true);
}

FlightLine::~FlightLine() {
  line_.keep();
  if (line_.on_terminal()) log_above_a_line(false);
}

void FlightLine::show(const FlightStatus& status) { line_.show(flight_line(status)); }

}  // namespace saker::flight
