// Memory that invocations share, and who touched it last. Private to this layer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace eyeray::engine::emulator {

// An invocation at a time. Accesses of two invocations are ordered by a barrier of their work group or
// subgroup in between, and by nothing else.
struct Moment {
  uint32_t group = 0, subgroup = 0;              // number of the work group, and of the subgroup in it
  uint32_t invocation = 0;                       // number in the work group
  uint32_t after_group = 0, after_subgroup = 0;  // counts of the barriers passed since the dispatch began

  bool ordered_with(const Moment& other) const {
    if (group != other.group) return false;
    if (invocation == other.invocation || after_group != other.after_group) return true;
    return subgroup == other.subgroup && after_subgroup != other.after_subgroup;
  }
};

// The last accesses of each unit of memory in the present dispatch.
class Accesses {
 public:
  // Forgets all, for memory of so many bytes, and units of `unit` bytes.
  void restart(size_t bytes, uint32_t unit);
  uint32_t unit() const { return unit_; }

  // Notes an access of a unit. Returns the earlier one with which it is a race, if any: unordered, one of the
  // two writes, and one of them is not atomic.
  std::optional<Moment> note(size_t unit, const Moment& now, bool writes, bool atomic);
  // The last writer of a unit, if any.
  std::optional<Moment> writer(size_t unit) const;

 private:
  enum Kind : uint32_t { none, plain, by_atomic };
  struct Access {
    Moment moment;
    Kind kind = none;
  };
  // Two of many readers suffice: a later writer then finds another one than itself.
  struct Unit {
    Access writer, reader, other_reader;
  };
  static bool conflicts(const Access& access, const Moment& now, bool atomic);

  uint32_t unit_ = 4;
  std::vector<Unit> units_;
};

}  // namespace eyeray::engine::emulator
