// A work group while it runs. Private to this layer.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "host/emulator/emulator.hpp"
#include "host/emulator/memory.hpp"
#include "host/emulator/program.hpp"

namespace eyeray::engine::emulator {

// A word of an operand, of each invocation.
struct Row {
  const uint32_t* words;
  uint32_t mask;  // 0 for a constant
  uint32_t operator[](uint32_t lane) const { return words[lane & mask]; }
};

// The state of one dispatch that its work groups share.
struct Dispatch {
  const Program& program;
  const Work& work;
  std::array<uint32_t, 3> groups;
  std::map<uint32_t, Accesses> accesses;  // by binding, of buffers that the kernel writes
  uint32_t barriers = 0;                  // work groups' and subgroups', so far
  uint64_t operations = 0;                // operations of single invocations
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
  uint32_t* row(uint32_t at) { return &registers_[size_t{at} * lanes_]; }
  std::span<const uint32_t> active() const { return active_; }
  uint32_t lanes() const { return lanes_; }
  uint32_t scratch() const { return dispatch_.program.scratch; }
  uint32_t subgroup_size() const { return dispatch_.work.subgroup_size; }
  // Calls f for every active invocation.
  template <typename F>
  void each(const F& f) const {
    if (active_.size() == lanes_)
      for (uint32_t lane = 0; lane < lanes_; ++lane) f(lane);
    else
      for (const uint32_t lane : active_) f(lane);
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
  // The result is unset where any operand is.
  void spread_unset(const Operation& operation);
  // Reports an operand that decides something, where it is unset.
  void needs_set(const Operation& operation, const Source& source, const char* as);

  const Root& root(const Operation& operation) const { return roots_[operation.root]; }
  std::vector<uint32_t>& shared() { return shared_; }
  std::vector<uint8_t>& shared_unset() { return shared_unset_; }
  Accesses& shared_accesses() { return shared_accesses_; }
  Accesses* accesses(uint32_t binding);  // null for a buffer that the kernel only reads
  std::span<std::byte> buffer(uint32_t binding) const;
  std::span<const std::byte> pushed() const { return dispatch_.work.push_constants; }
  Moment moment(uint32_t lane) const;
  void pass_barrier(bool of_group);
  bool whole() const { return active_.size() == lanes_; }

  void report(const Operation& operation, uint32_t lane, Fault fault, std::string detail) {
    report(operation.location, lane, fault, std::move(detail));
  }
  void report(const Location& location, uint32_t lane, Fault fault, std::string detail);

 private:
  void start(const std::array<uint32_t, 3>& id);
  void set_built_in(const BuiltIn& built_in, const std::array<uint32_t, 3>& id);
  void run_function(const Function& function, std::vector<uint32_t> lanes);
  void run_block(const Block& block);
  void call(const Operation& operation);
  void go(const Way& way, std::span<const uint32_t> lanes);
  void forget(uint32_t at, uint32_t words, std::span<const uint32_t> lanes);
  void check_effort(size_t operations);
  std::array<uint32_t, 3> local_id(uint32_t lane) const;

  Dispatch& dispatch_;
  const uint32_t lanes_;
  std::array<uint32_t, 3> id_{};
  uint32_t number_ = 0;
  std::vector<uint32_t> registers_;
  std::vector<uint8_t> unset_, may_be_unset_;
  std::vector<uint32_t> shared_;
  std::vector<uint8_t> shared_unset_;
  Accesses shared_accesses_;
  std::vector<Root> roots_;  // the program's, with those of parameters as they are called
  std::vector<uint32_t> active_, all_;
  std::vector<uint32_t> moved_;  // scratch of go()
  uint32_t after_group_ = 0;
  std::vector<uint32_t> after_subgroup_;
};

}  // namespace eyeray::engine::emulator
