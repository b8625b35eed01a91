#include "flight/mavlink/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight::mavlink {
namespace {

constexpr double kSame = 1e-5;         // relative: parameters are floats
constexpr double kLatencyOff_ms = 15;  // half of a period of ODOMETRY
constexpr double kUnbounded = 1e9;
constexpr std::size_t kLongestName = 16;

bool same(double a, double b) { return std::abs(a - b) <= kSame * std::max(1.0, std::abs(b)); }

void check(const ParameterTable& table, const std::string& where) {
  std::set<std::string> names;
  for (const ExpectedParameter& parameter : table.parameters) {
    const std::string& name = parameter.name;
    if (name.empty() || name.size() > kLongestName) {
      throw Error(fmt::format("{}: parameter \"{}\", expected 1 to {} characters", where, name,
                              kLongestName));
    }
    if (!names.insert(name).second) throw Error(fmt::format("{}: {} named twice", where, name));
    if (parameter.values.empty() && !parameter.bounded() && !parameter.latency) {
      throw Error(fmt::format("{}: {}: expected values, least or most, latency or our_system",
                              where, name));
    }
  }
  if (names.empty()) throw Error(fmt::format("{}: no parameters", where));
}

}  // namespace

bool ExpectedParameter::bounded() const { return least > -kUnbounded || most < kUnbounded; }

bool ExpectedParameter::fits(double value, double latency_ms) const {
  if (!std::isfinite(value)) return false;
  if (latency) return std::isnan(latency_ms) || std::abs(value - latency_ms) <= kLatencyOff_ms;
  if (bounded()) return value >= least && value <= most;
  return std::ranges::any_of(values, [&](double right) { return same(value, right); });
}

double ExpectedParameter::wanted(double latency_ms) const {
  if (latency) return std::round(latency_ms);
  return values.empty() ? NAN : values.front();
}

std::string ExpectedParameter::expected_text(double latency_ms) const {
  if (latency) {
    return std::isnan(latency_ms) ? "the latency (--latency-ms)"
                                  : fmt::format("{:.0f} ± {:.0f}", latency_ms, kLatencyOff_ms);
  }
  if (!bounded()) return fmt::format("{:g}", fmt::join(values, " or "));
  if (least <= -kUnbounded) return fmt::format("at most {:g}", most);
  if (most >= kUnbounded) return fmt::format("at least {:g}", least);
  return fmt::format("{:g} … {:g}", least, most);
}

ParameterTable read_parameter_table(const std::filesystem::path& file, int our_system) {
  auto table = core::config_from_yaml<ParameterTable>(core::read_file(file), file.string(),
                                                      ParameterTable{});
  for (ExpectedParameter& parameter : table.parameters)
    if (parameter.our_system) parameter.values = {static_cast<double>(our_system)};
  check(table, file.string());
  return table;
}

}  // namespace saker::flight::mavlink
