#include <algorithm>

#include <fmt/ranges.h>

#include "host/compute/probe.hpp"

namespace eyeray::engine::compute {
namespace {

constexpr size_t most_columns = 110;  // in a line of values
constexpr size_t most_numbers = 24;   // written numbers in the text

std::string describe(const emulator::TracedValue& value) {
  using Kind = emulator::TracedValue::Kind;
  switch (value.kind) {
    case Kind::read:
      return fmt::format(
          "{} is {}{}", value.name, value.value,
          value.writer ? fmt::format(", from invocation {}", fmt::join(*value.writer, ",")) : "");
    case Kind::write:
      return fmt::format("{} = {}", value.name, value.value);
    case Kind::branch:
      return "condition: " + value.value;
    case Kind::result:
      return value.name.empty() ? "returns " + value.value : fmt::format("{} = {}", value.name, value.value);
    case Kind::barrier:
      return "barrier";
  }
  return "";
}

// The values in lines of some width.
std::string values_of(const emulator::TracedLine& line) {
  std::string text, row;
  for (const emulator::TracedValue& each : line.values) {
    const std::string value = describe(each);
    if (!row.empty() && row.size() + value.size() > most_columns) {
      text += "          " + row + "\n";
      row.clear();
    }
    row += (row.empty() ? "" : "; ") + value;
  }
  return row.empty() ? text : text + "          " + row + "\n";
}

std::string verdict(const Probed& probed) {
  const bool both = std::ranges::any_of(probed.numbers, [](const ProbedNumber& n) { return !n.gpu.empty(); });
  if (const std::optional<size_t> first = probed.first_difference()) {
    const ProbedNumber& number = probed.numbers[*first];
    const std::string by =
        number.by.line ? fmt::format(", written at {}:{}", number.by.file, number.by.line) : "";
    return fmt::format("gpu and emulator differ in {} of {} numbers; the first is {}: {} against {}{}",
                       std::ranges::count_if(probed.numbers, &ProbedNumber::differs), probed.numbers.size(),
                       number.name, number.gpu, number.emulator, by);
  }
  if (probed.numbers.empty()) return "it writes nothing";
  return both ? "gpu and emulator agree" : "emulator alone";
}

std::string table(const Probed& probed) {
  const size_t rows = std::min(probed.numbers.size(), most_numbers);
  size_t name = 8, value = 8;
  for (size_t n = 0; n < rows; ++n) {
    name = std::max(name, probed.numbers[n].name.size());
    value = std::max(value, probed.numbers[n].emulator.size());
  }
  std::string text;
  const auto add = [&](const std::string& first, const std::string& second, const std::string& third) {
    text += fmt::format("  {:{}}  {:{}}  {}", first, name, second, value, third);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  for (size_t n = 0; n < rows; ++n) {
    const ProbedNumber& each = probed.numbers[n];
    if (n == 0) add("it wrote", "emulator", each.gpu.empty() ? "" : "gpu");
    add(each.name, each.emulator,
        each.gpu.empty()  ? ""
        : each.apart == 0 ? "="
        : each.differs    ? "≠ " + each.gpu
                          : each.gpu);
  }
  if (rows < probed.numbers.size()) text += fmt::format("  and {} more\n", probed.numbers.size() - rows);
  return text;
}

}  // namespace

std::string to_text(const Job& job, const Probed& probed) {
  std::string text =
      fmt::format("invocation {} of {} ({}, {}): {}\n", fmt::join(probed.trace.invocation, ","), job.file,
                  job.kernel, describe_dispatch(job), verdict(probed));
  for (const std::string& each : probed.executors) text += "  " + each + "\n";
  std::string file;
  for (size_t n = 0; n < probed.trace.lines.size(); ++n) {
    const emulator::TracedLine& line = probed.trace.lines[n];
    if (line.file != file) text += (file = line.file) + "\n";
    text += line.line ? fmt::format("{:6}  {}\n", line.line, probed.source[n]) : probed.source[n] + "\n";
    text += values_of(line);
  }
  text += table(probed);
  for (const std::string& each : probed.notes) text += each + "\n";
  return text;
}

}  // namespace eyeray::engine::compute
