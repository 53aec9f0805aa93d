#include "host/cli/probe_kernel.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/compute/probe.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/open_device.hpp"
#include "host/program/integers.hpp"
#include "host/program/json.hpp"

namespace eyeray::engine::cli {
namespace {

using program::Json;

std::array<uint32_t, 3> parse_invocation(const std::string& text) {
  int numbers[3]{};
  for (size_t count = 1; count <= 3; ++count)
    if (program::parse_integers(text, ',', std::span(numbers).first(count)) &&
        std::ranges::all_of(numbers, [](int each) { return each >= 0; }))
      return {uint32_t(numbers[0]), uint32_t(numbers[1]), uint32_t(numbers[2])};
  throw Error(ExitCode::bad_input,
              "an invocation must be X,Y,Z, its gl_GlobalInvocationID, such as 5,0,0, not '{}'", text);
}

const char* kind_name(emulator::TracedValue::Kind kind) {
  using Kind = emulator::TracedValue::Kind;
  switch (kind) {
    case Kind::read:
      return "read";
    case Kind::write:
      return "write";
    case Kind::branch:
      return "branch";
    case Kind::result:
      return "result";
    case Kind::barrier:
      return "barrier";
  }
  return "";
}

Json to_json(const compute::Job& job, const compute::Probed& probed) {
  Json lines = Json::array();
  for (size_t n = 0; n < probed.trace.lines.size(); ++n) {
    const emulator::TracedLine& line = probed.trace.lines[n];
    Json values = Json::array();
    for (const emulator::TracedValue& each : line.values) {
      Json value{{"kind", kind_name(each.kind)}};
      if (!each.name.empty()) value["name"] = each.name;
      if (!each.value.empty()) value["value"] = each.value;
      if (each.writer) value["writer"] = *each.writer;
      values.push_back(std::move(value));
    }
    lines.push_back(
        {{"file", line.file}, {"line", line.line}, {"text", probed.source[n]}, {"values", values}});
  }
  Json numbers = Json::array();
  for (const compute::ProbedNumber& each : probed.numbers)
    numbers.push_back({{"name", each.name},
                       {"emulator", each.emulator},
                       {"gpu", each.gpu.empty() ? Json() : Json(each.gpu)},
                       {"apart", each.apart},
                       {"differs", each.differs},
                       {"file", each.by.file},
                       {"line", each.by.line}});
  const std::optional<size_t> first = probed.first_difference();
  return {{"kernel", job.kernel},
          {"invocation", probed.trace.invocation},
          {"executors", probed.executors},
          {"first_difference", first ? Json(probed.numbers[*first].name) : Json()},
          {"lines", lines},
          {"wrote", numbers},
          {"notes", probed.notes}};
}

}  // namespace

ExitCode probe_kernel(const ProbedKernel& kernel, const executors::ExecutorOptions& executor) {
  const auto runs_on = [&](executors::Backend backend) {
    return kernel.backends.empty() || std::ranges::find(kernel.backends, backend) != kernel.backends.end();
  };
  if (!runs_on(executors::Backend::emulator))
    throw Error(ExitCode::bad_input, "--backends must name the emulator, which traces a kernel's invocation");
  const compute::ProbeOptions how{
      .run = {executors::device_options(executor.gpu, false), executor.gpu.fast_math},
      .on_device = runs_on(executors::Backend::gpu),
      .invocation = parse_invocation(kernel.invocation),
      .follow = kernel.follow};
  const compute::Job job = compute::load_job(kernel.file, kernel.defines);
  for (const Diagnostic& warning : job.warnings) print_lines(stderr, "{}\n", format_diagnostic(warning));
  const compute::Probed probed = compute::probe(job, how);
  if (kernel.json)
    program::print_json(to_json(job, probed));
  else
    print_lines(stdout, "{}", compute::to_text(job, probed));
  return probed.first_difference() ? ExitCode::comparison_failed : ExitCode::ok;
}

}  // namespace eyeray::engine::cli
