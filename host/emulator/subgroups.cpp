#include <limits>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

// Calls f(first active lane of the cluster, its active lanes) for each cluster of `size` invocations. No
// cluster reaches beyond its subgroup.
template <typename F>
void each_cluster(const Group& group, uint32_t size, const F& f) {
  const std::span<const uint32_t> active = group.active();
  for (size_t first = 0; first < active.size();) {
    size_t end = first;
    while (end < active.size() && active[end] / size == active[first] / size) ++end;
    f(active.subspan(first, end - first));
    first = end;
  }
}

template <typename F>
void each_subgroup(const Group& group, const F& f) {
  each_cluster(group, group.subgroup_size(), f);
}

// Sets the result of all lanes.
void set(Group& group, const Operation& o, std::span<const uint32_t> lanes, uint32_t word, uint32_t value) {
  for (const uint32_t lane : lanes) group.row(o.to + word)[lane] = value;
}

void elect(Group& group, const Operation& o) {
  each_subgroup(group, [&](std::span<const uint32_t> lanes) {
    set(group, o, lanes, 0, 0);
    group.row(o.to)[lanes.front()] = 1;
  });
}

template <bool Any>
void vote(Group& group, const Operation& o) {
  group.needs_set(o, o.from[0], "a vote on a value that was never set");
  const Row value = group.read(o.from[0], 0);
  each_subgroup(group, [&](std::span<const uint32_t> lanes) {
    bool result = !Any;
    for (const uint32_t lane : lanes)
      if ((value[lane] != 0) == Any) result = Any;
    set(group, o, lanes, 0, result);
  });
}

void all_equal(Group& group, const Operation& o) {
  group.needs_set(o, o.from[0], "a vote on a value that was never set");
  each_subgroup(group, [&](std::span<const uint32_t> lanes) {
    bool result = true;
    for (uint32_t word = 0; word < o.from[0].words; ++word) {
      const Row value = group.read(o.from[0], word);
      for (const uint32_t lane : lanes) result = result && value[lane] == value[lanes.front()];
    }
    set(group, o, lanes, 0, result);
  });
}

uint32_t in_subgroup(const Group& group, uint32_t lane) {
  return lane % group.subgroup_size();
}

void ballot(Group& group, const Operation& o) {
  group.needs_set(o, o.from[0], "a ballot on a value that was never set");
  const Row value = group.read(o.from[0], 0);
  each_subgroup(group, [&](std::span<const uint32_t> lanes) {
    uint32_t words[4] = {};
    for (const uint32_t lane : lanes)
      if (value[lane]) words[in_subgroup(group, lane) / 32] |= 1u << in_subgroup(group, lane) % 32;
    for (uint32_t word = 0; word < o.words; ++word) set(group, o, lanes, word, words[word]);
  });
}

// A bit of a ballot.
bool bit(const Group& group, const Source& ballot, uint32_t lane, uint32_t at) {
  return at < 128 && (group.read(ballot, at / 32)[lane] >> at % 32 & 1u);
}

void inverse_ballot(Group& group, const Operation& o) {
  group.each(
      [&](uint32_t lane) { group.row(o.to)[lane] = bit(group, o.from[0], lane, in_subgroup(group, lane)); });
  group.spread_unset(o, 1);
}

void ballot_bit(Group& group, const Operation& o) {
  const Row at = group.read(o.from[1], 0);
  group.each([&](uint32_t lane) { group.row(o.to)[lane] = bit(group, o.from[0], lane, at[lane]); });
  group.spread_unset(o, 1);
}

void ballot_count(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) {
    const uint32_t self = in_subgroup(group, lane);
    const uint32_t end = o.literals[0] == spv::GroupOperationReduce          ? group.subgroup_size()
                         : o.literals[0] == spv::GroupOperationInclusiveScan ? self + 1
                                                                             : self;
    uint32_t count = 0;
    for (uint32_t at = 0; at < end; ++at) count += bit(group, o.from[0], lane, at);
    group.row(o.to)[lane] = count;
  });
  group.spread_unset(o, 1);
}

template <bool Lowest>
void ballot_find(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) {
    uint32_t found = UINT32_MAX;
    for (uint32_t at = 0; at < group.subgroup_size(); ++at)
      if (bit(group, o.from[0], lane, at) && (!Lowest || found == UINT32_MAX)) found = at;
    group.row(o.to)[lane] = found;
  });
  group.spread_unset(o, 1);
}

// The value of another invocation of the subgroup, whose number `from` gives. It is unset if that one is not
// active.
template <typename From>
void read_others(Group& group, const Operation& o, const From& from) {
  const uint32_t size = group.subgroup_size();
  std::vector<char> is_active(group.lanes());
  group.each([&](uint32_t lane) { is_active[lane] = 1; });
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row value = group.read(o.from[0], word);
    std::vector<uint32_t> values(group.lanes());
    std::vector<char> unset(group.lanes());
    group.each([&](uint32_t lane) {
      const uint32_t other = from(lane);
      const uint32_t there = lane / size * size + other;
      const bool valid = other < size && there < group.lanes() && is_active[there];
      values[lane] = valid ? value[there] : 0;
      unset[lane] = !valid || group.unset(o.from[0], word, there);
    });
    group.each([&](uint32_t lane) {
      group.row(o.to + word)[lane] = values[lane];
      group.set_unset(o.to + word, lane, unset[lane] != 0);
    });
  }
}

void broadcast_first(Group& group, const Operation& o) {
  std::vector<uint32_t> first(group.lanes());
  each_subgroup(group, [&](std::span<const uint32_t> lanes) {
    for (const uint32_t lane : lanes) first[lane] = in_subgroup(group, lanes.front());
  });
  read_others(group, o, [&](uint32_t lane) { return first[lane]; });
}

// F(the invocation's number in its subgroup, the operand).
template <auto F>
void shuffle(Group& group, const Operation& o) {
  group.needs_set(o, o.from[1], "the number of an invocation was never set");
  const Row by = group.read(o.from[1], 0);
  read_others(group, o, [&](uint32_t lane) { return F(in_subgroup(group, lane), by[lane]); });
}

template <typename T>
Computed<T> combined(spv::Op op, Computed<T> x, Computed<T> y) {
  switch (op) {
    case spv::OpGroupNonUniformIAdd:
    case spv::OpGroupNonUniformFAdd:
      return x + y;
    case spv::OpGroupNonUniformIMul:
    case spv::OpGroupNonUniformFMul:
      return x * y;
    case spv::OpGroupNonUniformSMin:
    case spv::OpGroupNonUniformUMin:
    case spv::OpGroupNonUniformFMin:
      return y < x ? y : x;
    case spv::OpGroupNonUniformSMax:
    case spv::OpGroupNonUniformUMax:
    case spv::OpGroupNonUniformFMax:
      return x < y ? y : x;
    default:
      break;
  }
  if constexpr (!is_real<T>) {
    if (op == spv::OpGroupNonUniformBitwiseAnd || op == spv::OpGroupNonUniformLogicalAnd) return x & y;
    if (op == spv::OpGroupNonUniformBitwiseOr || op == spv::OpGroupNonUniformLogicalOr) return x | y;
    return x ^ y;
  }
  return x;
}

// The value that changes nothing.
template <typename T>
Computed<T> neutral(spv::Op op) {
  using Limits = std::numeric_limits<std::conditional_t<std::is_same_v<T, Half>, float, T>>;
  switch (op) {
    case spv::OpGroupNonUniformIMul:
    case spv::OpGroupNonUniformFMul:
    case spv::OpGroupNonUniformLogicalAnd:
      return 1;
    case spv::OpGroupNonUniformSMin:
    case spv::OpGroupNonUniformUMin:
    case spv::OpGroupNonUniformBitwiseAnd:
      return Limits::max();
    case spv::OpGroupNonUniformSMax:
    case spv::OpGroupNonUniformUMax:
      return Limits::lowest();
    case spv::OpGroupNonUniformFMin:
      return Computed<T>(Limits::infinity());
    case spv::OpGroupNonUniformFMax:
      return Computed<T>(-Limits::infinity());
    default:
      return 0;
  }
}

// o.literals: the group operation, the cluster's size if it is clustered, the opcode.
template <typename T>
void combine(Group& group, const Operation& o) {
  const auto op = spv::Op(o.literals[2]);
  const bool clustered = o.literals[0] == spv::GroupOperationClusteredReduce;
  const bool reduces = clustered || o.literals[0] == spv::GroupOperationReduce;
  const bool inclusive = o.literals[0] == spv::GroupOperationInclusiveScan;
  const uint32_t size = clustered ? std::min(o.literals[1], group.subgroup_size()) : group.subgroup_size();
  group.needs_set(o, o.from[0], "a value was never set, which the subgroup combines");
  for (uint32_t component = 0; component < o.words / words_of<T>; ++component) {
    const Column<T> value = column<T>(group, o.from[0], component);
    const Target<T> to = target<T>(group, o, component);
    each_cluster(group, size, [&](std::span<const uint32_t> lanes) {
      Computed<T> sum = neutral<T>(op);
      for (const uint32_t lane : lanes) {
        const Computed<T> before = sum;
        sum = rounded<T>(combined<T>(op, sum, value[lane]));
        if (!reduces) to.set(lane, inclusive ? sum : before);
      }
      if (reduces)
        for (const uint32_t lane : lanes) to.set(lane, sum);
    });
  }
}

void quad_swap(Group& group, const Operation& o) {
  const Row direction = group.read(o.from[1], 0);
  read_others(group, o, [&](uint32_t lane) { return in_subgroup(group, lane) ^ (direction[lane] + 1); });
}

}  // namespace

Execute subgroup_operation(spv::Op op, uint32_t bits) {
  if (op >= spv::OpGroupNonUniformIAdd && op <= spv::OpGroupNonUniformLogicalXor) {
    switch (op) {
      case spv::OpGroupNonUniformFAdd:
      case spv::OpGroupNonUniformFMul:
      case spv::OpGroupNonUniformFMin:
      case spv::OpGroupNonUniformFMax:
        return bits == 16 ? combine<Half> : bits == 64 ? combine<double> : combine<float>;
      case spv::OpGroupNonUniformSMin:
      case spv::OpGroupNonUniformSMax:
        return bits == 8    ? combine<int8_t>
               : bits == 16 ? combine<int16_t>
               : bits == 64 ? combine<int64_t>
                            : combine<int32_t>;
      default:
        return bits == 8    ? combine<uint8_t>
               : bits == 16 ? combine<uint16_t>
               : bits == 64 ? combine<uint64_t>
                            : combine<uint32_t>;
    }
  }
  using U = uint32_t;
  switch (op) {
    case spv::OpGroupNonUniformElect:
      return elect;
    case spv::OpGroupNonUniformAll:
      return vote<false>;
    case spv::OpGroupNonUniformAny:
      return vote<true>;
    case spv::OpGroupNonUniformAllEqual:
      return all_equal;
    case spv::OpGroupNonUniformBroadcast:
    case spv::OpGroupNonUniformShuffle:
      return shuffle<([](U, U by) { return by; })>;
    case spv::OpGroupNonUniformBroadcastFirst:
      return broadcast_first;
    case spv::OpGroupNonUniformBallot:
      return ballot;
    case spv::OpGroupNonUniformInverseBallot:
      return inverse_ballot;
    case spv::OpGroupNonUniformBallotBitExtract:
      return ballot_bit;
    case spv::OpGroupNonUniformBallotBitCount:
      return ballot_count;
    case spv::OpGroupNonUniformBallotFindLSB:
      return ballot_find<true>;
    case spv::OpGroupNonUniformBallotFindMSB:
      return ballot_find<false>;
    case spv::OpGroupNonUniformShuffleXor:
      return shuffle<([](U self, U by) { return self ^ by; })>;
    case spv::OpGroupNonUniformShuffleUp:
      return shuffle<([](U self, U by) { return self - by; })>;
    case spv::OpGroupNonUniformShuffleDown:
      return shuffle<([](U self, U by) { return by > 127 ? UINT32_MAX : self + by; })>;
    case spv::OpGroupNonUniformQuadBroadcast:
      return shuffle<([](U self, U by) { return self / 4 * 4 + by; })>;
    case spv::OpGroupNonUniformQuadSwap:
      return quad_swap;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
