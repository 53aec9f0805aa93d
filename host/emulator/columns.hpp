// Numbers of all invocations, and functions of them. Private to this layer.
#pragma once

#include <array>
#include <utility>

#include "host/emulator/bits.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {

// A component of an operand, of each invocation.
template <typename T>
struct Column {
  Row low, high;
  Computed<T> operator[](uint32_t lane) const {
    if constexpr (words_of<T> == 2)
      return number_of<T>(low[lane], high[lane]);
    else
      return number_of<T>(low[lane]);
  }
};
template <typename T>
Column<T> column(const Group& group, const Source& source, uint32_t component) {
  const uint32_t word = component * words_of<T>;
  return {group.read(source, word), group.read(source, word + words_of<T> - 1)};
}

// A component of a result, of each invocation.
template <typename T>
struct Target {
  uint32_t *low, *high;
  void set(uint32_t lane, Computed<T> x) const {
    const uint64_t words = words_of_number<T>(x);
    low[lane] = uint32_t(words);
    if constexpr (words_of<T> == 2) high[lane] = uint32_t(words >> 32);
  }
};
template <typename T>
Target<T> target(Group& group, const Operation& o, uint32_t component) {
  const uint32_t at = o.to + component * words_of<T>;
  return {group.row(at), group.row(at + words_of<T> - 1)};
}

// Notes where the result of this invocation is NaN and none of these operands is.
template <typename T, typename U, size_t N>
void note_birth(Group& group, const Operation& o, uint32_t lane, const Target<T>& to,
                const std::array<Computed<U>, N>& operands) {
  const Computed<T> result = number_of<T>(to.low[lane], to.high[lane]);
  if (result == result) return;
  std::vector<double> values;
  for (const Computed<U> operand : operands) {
    if (operand != operand) return;
    values.push_back(double(operand));
  }
  uint32_t* const word = words_of<T> == 2 ? to.high : to.low;
  constexpr uint32_t width = std::is_same_v<T, Half> ? 16 : sizeof(T) * 8;
  if (const uint32_t birth = group.birth(o, std::move(values)))
    word[lane] = with_birth(word[lane], width, birth);
}

// Sets the components of the result to F of the operands' components. An operand of one component stands for
// all.
template <typename To, typename From, auto F, size_t... N>
void map_components(Group& group, const Operation& o, std::index_sequence<N...>) {
  const uint32_t components = o.words / words_of<To>;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<From> from[] = {
        column<From>(group, o.from[N], o.from[N].words == words_of<From> ? 0 : component)...};
    const Target<To> to = target<To>(group, o, component);
    uint32_t nans = 0;
    group.each([&](uint32_t lane) {
      const auto x = Computed<To>(F(from[N][lane]...));
      if constexpr (is_real<To>) nans += x != x;
      to.set(lane, x);
    });
    if constexpr (is_real<To> && is_real<From>)
      if (nans > 0)
        group.each([&](uint32_t lane) {
          note_birth<To, From, sizeof...(N)>(group, o, lane, to, {from[N][lane]...});
        });
  }
  group.spread_unset(o, components);
}
template <typename To, typename From, size_t N, auto F>
void map(Group& group, const Operation& o) {
  map_components<To, From, F>(group, o, std::make_index_sequence<N>());
}

// map for numbers of `bits` bits. `Tests`: the result is a bool, and no number of the operands' type.
template <bool Tests, typename T, size_t N, auto F>
constexpr Execute map_to = map<std::conditional_t<Tests, bool, T>, T, N, F>;
template <size_t N, auto F, bool Tests = false>
Execute reals(uint32_t bits) {
  return bits == 16   ? map_to<Tests, Half, N, F>
         : bits == 64 ? map_to<Tests, double, N, F>
                      : map_to<Tests, float, N, F>;
}
template <size_t N, auto F, bool Tests = false>
Execute naturals(uint32_t bits) {
  return bits == 8    ? map_to<Tests, uint8_t, N, F>
         : bits == 16 ? map_to<Tests, uint16_t, N, F>
         : bits == 64 ? map_to<Tests, uint64_t, N, F>
                      : map_to<Tests, uint32_t, N, F>;
}
template <size_t N, auto F, bool Tests = false>
Execute integers(uint32_t bits) {
  return bits == 8    ? map_to<Tests, int8_t, N, F>
         : bits == 16 ? map_to<Tests, int16_t, N, F>
         : bits == 64 ? map_to<Tests, int64_t, N, F>
                      : map_to<Tests, int32_t, N, F>;
}

}  // namespace eyeray::engine::emulator
