// Reports on several scenes: a table, JUnit's XML, GitHub's annotations.
#include <fmt/format.h>

#include <algorithm>

#include "host/compare/report.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/github_text.hpp"

namespace eyeray::engine::compare {

namespace {

// The time of one test case, or of all together.
double seconds(std::span<const Report> reports) {
  double sum = 0;
  for (const Report& report : reports) sum += report.seconds;
  return sum;
}

int64_t count(std::span<const Report> reports, std::string_view verdict) {
  return std::ranges::count(reports, verdict, &Report::verdict);
}

int64_t explained_of(const Tally& tally) {
  return tally.explained_pixels();
}
int64_t unexplained_of(const Tally& tally) {
  return tally.unexplained + tally.unexamined;
}

// The numbers of a kernel's buffers that were compared, and those that differ too much.
uint64_t sum(const Report& report, uint64_t BufferResult::* of) {
  uint64_t all = 0;
  for (const BufferResult& result : report.buffers) all += result.*of;
  return all;
}

// "scene", "kernel" or "scenes and kernels", in the plural unless there is one.
std::string kind_of(std::span<const Report> reports) {
  const auto kernels = size_t(std::ranges::count_if(reports, &Report::is_kernel));
  if (kernels > 0 && kernels < reports.size()) return "scenes and kernels";
  return fmt::format("{}{}", kernels > 0 ? "kernel" : "scene", reports.size() == 1 ? "" : "s");
}

// The first failure of a report, for a cell of a table.
std::string first_failure(const Report& report) {
  const std::vector<std::string> failures = report.failures();
  const std::string text = failures.empty() ? report.not_verified : failures.front();
  return text.substr(0, text.find('\n'));
}

// Any text as one line of Markdown or one cell of a table. It is escaped, since Markdown interprets HTML.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : log_line(text)) {
    if (c == '|' || c == '\\') escaped += '\\';
    if (c == '<')
      escaped += "&lt;";
    else if (c == '&')
      escaped += "&amp;";
    else
      escaped += c;
  }
  return escaped;
}

// An annotation of a kernel's source for a finding such as "blur.comp:12:5 (OpLoad %17): race: …". Empty if
// the finding names no line.
std::string annotation_of(const std::string& finding) {
  std::string file = finding.substr(0, finding.find(" ("));
  std::vector<std::string> numbers;  // the column, if it is known, and the line
  for (size_t colon; (colon = file.rfind(':')) != std::string::npos; file.resize(colon)) {
    const std::string number = file.substr(colon + 1);
    if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos) break;
    numbers.push_back(number);
  }
  if (numbers.empty()) return "";
  return fmt::format("::error file={},line={},{}title=eyeray verify::{}\n", github_text(file, true),
                     numbers.back(), numbers.size() > 1 ? fmt::format("col={},", numbers[0]) : "",
                     github_text(finding, false));
}

}  // namespace

std::string to_row(const Report& report, size_t width) {
  // The name is padded by hand: fmt counts bytes of text that is no UTF-8.
  const std::string name = log_line(report.scene);
  const std::string start = fmt::format("{:<7} {}{}", report.verdict(), name,
                                        std::string(width - std::min(width, name.size()), ' '));
  if (!report.not_verified.empty()) return fmt::format("{}  {}\n", start, log_line(first_failure(report)));
  if (report.is_kernel())
    return fmt::format("{}  {:>11} numbers {:>17} differ {:>10.2f} s\n", start,
                       sum(report, &BufferResult::numbers), sum(report, &BufferResult::beyond),
                       report.seconds);
  return fmt::format("{}  {:>5}×{:<5} {:>7} explained {:>7} unexplained {:>8.2f} s\n", start,
                     report.area.width, report.area.height, report.count(explained_of),
                     report.count(unexplained_of), report.seconds);
}

std::string summary(std::span<const Report> reports) {
  std::string text = fmt::format("{} {} in {:.1f} s: ", reports.size(), kind_of(reports), seconds(reports));
  const int64_t failed = count(reports, "failed"), skipped = count(reports, "skipped");
  if (failed + skipped == 0) return text + "all passed\n";
  text += fmt::format("{} passed", count(reports, "passed"));
  const auto add = [&](int64_t number, std::string_view verdict) {
    if (number == 0) return;
    text += fmt::format(", {} {} (", number, verdict);
    const char* comma = "";
    for (const Report& report : reports) {
      if (report.verdict() != verdict) continue;
      text += comma + log_line(report.scene);
      comma = ", ";
    }
    text += ')';
  };
  add(failed, "failed");
  add(skipped, "skipped");
  return text + '\n';
}

std::string to_junit(std::span<const Report> reports) {
  const std::string totals =
      fmt::format(R"(tests="{}" failures="{}" errors="0" skipped="{}" time="{:.3f}")", reports.size(),
                  count(reports, "failed"), count(reports, "skipped"), seconds(reports));
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"eyeray verify\" {0}>\n"
      "<testsuite name=\"eyeray verify\" {0}>\n",
      totals);
  for (const Report& report : reports) {
    const std::string name = xml_text(report.scene);
    text += fmt::format(R"(<testcase classname="eyeray.verify" name="{0}" file="{0}" time="{1:.3f}">)", name,
                        report.seconds);
    if (report.verdict() == "failed")
      text += fmt::format("\n<failure message=\"{}\">{}</failure>", xml_text(first_failure(report)),
                          xml_text(to_text(report)));
    else if (report.verdict() == "skipped")
      text += fmt::format("\n<skipped message=\"{}\"/>", xml_text(first_failure(report)));
    else
      text += fmt::format("\n<system-out>{}</system-out>", xml_text(to_text(report)));
    text += "\n</testcase>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

std::string to_annotations(std::span<const Report> reports) {
  std::string text;
  for (const Report& report : reports) {
    for (const Participant& each : report.participants)
      if (report.is_kernel() && each.findings)
        for (const std::string& finding : *each.findings) text += annotation_of(finding);
    for (const std::string& failure : report.failures())
      text += fmt::format("::error file={},title=eyeray verify::{}\n", github_text(report.scene, true),
                          github_text(failure.substr(0, failure.find('\n')), false));
  }
  return text;
}

std::string to_markdown(std::span<const Report> reports) {
  std::string all = summary(reports);
  all.pop_back();
  std::string text = fmt::format("### eyeray verify\n\n{}\n\n", cell(all));
  text += "| scene | verdict | pixels | explained | unexplained | seconds | first failure |\n";
  text += "| --- | --- | ---: | ---: | ---: | ---: | --- |\n";
  for (const Report& report : reports) {
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {:.2f} | {} |\n", cell(report.scene), report.verdict(),
        report.is_kernel() ? int64_t(sum(report, &BufferResult::numbers)) : report.area.pixels(),
        report.count(explained_of),
        report.is_kernel() ? int64_t(sum(report, &BufferResult::beyond)) : report.count(unexplained_of),
        report.seconds, cell(first_failure(report)));
  }
  return text;
}

}  // namespace eyeray::engine::compare
