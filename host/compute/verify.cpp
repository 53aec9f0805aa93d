#include "host/compute/verify.hpp"

#include <algorithm>
#include <cmath>

#include "host/compute/data_file.hpp"
#include "host/core/error.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::compute {
namespace {

// The difference of reals that a comparison allows.
struct Allowance {
  uint64_t ulp = 0;
  double absolute = 0;
};

compare::BufferResult compare_buffers(const Type& type, std::span<const std::byte> a,
                                      std::span<const std::byte> b, const Allowance& allowed) {
  compare::BufferResult result{.value = {}, .other = {}, .buffer = {}};
  result.ulp = allowed.ulp;
  result.absolute = allowed.absolute;
  for_each_number(type, 0, [&](const Number& number, uint64_t offset) {
    ++result.numbers;
    const std::byte *one = a.data() + offset, *other = b.data() + offset;
    const uint64_t apart = distance(number, one, other);
    if (apart == 0) return;
    ++result.different;
    const bool real = number.kind == NumberKind::real;
    if (real) result.largest = std::max(result.largest, apart);
    const double difference = std::fabs(read_number(number, one) - read_number(number, other));
    if (real && (apart <= allowed.ulp || difference <= allowed.absolute)) return;
    if (++result.beyond > 1) return;
    result.first = fmt::format("{}: {} against {}{}", path_of(type, offset), show_number(number, one),
                               show_number(number, other), real ? fmt::format(", {} ULP", apart) : "");
  });
  return result;
}

void add_participant(const Outcome& outcome, compare::Report& report) {
  compare::Participant& participant =
      report.participants.emplace_back(compare::Participant{.name = outcome.executor,
                                                            .description = outcome.description,
                                                            .seconds = outcome.seconds,
                                                            .soundness = {}});
  if (outcome.executor != "emulator") return;
  participant.findings.emplace();
  for (const emulator::Finding& each : outcome.findings)
    participant.findings->push_back(emulator::describe(each));
}

void keep_evidence(const Job& job, const Outcome& outcome, const std::filesystem::path& folder) {
  make_folder(folder);
  for (size_t i = 0; i < job.buffers.size(); ++i)
    if (job.buffers[i].slot.writable)
      write_block(folder / fmt::format("{}-{}.npy", outcome.executor, job.buffers[i].slot.name),
                  *job.buffers[i].type, outcome.buffers[i], 0);
}

class Verifier {
 public:
  Verifier(const Job& job, const VerifyOptions& options) : job_(job), options_(options) {}

  compare::Report verify() {
    const Stopwatch watch;
    report_.scene = job_.file;
    report_.dispatch = fmt::format("{}, {}", job_.kernel, describe_dispatch(job_));
    // The emulator goes first: it names a fault that could crash the device.
    if (options_.emulated) outcomes_.push_back(run_by(true, job_));
    const bool dangerous = options_.emulated && std::ranges::any_of(outcomes_[0].findings, is_dangerous);
    if (options_.on_device && !dangerous) outcomes_.insert(outcomes_.begin(), run_by(false, job_));
    for (const Outcome& outcome : outcomes_) add_participant(outcome, report_);
    if (options_.on_device && options_.emulated) compare_executors(dangerous);
    if (options_.emulated && !dangerous) compare_orders();
    compare_with_files();
    if (job_.same) compare_with_kernel(*job_.same);
    report_.seconds = watch.seconds();
    if (!options_.evidence.empty() && (options_.keep_always || !report_.passes())) {
      for (const Outcome& outcome : outcomes_) keep_evidence(job_, outcome, options_.evidence);
      report_.kept = options_.evidence.string();
    }
    return std::move(report_);
  }

 private:
  Outcome run_by(bool emulated, const Job& job, bool descending = false) const {
    RunOptions how = options_.run;
    how.device.emulated_descending = descending;
    how.device.emulate = emulated;
    return run(job, how);
  }

  void add(compare::BufferResult result, char gate, std::string value, std::string other,
           const std::string& buffer) {
    result.gate = gate;
    result.value = std::move(value);
    result.other = std::move(other);
    result.buffer = buffer;
    report_.buffers.push_back(std::move(result));
  }

  // Gate A.
  void compare_executors(bool dangerous) {
    const Allowance allowed{std::max(job_.ulp, options_.ulp), 0};
    for (size_t i = 0; i < job_.buffers.size(); ++i) {
      const JobBuffer& buffer = job_.buffers[i];
      if (!buffer.slot.writable || !buffer.compared) continue;
      compare::BufferResult result{.value = {}, .other = {}, .buffer = {}};
      if (dangerous)
        result.incomparable = "the gpu did not run the kernel, since a fault of gate S could crash it";
      else
        result = compare_buffers(*buffer.type, outcomes_[0].buffers[i], outcomes_[1].buffers[i], allowed);
      add(std::move(result), 'A', "gpu", "emulator", buffer.slot.name);
    }
  }

  // Gate S, too: a result may not depend on the order of work groups and invocations.
  void compare_orders() {
    const Outcome other = run_by(true, job_, true);
    const Outcome& first = outcomes_.back();
    for (size_t i = 0; i < job_.buffers.size(); ++i) {
      const JobBuffer& buffer = job_.buffers[i];
      if (!buffer.slot.writable || !buffer.compared) continue;
      add(compare_buffers(*buffer.type, first.buffers[i], other.buffers[i], {job_.ulp, 0}), 'S', "emulator",
          "emulator in descending order", buffer.slot.name);
    }
  }

  // Gate G.
  void compare_with_files() {
    for (const Expectation& each : job_.expected)
      add(compare_buffers(*job_.buffers[each.buffer].type, outcomes_[0].buffers[each.buffer], each.bytes,
                          {each.ulp, each.absolute}),
          'G', outcomes_[0].executor, each.file, job_.buffers[each.buffer].slot.name);
  }

  // Gate K.
  void compare_with_kernel(const SameAs& same) {
    const Outcome other = run_by(outcomes_[0].executor == "emulator", *same.job);
    for (const auto& [here, there] : same.buffers)
      add(compare_buffers(*job_.buffers[here].type, outcomes_[0].buffers[here], other.buffers[there],
                          {same.ulp, 0}),
          'K', job_.kernel, same.job->kernel, job_.buffers[here].slot.name);
  }

  const Job& job_;
  const VerifyOptions& options_;
  std::vector<Outcome> outcomes_;  // the device's first
  compare::Report report_;
};

}  // namespace

bool is_dangerous(const emulator::Finding& finding) {
  return finding.fault == emulator::Fault::out_of_bounds ||
         finding.fault == emulator::Fault::divergent_barrier || finding.fault == emulator::Fault::unreachable;
}

compare::Report verify_job(const Job& job, const VerifyOptions& options) {
  return Verifier(job, options).verify();
}

}  // namespace eyeray::engine::compute
