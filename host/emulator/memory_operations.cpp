#include <cstring>

#include <fmt/format.h>

#include "host/emulator/access.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

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
      const int64_t index = group.whole_number(step.index, step.signed_bits, lane);
      const uint64_t before = step.before,
                     size = root.space == Space::buffer ? group.buffer(root.at).size() : 0;
      const uint64_t count = step.count                     ? step.count
                             : size > before && step.stride ? (size - before) / step.stride
                                                            : 0;
      if (inside && (index < 0 || uint64_t(index) >= count)) {
        inside = false;
        lost_index[lane] = uint32_t(index);
        lost_size[lane] = uint32_t(count);
      }
      if (inside) offset += uint64_t(index) * step.stride;
    }
    to[lane] = inside && offset < nowhere ? uint32_t(offset) : nowhere;
  });
}

// Calls f(lane, byte, word, its cell) for each word of the value at the pointer, where it lies within the
// buffer; g(lane, word) where it does not.
template <typename F, typename G>
void each_buffer_word(Group& group, const Operation& o, size_t size, const F& f, const G& g) {
  const Row offset = group.read(o.from[0], 0);
  group.each_in_order([&](uint32_t lane) {
    for (uint32_t word = 0; word < o.cells.size(); ++word) {
      const Cell& cell = o.cells[word];
      const uint64_t byte = uint64_t{offset[lane]} + cell.byte;
      if (offset[lane] != nowhere && byte + cell.size <= size) {
        f(lane, size_t(byte), word, cell);
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
      if (o.from[0].constant) return copy(group, o.to, {.at = root.at + offset[0], .words = o.words});
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
          if (inside) note(group, o, lane, size_t{at} * 4, 4, false, false);
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
          [&](uint32_t lane, size_t byte, uint32_t word, const Cell& cell) {
            uint32_t value = 0;
            std::memcpy(&value, &bytes[byte], cell.size);
            if (root.space == Space::buffer) note(group, o, lane, byte, cell.size, false, false);
            set(word, lane, value, false);
          },
          [&](uint32_t lane, uint32_t word) { set(word, lane, 0, false); });
      return;
    }
    case Space::image:
      return;  // has operations of its own
  }
}

void store(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row offset = group.read(o.from[0], 0);
  const Source& value = o.from[1];
  switch (root.space) {
    case Space::own:
      if (o.from[0].constant) return copy(group, root.at + offset[0], value);
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
      group.each_in_order([&](uint32_t lane) {
        if (uint64_t{offset[lane]} + value.words > root.size)
          return report_outside(group, o, lane, root.size);
        for (uint32_t word = 0; word < value.words; ++word) {
          const uint32_t at = root.at + offset[lane] + word;
          note(group, o, lane, size_t{at} * 4, 4, true, false);
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
          [&](uint32_t lane, size_t byte, uint32_t word, const Cell& cell) {
            note(group, o, lane, byte, cell.size, true, false);
            const uint32_t number = leave(group, o, lane, group.read(value, word)[lane], cell.real_bits);
            std::memcpy(&bytes[byte], &number, cell.size);
          },
          [](uint32_t, uint32_t) {});
      return;
    }
    case Space::pushed:
    case Space::image:
      return;  // no valid module stores here
  }
}

void array_length(Group& group, const Operation& o) {
  const uint64_t size = group.buffer(group.root(o).at).size();
  const uint32_t before = o.literals[0], stride = o.literals[1];
  const auto count = uint32_t(size > before && stride > 0 ? (size - before) / stride : 0);
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
    case spv::OpControlBarrier:
      return control_barrier;
    case spv::OpMemoryBarrier:
      return memory_barrier;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
