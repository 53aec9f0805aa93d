#include <cstring>

#include "host/emulator/access.hpp"
#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

// F(the old number, the operands): the new one. An atomic store has no result.
template <typename T, auto F, bool Writes = true>
void atomic(Group& group, const Operation& o) {
  const Root& root = group.root(o);
  const Row offset = group.read(o.from[0], 0);
  for (size_t n = 1; n < o.from.size(); ++n) group.needs_set(o, o.from[n], "an atomic operand was never set");
  const bool shared = root.space == Space::shared;
  const std::span<std::byte> bytes =
      shared ? std::as_writable_bytes(std::span(group.shared())) : group.memory(root);
  group.each_in_order([&](uint32_t lane) {
    const uint64_t byte = shared ? (uint64_t{root.at} + offset[lane]) * 4 : uint64_t{offset[lane]};
    const uint64_t end = shared ? (uint64_t{root.at} + root.size) * 4 : bytes.size();
    if (offset[lane] == nowhere || byte + sizeof(T) > end) {
      report_outside(group, o, lane, shared ? root.size : end);
      if (o.words > 0) target<T>(group, o, 0).set(lane, 0);
      return;
    }
    note(group, o, lane, size_t(byte), sizeof(T), Writes, true);
    T before{};
    std::memcpy(&before, &bytes[size_t(byte)], sizeof(T));
    if (shared && o.words > 0 && group.shared_unset()[size_t(byte / 4)])
      group.report(o, lane, Fault::uninitialised, "an atomic changes shared memory that was never set");
    const T a = o.from.size() > 1 ? column<T>(group, o.from[1], 0)[lane] : T{};
    const T b = o.from.size() > 2 ? column<T>(group, o.from[2], 0)[lane] : T{};
    T after = F(before, a, b);
    if constexpr (is_real<T>) {
      // Shared memory may hold a NaN with its birth, and buffers may not.
      const uint64_t words = words_of_number<T>(after);
      const uint32_t high = uint32_t(sizeof(T) == 8 ? words >> 32 : words);
      const uint32_t left = shared ? high : leave(group, o, lane, high, sizeof(T) * 8);
      after = number_of<T>(sizeof(T) == 8 ? uint32_t(words) : left, left);
    }
    std::memcpy(&bytes[size_t(byte)], &after, sizeof(T));
    if (shared)
      for (size_t word = size_t(byte / 4); word < (size_t(byte) + sizeof(T)) / 4; ++word)
        group.shared_unset()[word] = 0;
    if (o.words > 0) target<T>(group, o, 0).set(lane, before);
  });
}

template <auto F, bool Writes = true>
Execute atomic_naturals(uint32_t bits) {
  return bits == 64 ? atomic<uint64_t, F, Writes> : atomic<uint32_t, F, Writes>;
}
template <auto F>
Execute atomic_integers(uint32_t bits) {
  return bits == 64 ? atomic<int64_t, F> : atomic<int32_t, F>;
}
template <auto F>
Execute atomic_reals(uint32_t bits) {
  return bits == 64 ? atomic<double, F> : atomic<float, F>;
}

constexpr auto lower_one = [](auto before, auto x, auto) { return x < before ? x : before; };
constexpr auto higher_one = [](auto before, auto x, auto) { return x > before ? x : before; };
constexpr auto second = [](auto, auto x, auto) { return x; };

}  // namespace

Execute atomic_operation(spv::Op op, uint32_t bits, bool real) {
  if (bits < 32) return nullptr;
  switch (op) {
    case spv::OpAtomicLoad:
      return atomic_naturals<([](auto before, auto, auto) { return before; }), false>(bits);
    case spv::OpAtomicStore:
    case spv::OpAtomicExchange:
      return real ? atomic_reals<second>(bits) : atomic_naturals<second>(bits);
    case spv::OpAtomicCompareExchange:
      return atomic_naturals<(
          [](auto before, auto x, auto expected) { return before == expected ? x : before; })>(bits);
    case spv::OpAtomicIIncrement:
      return atomic_naturals<([](auto before, auto, auto) { return before + 1; })>(bits);
    case spv::OpAtomicIDecrement:
      return atomic_naturals<([](auto before, auto, auto) { return before - 1; })>(bits);
    case spv::OpAtomicIAdd:
      return atomic_naturals<([](auto before, auto x, auto) { return before + x; })>(bits);
    case spv::OpAtomicISub:
      return atomic_naturals<([](auto before, auto x, auto) { return before - x; })>(bits);
    case spv::OpAtomicSMin:
      return atomic_integers<lower_one>(bits);
    case spv::OpAtomicSMax:
      return atomic_integers<higher_one>(bits);
    case spv::OpAtomicUMin:
      return atomic_naturals<lower_one>(bits);
    case spv::OpAtomicUMax:
      return atomic_naturals<higher_one>(bits);
    case spv::OpAtomicAnd:
      return atomic_naturals<([](auto before, auto x, auto) { return before & x; })>(bits);
    case spv::OpAtomicOr:
      return atomic_naturals<([](auto before, auto x, auto) { return before | x; })>(bits);
    case spv::OpAtomicXor:
      return atomic_naturals<([](auto before, auto x, auto) { return before ^ x; })>(bits);
    case spv::OpAtomicFAddEXT:
      return atomic_reals<([](auto before, auto x, auto) { return before + x; })>(bits);
    case spv::OpAtomicFMinEXT:
      return atomic_reals<lower_one>(bits);
    case spv::OpAtomicFMaxEXT:
      return atomic_reals<higher_one>(bits);
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
