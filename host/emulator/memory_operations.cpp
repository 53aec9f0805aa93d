#include <cstring>

#include <fmt/format.h>

#include "host/emulator/executes.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr uint32_t texel_bytes = 16;

// "texel 12 of 8 in 'Data'".
void report_outside(Group& group, const Operation& o, uint32_t lane, const char* unit, int64_t at,
                    uint64_t size) {
  const std::string& name = group.root(o).name;
  const std::string in = name.empty() ? "" : fmt::format(" in '{}'", name);
  group.report(o, lane, Fault::out_of_bounds, fmt::format("{} {} of {}{}", unit, at, size, in));
}

// The same of an access by the pointer o.from[0], whose root has this size: "index 12 of 8 in 'Data'".
void report_outside(Group& group, const Operation& o, uint32_t lane, uint64_t size) {
  const Source& pointer = o.from[0];
  const uint32_t offset = group.read(pointer, 0)[lane];
  if (offset == nowhere)
    return report_outside(group, o, lane, "index", int32_t(group.read(pointer, 1)[lane]),
                          group.read(pointer, 2)[lane]);
  const Space space = group.root(o).space;
  const bool words = space == Space::own || space == Space::shared;
  report_outside(group, o, lane, words ? "number" : "byte", offset, size);
}

// Notes an access to a word of memory that invocations share, and reports a race. `word` counts from the
// start of the buffer, or of the work group's memory.
void note(Group& group, const Operation& o, uint32_t lane, size_t word, bool writes, bool atomic) {
  const Root& root = group.root(o);
  Accesses* const accesses = root.space == Space::shared ? &group.shared_accesses() : group.accesses(root.at);
  if (!accesses) return;
  const Moment now = group.moment(lane);
  if (writes ? accesses->write(word, now, atomic) : accesses->read(word, now, atomic)) return;
  group.report(
      o, lane, Fault::race,
      fmt::format(
          "two invocations access number {} of '{}', one of them writes, and no barrier is in between",
          word - (root.space == Space::shared ? root.at : 0), root.name));
}

void access_chain(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row base = group.read(o.from[0], 0);
  uint32_t *to = group.row(o.to), *lost_index = group.row(o.to + 1), *lost_size = group.row(o.to + 2);
  for (const Step& step : o.steps) group.needs_set(o, step.index, "an index was never set");
  group.each([&](uint32_t lane) {
    uint64_t offset = base[lane];
    bool inside = offset != nowhere;
    if (!inside) {
      lost_index[lane] = group.read(o.from[0], 1)[lane];
      lost_size[lane] = group.read(o.from[0], 2)[lane];
    }
    offset += o.literals[0];
    for (const Step& step : o.steps) {
      const uint32_t index = group.read(step.index, 0)[lane];
      const uint64_t before = step.before,
                     size = root.space == Space::buffer ? group.buffer(root.at).size() : 0;
      const uint64_t count = step.count                     ? step.count
                             : size > before && step.stride ? (size - before) / step.stride
                                                            : 0;
      if (inside && index >= count) {
        inside = false;
        lost_index[lane] = index;
        lost_size[lane] = uint32_t(count);
      }
      offset += uint64_t{index} * step.stride;
    }
    to[lane] = inside && offset < nowhere ? uint32_t(offset) : nowhere;
  });
}

// Calls f(lane, byte, word) for each word of the value at the pointer, where it lies within the buffer;
// g(lane, word) where it does not.
template <typename F, typename G>
void each_buffer_word(Group& group, const Operation& o, size_t size, const F& f, const G& g) {
  const Row offset = group.read(o.from[0], 0);
  group.each([&](uint32_t lane) {
    for (uint32_t word = 0; word < o.bytes.size(); ++word) {
      const uint64_t byte = uint64_t{offset[lane]} + o.bytes[word];
      if (offset[lane] != nowhere && byte + 4 <= size) {
        f(lane, size_t(byte), word);
      } else {
        if (word == 0 || offset[lane] != nowhere) report_outside(group, o, lane, size);
        g(lane, word);
      }
    }
  });
}

void load(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row offset = group.read(o.from[0], 0);
  const auto set = [&](uint32_t word, uint32_t lane, uint32_t value, bool unset) {
    group.row(o.to + word)[lane] = value;
    group.set_unset(o.to + word, lane, unset);
  };
  switch (root.space) {
    case Space::own: {
      if (o.from[0].constant) {
        const Source source{.at = root.at + offset[0], .words = o.words};
        Operation copy{.to = o.to, .words = o.words, .from = {source}};
        return concatenate(group, copy);
      }
      const bool may_be_unset = group.any_unset({.at = root.at, .words = root.size});
      group.each([&](uint32_t lane) {
        const bool inside = uint64_t{offset[lane]} + o.words <= root.size;
        if (!inside) report_outside(group, o, lane, root.size);
        for (uint32_t word = 0; word < o.words; ++word) {
          const uint32_t at = root.at + (inside ? offset[lane] : 0) + word;
          set(word, lane, inside ? group.row(at)[lane] : 0,
              inside && may_be_unset && group.unset({.at = at, .words = 1}, 0, lane));
        }
      });
      return;
    }
    case Space::shared:
      group.each([&](uint32_t lane) {
        const bool inside = uint64_t{offset[lane]} + o.words <= root.size;
        if (!inside) report_outside(group, o, lane, root.size);
        for (uint32_t word = 0; word < o.words; ++word) {
          const uint32_t at = root.at + (inside ? offset[lane] : 0) + word;
          if (inside) note(group, o, lane, at, false, false);
          set(word, lane, inside ? group.shared()[at] : 0, inside && group.shared_unset()[at]);
        }
      });
      return;
    case Space::buffer:
    case Space::pushed: {
      const std::span<const std::byte> bytes =
          root.space == Space::buffer ? std::span<const std::byte>(group.buffer(root.at)) : group.pushed();
      each_buffer_word(
          group, o, bytes.size(),
          [&](uint32_t lane, size_t byte, uint32_t word) {
            uint32_t value = 0;
            std::memcpy(&value, &bytes[byte], 4);
            if (root.space == Space::buffer) note(group, o, lane, byte / 4, false, false);
            set(word, lane, value, false);
          },
          [&](uint32_t lane, uint32_t word) { set(word, lane, 0, false); });
    }
  }
}

void store(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row offset = group.read(o.from[0], 0);
  const Source& value = o.from[1];
  switch (root.space) {
    case Space::own:
      if (o.from[0].constant) {
        const Operation copy{.to = root.at + offset[0], .words = value.words, .from = {value}};
        return concatenate(group, copy);
      }
      group.each([&](uint32_t lane) {
        if (uint64_t{offset[lane]} + value.words > root.size)
          return report_outside(group, o, lane, root.size);
        for (uint32_t word = 0; word < value.words; ++word) {
          const uint32_t at = root.at + offset[lane] + word;
          group.row(at)[lane] = group.read(value, word)[lane];
          group.set_unset(at, lane, group.unset(value, word, lane));
        }
      });
      return;
    case Space::shared:
      group.each([&](uint32_t lane) {
        if (uint64_t{offset[lane]} + value.words > root.size)
          return report_outside(group, o, lane, root.size);
        for (uint32_t word = 0; word < value.words; ++word) {
          const uint32_t at = root.at + offset[lane] + word;
          note(group, o, lane, at, true, false);
          group.shared()[at] = group.read(value, word)[lane];
          group.shared_unset()[at] = group.unset(value, word, lane);
        }
      });
      return;
    case Space::buffer: {
      const std::span<std::byte> bytes = group.buffer(root.at);
      group.needs_set(o, value, "a number was never set, and is stored into a buffer");
      each_buffer_word(
          group, o, bytes.size(),
          [&](uint32_t lane, size_t byte, uint32_t word) {
            note(group, o, lane, byte / 4, true, false);
            const uint32_t number = group.read(value, word)[lane];
            std::memcpy(&bytes[byte], &number, 4);
          },
          [](uint32_t, uint32_t) {});
      return;
    }
    case Space::pushed:
      return;  // read only: no valid module stores here
  }
}

void array_length(Group& group, const Operation& o) {
  const uint64_t size = group.buffer(group.root(o).at).size();
  const uint32_t before = o.literals[0], stride = o.literals[1];
  group.each(
      [&](uint32_t lane) { group.row(o.to)[lane] = size > before ? uint32_t((size - before) / stride) : 0; });
}

// F(the old number, the operands): the new one.
template <auto F, bool Writes = true>
void atomic(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row offset = group.read(o.from[0], 0);
  for (size_t n = 1; n < o.from.size(); ++n) group.needs_set(o, o.from[n], "an atomic operand was never set");
  const bool shared = root.space == Space::shared;
  const std::span<std::byte> bytes =
      shared ? std::as_writable_bytes(std::span(group.shared())) : group.buffer(root.at);
  group.each([&](uint32_t lane) {
    const uint64_t byte = shared ? (uint64_t{root.at} + offset[lane]) * 4 : uint64_t{offset[lane]};
    const uint64_t end = shared ? (uint64_t{root.at} + root.size) * 4 : bytes.size();
    if (offset[lane] == nowhere || byte + 4 > end) {
      report_outside(group, o, lane, shared ? root.size : end);
      group.row(o.to)[lane] = 0;
      return;
    }
    note(group, o, lane, size_t(byte / 4), Writes, true);
    uint32_t before = 0;
    std::memcpy(&before, &bytes[size_t(byte)], 4);
    if (shared && group.shared_unset()[size_t(byte / 4)])
      group.report(o, lane, Fault::uninitialised, "an atomic changes shared memory that was never set");
    const uint32_t a = o.from.size() > 1 ? group.read(o.from[1], 0)[lane] : 0;
    const uint32_t b = o.from.size() > 2 ? group.read(o.from[2], 0)[lane] : 0;
    const uint32_t after = F(before, a, b);
    std::memcpy(&bytes[size_t(byte)], &after, 4);
    if (shared) group.shared_unset()[size_t(byte / 4)] = 0;
    group.row(o.to)[lane] = before;
  });
}

void atomic_store(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  if (root.space == Space::shared) {
    const Row offset = group.read(o.from[0], 0);
    group.each([&](uint32_t lane) {
      if (offset[lane] < root.size) group.shared_unset()[root.at + offset[lane]] = 0;
    });
  }
  // The old number goes to the register of no value.
  Operation set = o;
  set.to = group.scratch();
  atomic<([](uint32_t, uint32_t value, uint32_t) { return value; })>(group, set);
}

// A texel is four words.
template <bool Writes>
void texel(Group& group, const Operation& o) {
  const std::span<std::byte> bytes = group.buffer(group.root(o).at);
  group.needs_set(o, o.from[0], "a texel's number was never set");
  if (Writes) group.needs_set(o, o.from[1], "a number was never set, and is stored into a buffer");
  const Row at = group.read(o.from[0], 0);
  group.each([&](uint32_t lane) {
    const uint64_t first = uint64_t{at[lane]} * texel_bytes;
    const bool inside = first + texel_bytes <= bytes.size();
    if (!inside) report_outside(group, o, lane, "texel", at[lane], bytes.size() / texel_bytes);
    for (uint32_t word = 0; word < 4; ++word) {
      const size_t byte = size_t(first) + 4 * word;
      if (inside) note(group, o, lane, byte / 4, Writes, false);
      if constexpr (Writes) {
        const uint32_t number = word < o.from[1].words ? group.read(o.from[1], word)[lane] : 0;
        if (inside) std::memcpy(&bytes[byte], &number, 4);
      } else if (word < o.words) {
        uint32_t number = 0;
        if (inside) std::memcpy(&number, &bytes[byte], 4);
        group.row(o.to + word)[lane] = number;
      }
    }
  });
}

void texels(Group& group, const Operation& o) {
  const auto count = uint32_t(group.buffer(group.root(o).at).size() / texel_bytes);
  group.each([&](uint32_t lane) { group.row(o.to)[lane] = count; });
}

// o.literals: the scope of execution, that of memory, its semantics.
void control_barrier(Group& group, const Operation& o) {
  const bool of_group = o.literals[0] <= spv::ScopeWorkgroup;
  if (of_group && !group.whole())
    group.report(o, group.active().front(), Fault::divergent_barrier,
                 fmt::format("{} of {} invocations of the work group come to a barrier",
                             group.active().size(), group.lanes()));
  group.pass_barrier(of_group);
}

void memory_barrier(Group&, const Operation&) {}

}  // namespace

Execute memory_operation(spv::Op op) {
  using U = uint32_t;
  using S = int32_t;
  switch (op) {
    case spv::OpAccessChain:
      return access_chain;
    case spv::OpLoad:
      return load;
    case spv::OpStore:
    case spv::OpCopyMemory:
      return store;
    case spv::OpArrayLength:
      return array_length;
    case spv::OpImageRead:
    case spv::OpImageFetch:
      return texel<false>;
    case spv::OpImageWrite:
      return texel<true>;
    case spv::OpImageQuerySize:
      return texels;
    case spv::OpControlBarrier:
      return control_barrier;
    case spv::OpMemoryBarrier:
      return memory_barrier;
    case spv::OpAtomicLoad:
      return atomic<([](U before, U, U) { return before; }), false>;
    case spv::OpAtomicStore:
      return atomic_store;
    case spv::OpAtomicExchange:
      return atomic<([](U, U value, U) { return value; })>;
    case spv::OpAtomicCompareExchange:
      return atomic<([](U before, U value, U expected) { return before == expected ? value : before; })>;
    case spv::OpAtomicIIncrement:
      return atomic<([](U before, U, U) { return before + 1; })>;
    case spv::OpAtomicIDecrement:
      return atomic<([](U before, U, U) { return before - 1; })>;
    case spv::OpAtomicIAdd:
      return atomic<([](U before, U value, U) { return before + value; })>;
    case spv::OpAtomicISub:
      return atomic<([](U before, U value, U) { return before - value; })>;
    case spv::OpAtomicSMin:
      return atomic<([](U before, U value, U) { return S(value) < S(before) ? value : before; })>;
    case spv::OpAtomicSMax:
      return atomic<([](U before, U value, U) { return S(value) > S(before) ? value : before; })>;
    case spv::OpAtomicUMin:
      return atomic<([](U before, U value, U) { return value < before ? value : before; })>;
    case spv::OpAtomicUMax:
      return atomic<([](U before, U value, U) { return value > before ? value : before; })>;
    case spv::OpAtomicAnd:
      return atomic<([](U before, U value, U) { return before & value; })>;
    case spv::OpAtomicOr:
      return atomic<([](U before, U value, U) { return before | value; })>;
    case spv::OpAtomicXor:
      return atomic<([](U before, U value, U) { return before ^ value; })>;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
