#include "host/compute/probe.hpp"

#include <algorithm>

#include <fmt/ranges.h>

#include "host/compute/source_lines.hpp"
#include "host/compute/verify.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::compute {
namespace {

void check_invocation(const Job& job, const std::array<uint32_t, 3>& invocation) {
  std::array<uint64_t, 3> last{};
  bool inside = true;
  for (size_t axis = 0; axis < 3; ++axis) {
    last[axis] = uint64_t{job.groups[axis]} * job.local_size[axis] - 1;
    inside = inside && invocation[axis] <= last[axis];
  }
  if (!inside)
    throw Error(ExitCode::bad_input,
                "{} has no invocation {}: invocations are numbered from 0,0,0 to {} ({})", job.file,
                fmt::join(invocation, ","), fmt::join(last, ","), describe_dispatch(job));
}

// The variable that `follow` names, without its elements and members.
void check_name(const Job& job, const emulator::Trace& trace) {
  const std::string name = trace.follow.substr(0, trace.follow.find_first_of(".["));
  if (trace.names.contains(name)) return;
  const std::vector<std::string_view> names(trace.names.begin(), trace.names.end());
  const std::string nearest = nearest_name(name, names);
  throw Error(ExitCode::bad_input, "{} has no variable `{}`: {}", job.kernel, name,
              nearest.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                              : fmt::format("did you mean `{}`?", nearest));
}

// The number of a value at a byte, and where it begins.
struct PlacedNumber {
  Number number{};
  uint64_t offset = 0;
};
std::optional<PlacedNumber> number_at(const Type& type, uint64_t byte, uint64_t start = 0) {
  if (type.form == Form::number) return PlacedNumber{type.number, start};
  if (type.element) {
    if (type.stride == 0) return std::nullopt;
    const uint64_t skipped = byte / type.stride * type.stride;
    return number_at(*type.element, byte - skipped, start + skipped);
  }
  const Member* found = nullptr;
  for (const Member& member : type.members)
    if (member.offset <= byte && (!found || member.offset >= found->offset)) found = &member;
  if (!found) return std::nullopt;
  return number_at(*found->type, byte - found->offset, start + found->offset);
}

std::vector<ProbedNumber> written_numbers(const Job& job, const emulator::Trace& trace,
                                          const Outcome& emulated, const std::optional<Outcome>& device) {
  std::map<std::pair<uint32_t, uint64_t>, ProbedNumber> numbers;  // by binding and byte
  for (const auto& [at, write] : trace.written) {
    const auto& [binding, byte] = at;
    if (binding >= job.buffers.size()) continue;
    const JobBuffer& buffer = job.buffers[binding];
    const std::optional<PlacedNumber> placed = number_at(*buffer.type, byte);
    if (!placed || placed->offset + placed->number.bytes() > buffer.bytes.size()) continue;
    ProbedNumber& made = numbers[{binding, placed->offset}];
    made.by = write;
    made.name = buffer.slot.name + path_of(*buffer.type, placed->offset);
    const std::byte* const value = &emulated.buffers[binding][size_t(placed->offset)];
    made.emulator = show_number(placed->number, value);
    if (!device) continue;
    const std::byte* const other = &device->buffers[binding][size_t(placed->offset)];
    made.gpu = show_number(placed->number, other);
    made.apart = distance(placed->number, value, other);
    made.differs = made.apart > (placed->number.kind == NumberKind::real ? job.ulp : 0);
  }
  std::vector<ProbedNumber> sorted;
  for (auto& [at, number] : numbers) sorted.push_back(std::move(number));
  std::ranges::stable_sort(sorted, {}, [](const ProbedNumber& each) { return each.by.order; });
  return sorted;
}

}  // namespace

std::optional<size_t> Probed::first_difference() const {
  const auto found = std::ranges::find_if(numbers, &ProbedNumber::differs);
  return found == numbers.end() ? std::nullopt : std::optional(size_t(found - numbers.begin()));
}

Probed probe(const Job& job, const ProbeOptions& options) {
  check_invocation(job, options.invocation);
  Probed probed;
  probed.trace.invocation = options.invocation;
  probed.trace.follow = options.follow;
  RunOptions how = options.run;
  how.device.emulate = true;
  how.trace = &probed.trace;
  const Outcome emulated = run(job, how);
  if (!options.follow.empty()) check_name(job, probed.trace);

  const bool dangerous = std::ranges::any_of(emulated.findings, is_dangerous);
  std::optional<Outcome> device;
  if (options.on_device && !dangerous) device = run(job, options.run);
  if (options.on_device && dangerous)
    probed.notes.push_back("The gpu did not run the kernel, since a fault of it could crash the gpu.");
  probed.numbers = written_numbers(job, probed.trace, emulated, device);
  if (device) probed.executors.push_back(device->description);
  probed.executors.push_back(emulated.description);

  if (probed.trace.cut)
    probed.notes.push_back(
        fmt::format("The invocation ran more lines. The first {} are kept, and --follow NAME selects lines.",
                    emulator::most_traced_lines));
  if (!options.follow.empty() && probed.trace.lines.empty())
    probed.notes.push_back(fmt::format("The invocation does not access {}.", options.follow));
  if (!emulated.findings.empty())
    probed.notes.push_back(fmt::format(
        "The emulator found {} in the dispatch; the first is {}",
        emulated.findings.size() == 1 ? "1 fault" : fmt::format("{} faults", emulated.findings.size()),
        emulator::describe(emulated.findings[0])));
  SourceLines source(job.spirv);
  for (const emulator::TracedLine& each : probed.trace.lines)
    probed.source.push_back(each.line ? source.line(each.file, each.line) : each.instruction);
  return probed;
}

}  // namespace eyeray::engine::compute
