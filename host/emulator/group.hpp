// A work group while it runs. Private to this layer.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/emulator/emulator.hpp"
#include "host/emulator/memory.hpp"
#include "host/emulator/program.hpp"
#include "host/emulator/tracer.hpp"

namespace eyeray::engine::emulator {

// A word of an operand, of each invocation.
struct Row {
  const uint32_t* words;
  uint32_t mask;  // 0 for a constant
  uint32_t operator[](uint32_t lane) const { return words[lane & mask]; }
};

// The state of one dispatch that its work groups share.
struct Dispatch {
  const std::string& name;
  const Program& program;
  const Work& work;
  std::array<uint32_t, 3> groups;
  std::map<uint32_t, Accesses> accesses;  // by binding, of memory that the kernel writes
  uint32_t barriers = 0;                  // work groups' and subgroups', so far
  uint64_t operations = 0;                // operations of single invocations
  Tracer* tracer = nullptr;               // traces one invocation
};

class Group {
 public:
  explicit Group(Dispatch& dispatch);
  // Runs the work group of this number along each axis.
  void run(const std::array<uint32_t, 3>& id);

  // For operations.
  Row read(const Source& source, uint32_t word) const {
    if (source.constant) return {&dispatch_.program.constants[source.at + word], 0};
    return {&registers_[size_t{source.at + word} * lanes_], UINT32_MAX};
  }
  // A whole number of `signed_bits` bits, or an unsigned one if that is 0.
  int64_t whole_number(const Source& source, uint32_t signed_bits, uint32_t lane) const {
    const uint32_t low = read(source, 0)[lane];
    if (source.words == 2) return int64_t(uint64_t{read(source, 1)[lane]} << 32 | low);
    return signed_bits ? int32_t(low << (32 - signed_bits)) >> (32 - signed_bits) : int64_t{low};
  }
  uint32_t* row(uint32_t at) { return &registers_[size_t{at} * lanes_]; }
  std::span<const uint32_t> active() const { return active_; }
  uint32_t lanes() const { return lanes_; }
  uint32_t subgroup_size() const { return dispatch_.work.subgroup_size; }
  // Calls f for every active invocation.
  template <typename F>
  void each(const F& f) const {
    if (active_.size() == lanes_)
      for (uint32_t lane = 0; lane < lanes_; ++lane) f(lane);
    else
      for (const uint32_t lane : active_) f(lane);
  }

  // The same in the order of Work, where the order may matter.
  template <typename F>
  void each_in_order(const F& f) const {
    if (dispatch_.work.order == Order::ascending) return each(f);
    for (size_t n = active_.size(); n-- > 0;) f(active_[n]);
  }

  // Returns false if all invocations have set all words of an operand; looks no closer.
  bool any_unset(const Source& source) const;
  bool unset(const Source& source, uint32_t word, uint32_t lane) const {
    return !source.constant && may_be_unset_[source.at + word] &&
           unset_[size_t{source.at + word} * lanes_ + lane];
  }
  void set_unset(uint32_t at, uint32_t lane, bool unset) {
    if (!unset && !may_be_unset_[at]) return;
    if (!may_be_unset_[at]) std::fill_n(unset_.begin() + ptrdiff_t(size_t{at} * lanes_), lanes_, uint8_t{0});
    may_be_unset_[at] = 1;
    unset_[size_t{at} * lanes_ + lane] = unset;
  }
  // The result is unset where an operand is: a component where the same component is, if the operand has as
  // many; else where any part of the operand is.
  void spread_unset(const Operation& operation, uint32_t components);
  // Reports an operand that decides something, where it is unset.
  void needs_set(const Operation& operation, const Source& source, const char* as);

  const Root& root(const Operation& operation) const { return roots_[operation.root]; }
  std::vector<uint32_t>& shared() { return shared_; }
  std::vector<uint8_t>& shared_unset() { return shared_unset_; }
  Accesses* accesses(const Root& root);  // null for memory that the kernel only reads
  std::span<std::byte> buffer(uint32_t binding) const;
  Image image(uint32_t binding) const;
  // The bytes of a buffer or an image.
  std::span<std::byte> memory(const Root& root) const {
    return root.space == Space::image ? image(root.at).bytes : buffer(root.at);
  }
  // gl_GlobalInvocationID of an invocation in this or another work group.
  std::array<uint32_t, 3> global_id(const std::array<uint32_t, 3>& group, uint32_t lane) const;
  std::array<uint32_t, 3> global_id(const Moment& moment) const;
  std::span<const std::byte> pushed() const { return dispatch_.work.push_constants; }
  Moment moment(uint32_t lane) const;
  void pass_barrier(bool of_group);
  bool whole() const { return active_.size() == lanes_; }

  // Notes that an operation made a NaN of these operands, none of which is one. Returns its number, from 1; 0
  // if there are no more numbers.
  uint32_t birth(const Operation& operation, std::vector<double> operands);
  // Reports the birth of a NaN that this operation writes to its root.
  void report_birth(const Operation& operation, uint32_t lane, uint32_t birth);

  void report(const Operation& operation, uint32_t lane, Fault fault, std::string detail) {
    report(operation.location, lane, fault, std::move(detail));
  }
  void report(const Location& location, uint32_t lane, Fault fault, std::string detail);

 private:
  void start(const std::array<uint32_t, 3>& id);
  void set_built_in(const BuiltIn& built_in, const std::array<uint32_t, 3>& id);
  void run_function(const Function& function, std::vector<uint32_t> lanes);
  void run_block(const Block& block);
  void run_traced(const Block& block);
  void execute(const Operation& operation) {
    if (operation.execute)
      operation.execute(*this, operation);
    else
      call(operation);
  }
  void call(const Operation& operation);
  void leave(const Function& function, const Block& block);
  void choose(const Block& block, std::vector<std::vector<uint32_t>>& ways);
  void go(const Way& way, std::span<const uint32_t> lanes);
  void forget(uint32_t at, uint32_t words, std::span<const uint32_t> lanes);
  void check_effort(uint64_t operations, const Location& location);
  std::array<uint32_t, 3> local_id(uint32_t lane) const;

  Dispatch& dispatch_;
  const uint32_t lanes_;
  std::array<uint32_t, 3> id_{};
  uint32_t number_ = 0;
  std::optional<uint32_t> traced_{};  // the traced invocation, in its work group
  std::vector<uint32_t> registers_;
  std::vector<uint8_t> unset_, may_be_unset_;
  std::vector<uint32_t> shared_;
  std::vector<uint8_t> shared_unset_;
  Accesses shared_accesses_;
  std::vector<Root> roots_;  // the program's, with those of parameters as they are called
  std::vector<uint32_t> active_, all_;
  std::vector<uint32_t> moved_;  // scratch of go()
  struct Birth {
    const Operation* operation;
    std::vector<double> operands;
  };
  struct Births {
    uint32_t count = 0, last = 0;  // the number of the last
  };
  std::vector<Birth> births_;  // in the present work group
  std::unordered_map<const Operation*, Births> births_of_;
  uint32_t depth_ = 0;  // the number of calls within each other
  uint32_t after_group_ = 0;
  std::vector<uint32_t> after_subgroup_;
};

}  // namespace eyeray::engine::emulator
