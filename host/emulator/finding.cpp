#include "host/emulator/finding.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace eyeray::engine::emulator {

const char* name(Fault fault) {
  switch (fault) {
    case Fault::out_of_bounds:
      return "out of bounds";
    case Fault::uninitialised:
      return "not initialised";
    case Fault::race:
      return "race";
    case Fault::divergent_barrier:
      return "divergent barrier";
    case Fault::undefined_integer:
      return "undefined integer";
    case Fault::unreachable:
      return "unreachable";
    case Fault::not_a_number:
      return "not a number";
  }
  return "unknown";
}

std::string describe(const Finding& finding) {
  const std::string times = finding.count > 1 ? fmt::format("; {} times", finding.count) : "";
  return fmt::format("{}: {}: {}, in invocation {}, {}, {} of kernel '{}'{}", finding.location,
                     name(finding.fault), finding.detail, finding.invocation[0], finding.invocation[1],
                     finding.invocation[2], finding.kernel, times);
}

void Findings::add(Finding finding) {
  const auto key = std::tuple(finding.kernel, finding.location, finding.fault);
  if (findings_.size() == most_findings && !findings_.contains(key)) return;
  const uint64_t count = std::max<uint64_t>(1, finding.count);
  finding.count = 0;
  findings_.try_emplace(key, std::move(finding)).first->second.count += count;
}

std::vector<Finding> Findings::all() const {
  std::vector<Finding> all;
  for (const auto& [key, finding] : findings_) all.push_back(finding);
  return all;
}

}  // namespace eyeray::engine::emulator
