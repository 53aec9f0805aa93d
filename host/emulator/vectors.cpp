#include <fmt/format.h>

#include "host/emulator/bits.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {
namespace {

// The sum of a's numbers from `first`, `step` apart, times b's from `other`, in their order.
float product(Group& group, const Source& a, uint32_t first, uint32_t step, const Source& b, uint32_t other,
              uint32_t count, uint32_t lane) {
  float sum = as<float>(group.read(a, first)[lane]) * as<float>(group.read(b, other)[lane]);
  for (uint32_t n = 1; n < count; ++n)
    sum += as<float>(group.read(a, first + n * step)[lane]) * as<float>(group.read(b, other + n)[lane]);
  return sum;
}

void dot(Group& group, const Operation& o) {
  uint32_t* to = group.row(o.to);
  group.each([&](uint32_t lane) {
    to[lane] = bits(product(group, o.from[0], 0, 1, o.from[1], 0, o.from[0].words, lane));
  });
  group.spread_unset(o);
}

void matrix_times_vector(Group& group, const Operation& o) {
  const uint32_t rows = o.words, columns = o.from[1].words;
  for (uint32_t row = 0; row < rows; ++row)
    group.each([&](uint32_t lane) {
      group.row(o.to + row)[lane] = bits(product(group, o.from[0], row, rows, o.from[1], 0, columns, lane));
    });
  group.spread_unset(o);
}

void vector_times_matrix(Group& group, const Operation& o) {
  const uint32_t rows = o.from[0].words;
  for (uint32_t column = 0; column < o.words; ++column)
    group.each([&](uint32_t lane) {
      group.row(o.to + column)[lane] =
          bits(product(group, o.from[1], column * rows, 1, o.from[0], 0, rows, lane));
    });
  group.spread_unset(o);
}

// o.literals: rows and columns of the left matrix.
void matrix_times_matrix(Group& group, const Operation& o) {
  const uint32_t rows = o.literals[0], inner = o.literals[1], columns = o.words / rows;
  for (uint32_t column = 0; column < columns; ++column)
    for (uint32_t row = 0; row < rows; ++row)
      group.each([&](uint32_t lane) {
        group.row(o.to + column * rows + row)[lane] =
            bits(product(group, o.from[0], row, rows, o.from[1], column * inner, inner, lane));
      });
  group.spread_unset(o);
}

// o.literals: rows and columns of the matrix.
void transpose(Group& group, const Operation& o) {
  const uint32_t rows = o.literals[0], columns = o.literals[1];
  for (uint32_t column = 0; column < columns; ++column)
    for (uint32_t row = 0; row < rows; ++row)
      group.each([&](uint32_t lane) {
        group.row(o.to + row * columns + column)[lane] = group.read(o.from[0], column * rows + row)[lane];
      });
  group.spread_unset(o);
}

void outer_product(Group& group, const Operation& o) {
  const uint32_t rows = o.from[0].words;
  for (uint32_t word = 0; word < o.words; ++word)
    group.each([&](uint32_t lane) {
      group.row(o.to + word)[lane] = bits(as<float>(group.read(o.from[0], word % rows)[lane]) *
                                          as<float>(group.read(o.from[1], word / rows)[lane]));
    });
  group.spread_unset(o);
}

void extract_dynamic(Group& group, const Operation& o) {
  group.needs_set(o, o.from[1], "an index was never set");
  const Row index = group.read(o.from[1], 0);
  uint32_t* to = group.row(o.to);
  group.each([&](uint32_t lane) {
    const bool inside = index[lane] < o.from[0].words;
    if (!inside)
      group.report(o, lane, Fault::out_of_bounds,
                   fmt::format("component {} of {}", int32_t(index[lane]), o.from[0].words));
    to[lane] = inside ? group.read(o.from[0], index[lane])[lane] : 0;
    group.set_unset(o.to, lane, inside && group.unset(o.from[0], index[lane], lane));
  });
}

void insert_dynamic(Group& group, const Operation& o) {
  group.needs_set(o, o.from[2], "an index was never set");
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row vector = group.read(o.from[0], word), number = group.read(o.from[1], 0),
              index = group.read(o.from[2], 0);
    group.each([&](uint32_t lane) {
      const bool here = index[lane] == word;
      if (word == 0 && index[lane] >= o.words)
        group.report(o, lane, Fault::out_of_bounds,
                     fmt::format("component {} of {}", int32_t(index[lane]), o.words));
      group.row(o.to + word)[lane] = here ? number[lane] : vector[lane];
      group.set_unset(o.to + word, lane,
                      here ? group.unset(o.from[1], 0, lane) : group.unset(o.from[0], word, lane));
    });
  }
}

}  // namespace

Execute vector_operation(spv::Op op) {
  switch (op) {
    case spv::OpDot:
      return dot;
    case spv::OpMatrixTimesVector:
      return matrix_times_vector;
    case spv::OpVectorTimesMatrix:
      return vector_times_matrix;
    case spv::OpMatrixTimesMatrix:
      return matrix_times_matrix;
    case spv::OpTranspose:
      return transpose;
    case spv::OpOuterProduct:
      return outer_product;
    case spv::OpVectorExtractDynamic:
      return extract_dynamic;
    case spv::OpVectorInsertDynamic:
      return insert_dynamic;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
