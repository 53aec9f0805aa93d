#include <fmt/format.h>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

// The number of an operand, and whether it is NaN.
template <typename T>
Computed<T> number_at(Group& group, const Source& source, uint32_t component, uint32_t lane, bool& any_nan) {
  const Computed<T> x = column<T>(group, source, component)[lane];
  any_nan = any_nan || x != x;
  return x;
}

// The sum of a's numbers from `first`, `step` apart, times b's from `other`, in their order, as a component
// of the result.
template <typename T>
void product(Group& group, const Operation& o, uint32_t component, const Source& a, uint32_t first,
             uint32_t step, const Source& b, uint32_t other, uint32_t count) {
  const Target<T> to = target<T>(group, o, component);
  group.each([&](uint32_t lane) {
    bool any_nan = false;
    const auto term = [&](uint32_t n) {
      return number_at<T>(group, a, first + n * step, lane, any_nan) *
             number_at<T>(group, b, other + n, lane, any_nan);
    };
    Computed<T> sum = term(0);
    for (uint32_t n = 1; n < count; ++n) sum += term(n);
    to.set(lane, sum);
    if (!any_nan) note_birth<T, T, 0>(group, o, lane, to, {});
  });
}

template <typename T>
void dot(Group& group, const Operation& o) {
  product<T>(group, o, 0, o.from[0], 0, 1, o.from[1], 0, o.from[0].words / words_of<T>);
  group.spread_unset(o, 1);
}

template <typename T>
void matrix_times_vector(Group& group, const Operation& o) {
  const uint32_t rows = o.words / words_of<T>, columns = o.from[1].words / words_of<T>;
  for (uint32_t row = 0; row < rows; ++row)
    product<T>(group, o, row, o.from[0], row, rows, o.from[1], 0, columns);
  group.spread_unset(o, 1);
}

template <typename T>
void vector_times_matrix(Group& group, const Operation& o) {
  const uint32_t rows = o.from[0].words / words_of<T>;
  for (uint32_t column = 0; column < o.words / words_of<T>; ++column)
    product<T>(group, o, column, o.from[1], column * rows, 1, o.from[0], 0, rows);
  group.spread_unset(o, 1);
}

// o.literals: rows and columns of the left matrix.
template <typename T>
void matrix_times_matrix(Group& group, const Operation& o) {
  const uint32_t rows = o.literals[0], inner = o.literals[1], columns = o.words / words_of<T> / rows;
  for (uint32_t column = 0; column < columns; ++column)
    for (uint32_t row = 0; row < rows; ++row)
      product<T>(group, o, column * rows + row, o.from[0], row, rows, o.from[1], column * inner, inner);
  group.spread_unset(o, 1);
}

template <typename T>
void outer_product(Group& group, const Operation& o) {
  const uint32_t rows = o.from[0].words / words_of<T>;
  for (uint32_t n = 0; n < o.words / words_of<T>; ++n)
    product<T>(group, o, n, o.from[0], n % rows, 1, o.from[1], n / rows, 1);
  group.spread_unset(o, 1);
}

// o.literals: rows and columns of the matrix.
void transpose(Group& group, const Operation& o) {
  const uint32_t rows = o.literals[0], columns = o.literals[1], words = o.words / rows / columns;
  Operation parts{.to = o.to, .words = o.words};
  for (uint32_t row = 0; row < rows; ++row)
    for (uint32_t column = 0; column < columns; ++column)
      parts.from.push_back({.at = o.from[0].at + (column * rows + row) * words,
                            .words = words,
                            .constant = o.from[0].constant});
  concatenate(group, parts);
}

// o.literals: the words of a component, and the bits of the index if it is signed, else 0.
void extract_dynamic(Group& group, const Operation& o) {
  group.needs_set(o, o.from[1], "an index was never set");
  const uint32_t words = o.literals[0], count = o.from[0].words / words;
  for (uint32_t word = 0; word < words; ++word)
    group.each([&](uint32_t lane) {
      const int64_t index = group.whole_number(o.from[1], o.literals[1], lane);
      const bool inside = index >= 0 && index < count;
      if (!inside && word == 0)
        group.report(o, lane, Fault::out_of_bounds, fmt::format("component {} of {}", index, count));
      const uint32_t from = inside ? uint32_t(index) * words + word : 0;
      group.row(o.to + word)[lane] = inside ? group.read(o.from[0], from)[lane] : 0;
      group.set_unset(o.to + word, lane, inside && group.unset(o.from[0], from, lane));
    });
}

// The same.
void insert_dynamic(Group& group, const Operation& o) {
  group.needs_set(o, o.from[2], "an index was never set");
  const uint32_t words = o.literals[0], count = o.words / words;
  for (uint32_t word = 0; word < o.words; ++word)
    group.each([&](uint32_t lane) {
      const int64_t index = group.whole_number(o.from[2], o.literals[1], lane);
      if (word == 0 && (index < 0 || index >= count))
        group.report(o, lane, Fault::out_of_bounds, fmt::format("component {} of {}", index, count));
      const bool here = index == word / words;
      const Source& from = o.from[here ? 1 : 0];
      const uint32_t at = here ? word % words : word;
      group.row(o.to + word)[lane] = group.read(from, at)[lane];
      group.set_unset(o.to + word, lane, group.unset(from, at, lane));
    });
}

}  // namespace

Execute vector_operation(spv::Op op, uint32_t bits) {
  switch (op) {
    case spv::OpDot:
      return bits == 16 ? dot<Half> : bits == 64 ? dot<double> : dot<float>;
    case spv::OpMatrixTimesVector:
      return bits == 16   ? matrix_times_vector<Half>
             : bits == 64 ? matrix_times_vector<double>
                          : matrix_times_vector<float>;
    case spv::OpVectorTimesMatrix:
      return bits == 16   ? vector_times_matrix<Half>
             : bits == 64 ? vector_times_matrix<double>
                          : vector_times_matrix<float>;
    case spv::OpMatrixTimesMatrix:
      return bits == 16   ? matrix_times_matrix<Half>
             : bits == 64 ? matrix_times_matrix<double>
                          : matrix_times_matrix<float>;
    case spv::OpTranspose:
      return transpose;
    case spv::OpOuterProduct:
      return bits == 16 ? outer_product<Half> : bits == 64 ? outer_product<double> : outer_product<float>;
    case spv::OpVectorExtractDynamic:
      return extract_dynamic;
    case spv::OpVectorInsertDynamic:
      return insert_dynamic;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
