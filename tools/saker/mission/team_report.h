#pragma once

#include <filesystem>
#include <string>

#include "tools/saker/mission/team_flights.h"

namespace saker::tools {

/// {"mission", "seed", "robots": [{…}], "merged": {…}}: see docs/contract.md.
[[nodiscard]] Json team_results(const TeamFlights& flights, const TeamSite& site,
                                const TeamMission& mission, std::uint64_t seed,
                                const std::filesystem::path& out);

/// The paper's multi-robot table: a column a robot here is a row, then all together.
[[nodiscard]] std::string team_table(const Json& results);

/// map.json, map.smap, truth.json, prior.json (all in base) and map.png.
void write_team_maps(const TeamFlights& flights, const TeamSite& site,
                     const objects::ClassTable& table, const std::filesystem::path& out);

}  // namespace saker::tools
