// The ray tree as text for people: a line for each value, a column for each executor.
#include <fmt/format.h>

#include <algorithm>

#include "host/core/github_text.hpp"
#include "host/probe/judge.hpp"
#include "host/probe/probe.hpp"

namespace eyeray::engine::probe {
namespace {

using executors::Backend;
using executors::backend_name;

constexpr const char* bold = "\033[1m";
constexpr const char* red = "\033[31m";
constexpr const char* yellow = "\033[33m";
constexpr const char* plain = "\033[0m";

// The columns of a terminal that the text takes.
size_t width_of(std::string_view text) {
  return size_t(std::ranges::count_if(text, [](char c) { return (uint8_t(c) & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, size_t width) {
  return text + std::string(width - std::min(width, width_of(text)), ' ');
}

std::string numbers(const ProbedValue& value, const Vec3& origin) {
  if (value.type == ProbedValue::Type::boolean) return value.numbers[0] == 0 ? "false" : "true";
  std::string text;
  for (int c = 0; c < value.size; ++c)
    text += fmt::format("{}{:.9g}", c == 0 ? "" : " ", value.numbers[size_t(c)] + (c < 3 ? origin[c] : 0));
  return text;
}

struct Row {
  std::string label;
  std::vector<std::string> cells;  // none in the row of a ray
  Verdict verdict = Verdict::agrees;
  std::string remark = {};
  bool first = false;  // the first difference
};

class Table {
 public:
  explicit Table(const Findings& findings) : findings_(findings), first_(findings.first_difference()) {
    std::vector<std::string> head;
    for (const Participant& p : findings.participants) head.emplace_back(backend_name(p.backend));
    rows_.push_back({"", head});
    findings.overlay.in_order([&](size_t ray) { add_ray(ray); },
                              [&](size_t ray, size_t line) { add_line(ray, line); });
  }

  std::string text(bool colored) const {
    size_t label = 0;
    std::vector<size_t> widths(findings_.participants.size(), 0);
    for (const Row& row : rows_) {
      if (!row.cells.empty()) label = std::max(label, width_of(row.label));
      for (size_t i = 0; i < row.cells.size(); ++i) widths[i] = std::max(widths[i], width_of(row.cells[i]));
    }
    std::string text;
    for (const Row& row : rows_) {
      std::string line = padded(row.label, row.cells.empty() ? 0 : label);
      for (size_t i = 0; i < row.cells.size(); ++i) line += "  " + padded(row.cells[i], widths[i]);
      if (!row.remark.empty()) line += "  " + row.remark;
      line.erase(line.find_last_not_of(' ') + 1);
      const char* const mark = row.verdict == Verdict::differs     ? "≠ "
                               : row.verdict == Verdict::explained ? "~ "
                                                                   : "  ";
      const char* const color = row.first                           ? red
                                : row.verdict == Verdict::explained ? yellow
                                : row.cells.empty()                 ? bold
                                                                    : "";
      text += colored && *color ? fmt::format("{}{}{}{}\n", color, mark, line, plain)
                                : fmt::format("{}{}\n", mark, line);
    }
    return text;
  }

 private:
  std::string indent(size_t ray, int more) const {
    return std::string(size_t(2 * std::max(0, findings_.overlay.depth(ray) + more)), ' ');
  }

  bool is_first(size_t ray, std::optional<size_t> line) const {
    return first_ && first_->ray == ray && first_->line == line;
  }

  static std::string remark_of(Verdict verdict, const std::string& difference, bool first) {
    if (verdict == Verdict::agrees) return "";
    return (first ? "← first difference: " : "← ") + difference +
           (verdict == Verdict::explained ? " (explained)" : "");
  }

  // Adds a row. It becomes printable, because names in it may come from files.
  void add_row(Row row) {
    row.label = log_line(row.label);
    row.remark = log_line(row.remark);
    rows_.push_back(std::move(row));
  }

  void add_ray(size_t i) {
    const Ray& ray = findings_.overlay.rays()[i];
    if (ray.kind == RayKind::pixel) return;
    std::string label = indent(i, 0) + describe(ray);
    if (!findings_.hits[i].empty()) label += " → " + findings_.hits[i];
    add_row(
        {label, {}, ray.verdict, remark_of(ray.verdict, ray.difference, is_first(i, {})), is_first(i, {})});
  }

  void add_line(size_t i, size_t k) {
    const Line& line = findings_.overlay.rays()[i].lines[k];
    const Meaning meaning = meaning_of(line.name);
    const auto zero = [](const std::optional<ProbedValue>& value) {
      return !value || value->numbers == std::array<double, 4>{};
    };
    if (meaning == Meaning::scale || (meaning == Meaning::color && std::ranges::all_of(line.values, zero)) ||
        (line.name.starts_with(first_hit_prefix) && line.verdict == Verdict::agrees))
      return;

    std::vector<std::string> cells;
    const Vec3 origin = meaning == Meaning::point ? findings_.eye : Vec3(0.0);
    std::string before;  // the cell of the executor before it
    std::string location;
    for (size_t e = 0; e < line.values.size(); ++e) {
      const std::optional<ProbedValue>& value = line.values[e];
      const std::string cell = value ? numbers(*value, origin) : "-";
      const bool exact = findings_.participants[e].backend != Backend::reference;
      cells.push_back(exact && value && e > 0 && line.values[0] && value->numbers == line.values[0]->numbers
                          ? "="
                          : cell);
      if (location.empty() && value && !value->file.empty())
        location = fmt::format(" ({}:{})", value->file, value->line);
    }
    std::string remark = remark_of(line.verdict, line.difference, is_first(i, k));
    if (!remark.empty()) remark += location;
    add_row({indent(i, 1) + line.name, cells, line.verdict, remark, is_first(i, k)});
  }

  const Findings& findings_;
  std::optional<Findings::Location> first_;
  std::vector<Row> rows_;
};

// The verdict, in a line.
std::string verdict(const Findings& findings) {
  const auto first = findings.first_difference();
  if (!first) return "nothing differs";
  const Ray& ray = findings.overlay.rays()[first->ray];
  if (!first->line)
    return fmt::format("first difference: {}: {}", findings.way_to(first->ray), ray.difference);
  const Line& line = ray.lines[*first->line];
  return fmt::format("first difference: {}: {}: {}", findings.way_to(first->ray), line.name, line.difference);
}

}  // namespace

std::string to_text(const Findings& findings, bool colored) {
  std::string text =
      fmt::format("pixel {},{} of {} ({}×{}), sample {} of {}: {}\n", findings.x, findings.y, findings.scene,
                  findings.width, findings.height, findings.sample, findings.samples, verdict(findings));
  for (const Participant& p : findings.participants) text += fmt::format("  {}\n", p.description);
  for (const std::string& note : findings.notes) text += fmt::format("  note: {}\n", note);
  return log_lines(text) + Table(findings).text(colored);
}

}  // namespace eyeray::engine::probe
