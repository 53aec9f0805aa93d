#include "host/executors/shader_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <sstream>

#include "host/core/text_scanner.hpp"

namespace eyeray::engine::executors {
namespace {

// The host names the shaders' kinds of rays where it knows no records (core/ray_tree.hpp).
static_assert(uint32_t(RayKind::eye) == RAY_EYE && uint32_t(RayKind::reflected) == RAY_REFLECTED);
static_assert(uint32_t(RayKind::refracted) == RAY_REFRACTED && uint32_t(RayKind::shadow) == RAY_SHADOW);

double number(uint32_t type, uint32_t bits) {
  switch (type) {
    case PROBE_FLOAT:
      return double(std::bit_cast<float>(bits));
    case PROBE_INT:
      return double(int32_t(bits));
    default:
      return double(bits);
  }
}

ProbedValue::Type type_of(uint32_t type) {
  using enum ProbedValue::Type;
  return type == PROBE_FLOAT ? real : type == PROBE_BOOL ? boolean : integer;
}

// NAME of each `PROBE(NAME, …)` in a line.
std::vector<std::string_view> probed_names(std::string_view line) {
  std::vector<std::string_view> names;
  TextScanner scanner(line);
  while (!scanner.rest().empty()) {
    if (scanner.word() != "PROBE") {
      scanner.skip(scanner.rest().substr(0, 1));
      continue;
    }
    scanner.skip_spaces();
    if (!scanner.skip("(")) continue;
    scanner.skip_spaces();
    const std::string_view name = scanner.word();
    scanner.skip_spaces();
    if (!name.empty() && !(name[0] >= '0' && name[0] <= '9') && name[0] != '_' && scanner.skip(","))
      names.push_back(name);
  }
  return names;
}

}  // namespace

ShaderProbe::ShaderProbe(const std::map<std::string, std::string, std::less<>>& files) {
  for (const auto& [file, text] : files) {
    std::istringstream lines(text);
    uint32_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      for (const std::string_view name : probed_names(line))
        positions_[std::string(name)].push_back({file, number});
    }
  }
}

std::string ShaderProbe::defines() const {
  std::string text = fmt::format("#define PROBING\n#define PROBE_CAPACITY {}u\n", RayRecorder::most);
  uint32_t number = 0;
  for (const auto& [name, positions] : positions_)
    text += fmt::format("#define {} {}u\n", fmt::format("PROBED_{}", name), number++);
  return text;
}

RayTree ShaderProbe::tree(std::span<const shader::ProbeRecord> records) const {
  const uint32_t requested = records[0].name, kept = std::min(requested, uint32_t(records.size() - 1));
  std::vector<std::string_view> names;
  for (const auto& [name, positions] : positions_) names.push_back(name);

  RayRecorder recorder;
  for (const shader::ProbeRecord& record : records.subspan(1, kept)) {
    if (record.name == PROBE_OPENS_RAY) {
      recorder.ray(RayKind(record.value.x), record.value.y, record.value.z);
    } else if (record.name == PROBE_RETURNS) {
      recorder.back(record.value.x);
    } else if (record.name < names.size()) {
      ProbedValue value{.name = std::string(names[record.name]),
                        .type = type_of(record.type),
                        .size = std::clamp(int(record.size), 1, 4),
                        .line = record.line};
      for (int i = 0; i < value.size; ++i) value.numbers[size_t(i)] = number(record.type, record.value[i]);
      recorder.value(std::move(value));
    }
  }
  recorder.lose(requested - kept);
  name_files(recorder.tree());
  return std::move(recorder.tree());
}

void ShaderProbe::name_files(RayTree& tree) const {
  for (ProbedRay& ray : tree.rays) {
    for (ProbedValue& value : ray.values) {
      const auto found = positions_.find(value.name);
      if (found == positions_.end()) continue;
      const auto position = std::ranges::find(found->second, value.line, &Position::line);
      if (position != found->second.end()) value.file = position->file;
    }
  }
}

}  // namespace eyeray::engine::executors
