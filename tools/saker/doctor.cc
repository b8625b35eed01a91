#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "flight/bus/machine.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

using flight::Finding;
using flight::Weight;

const char* word(Weight weight) {
  constexpr const char* kWords[] = {"ok", "worse", "wrong"};
  return kWords[static_cast<int>(weight)];
}

void print(const Finding& finding) {
  fmt::print("{:<6} {:<24} {}\n", word(finding.weight), finding.subject, finding.found);
  if (finding.weight != Weight::fine) fmt::print("{:<6} mend with: {}\n", "", finding.remedy);
}

int doctor(const CommonOptions& common) {
  const flight::MachineNeeds needs{.bus = read_configuration(common).bus};
  const std::vector<Finding> findings = flight::check_machine(needs);
  for (const Finding& finding : findings) print(finding);
  const auto grounding = std::count_if(findings.begin(), findings.end(), [](const Finding& f) {
    return f.weight == Weight::grounding;
  });
  if (grounding == 0) {
    fmt::print("nothing keeps a mission from flying\n");
    return 0;
  }
  fmt::print("{} to mend before a mission can fly\n", grounding);
  return 1;
}

}  // namespace

void add_doctor(Commands& commands) {
  commands.add(
      {.name = "doctor",
       .does = "what on this machine would keep a mission from flying, and the command that "
               "mends it; status 1 when there is such a thing",
       .example = "saker doctor"},
      doctor);
}

}  // namespace saker::tools
