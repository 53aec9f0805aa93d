// Memory that invocations share, and who touched its words last. Private to this layer.
#pragma once

#include <cstddef>
#include <cstdint>
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

// The last accesses of each word in the present dispatch.
class Accesses {
 public:
  // Forgets all, for `words` words.
  void restart(size_t words);

  // Notes an access. False for a race with an earlier one: unordered, one of the two writes, and one of them
  // is not atomic.
  bool read(size_t word, const Moment& now, bool atomic);
  bool write(size_t word, const Moment& now, bool atomic);

 private:
  struct Access {
    Moment moment;
    uint8_t kind = 0;  // none, plain, atomic
  };
  struct Word {
    Access writer, reader, other_reader;
  };
  std::vector<Word> words_;
};

}  // namespace eyeray::engine::emulator
