#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

// The numbers of the operands, and their number in the first.
template <typename T>
struct Vectors {
  T of[3][16] = {};
  uint32_t size = 0;
};

// F(vectors, result) of whole vectors.
template <typename T, auto F>
void of_vectors(Group& group, const Operation& o) {
  const uint32_t count = o.words / words_of<T>;
  group.each([&](uint32_t lane) {
    Vectors<Computed<T>> vectors{.size = o.from[0].words / words_of<T>};
    bool any_nan = false;
    for (size_t n = 0; n < o.from.size(); ++n)
      for (uint32_t k = 0; k < o.from[n].words / words_of<T>; ++k) {
        const Computed<T> x = vectors.of[n][k] = column<T>(group, o.from[n], k)[lane];
        any_nan = any_nan || x != x;
      }
    Computed<T> result[16] = {};
    F(vectors, result);
    for (uint32_t k = 0; k < count; ++k) {
      const Target<T> to = target<T>(group, o, k);
      to.set(lane, result[k]);
      if (!any_nan) note_birth<T, T, 0>(group, o, lane, to, {});
    }
  });
  group.spread_unset(o, 1);
}
template <auto F>
Execute vectors(uint32_t bits) {
  return bits == 16 ? of_vectors<Half, F> : bits == 64 ? of_vectors<double, F> : of_vectors<float, F>;
}

template <typename T>
T dot_product(const T* a, const T* b, uint32_t size) {
  T sum = a[0] * b[0];
  for (uint32_t n = 1; n < size; ++n) sum += a[n] * b[n];
  return sum;
}

// The minor without row and column, of a matrix in columns.
template <typename T>
T determinant(const T* m, uint32_t size) {
  if (size == 1) return m[0];
  T sum = 0;
  for (uint32_t column = 0; column < size; ++column) {
    T minor[9] = {};
    uint32_t at = 0;
    for (uint32_t c = 0; c < size; ++c)
      for (uint32_t r = 1; c != column && r < size; ++r) minor[at++] = m[c * size + r];
    sum += T(column % 2 ? -1 : 1) * m[column * size] * determinant(minor, size - 1);
  }
  return sum;
}

// The adjugate divided by the determinant, of matrices in columns.
template <typename T>
void invert(const T* m, uint32_t size, T* to) {
  const T whole = determinant(m, size);
  for (uint32_t column = 0; column < size; ++column)
    for (uint32_t row = 0; row < size; ++row) {
      T minor[9] = {};
      uint32_t at = 0;
      for (uint32_t c = 0; c < size; ++c)
        for (uint32_t r = 0; r < size; ++r)
          if (c != row && r != column) minor[at++] = m[c * size + r];
      to[column * size + row] = T((column + row) % 2 ? -1 : 1) * determinant(minor, size - 1) / whole;
    }
}

// The fractional part, then the whole part, of each component.
template <typename T>
void split_whole(Group& group, const Operation& o) {
  const uint32_t components = o.from[0].words / words_of<T>;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<T> from = column<T>(group, o.from[0], component);
    const Target<T> part = target<T>(group, o, component),
                    whole = target<T>(group, o, components + component);
    group.each([&](uint32_t lane) {
      const Computed<T> x = from[lane];
      whole.set(lane, std::trunc(x));
      part.set(lane, std::isinf(x) ? std::copysign(Computed<T>(0), x) : std::copysign(x - std::trunc(x), x));
    });
  }
  group.spread_unset(o, 1);
}

// The mantissa of each component, from ½ to 1, then the exponents, whole numbers of 32 bits.
template <typename T>
void split_exponent(Group& group, const Operation& o) {
  const uint32_t components = o.from[0].words / words_of<T>;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<T> from = column<T>(group, o.from[0], component);
    const Target<T> mantissa = target<T>(group, o, component);
    uint32_t* const exponents = group.row(o.to + o.from[0].words + component);
    group.each([&](uint32_t lane) {
      int exponent = 0;
      mantissa.set(lane, std::frexp(from[lane], &exponent));
      exponents[lane] = uint32_t(std::isfinite(from[lane]) ? exponent : 0);
    });
  }
  group.spread_unset(o, 1);
}

// Floats times powers of two, whose exponents have 32 bits.
template <typename T>
void join_exponent(Group& group, const Operation& o) {
  const uint32_t components = o.words / words_of<T>;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<T> from = column<T>(group, o.from[0], component);
    const Row exponents = group.read(o.from[1], component);
    const Target<T> to = target<T>(group, o, component);
    group.each([&](uint32_t lane) { to.set(lane, std::ldexp(from[lane], int32_t(exponents[lane]))); });
  }
  group.spread_unset(o, components);
}

}  // namespace

Execute geometric_function(uint32_t function, uint32_t bits) {
  switch (function) {
    case GLSLstd450Length:
      return vectors<([](auto& v, auto* to) { to[0] = std::sqrt(dot_product(v.of[0], v.of[0], v.size)); })>(
          bits);
    case GLSLstd450Distance:
      return vectors<([](auto& v, auto* to) {
        for (uint32_t n = 0; n < v.size; ++n) v.of[0][n] -= v.of[1][n];
        to[0] = std::sqrt(dot_product(v.of[0], v.of[0], v.size));
      })>(bits);
    case GLSLstd450Cross:
      return vectors<([](auto& v, auto* to) {
        for (uint32_t n = 0; n < 3; ++n)
          to[n] = v.of[0][(n + 1) % 3] * v.of[1][(n + 2) % 3] - v.of[0][(n + 2) % 3] * v.of[1][(n + 1) % 3];
      })>(bits);
    case GLSLstd450Normalize:
      return vectors<([](auto& v, auto* to) {
        const auto length = std::sqrt(dot_product(v.of[0], v.of[0], v.size));
        for (uint32_t n = 0; n < v.size; ++n) to[n] = v.of[0][n] / length;
      })>(bits);
    case GLSLstd450FaceForward:
      return vectors<([](auto& v, auto* to) {
        const bool faces = dot_product(v.of[2], v.of[1], v.size) < 0;
        for (uint32_t n = 0; n < v.size; ++n) to[n] = faces ? v.of[0][n] : -v.of[0][n];
      })>(bits);
    case GLSLstd450Reflect:
      return vectors<([](auto& v, auto* to) {
        const auto along = 2 * dot_product(v.of[1], v.of[0], v.size);
        for (uint32_t n = 0; n < v.size; ++n) to[n] = v.of[0][n] - along * v.of[1][n];
      })>(bits);
    case GLSLstd450Refract:
      return vectors<([](auto& v, auto* to) {
        const auto eta = v.of[2][0], cosine = dot_product(v.of[1], v.of[0], v.size);
        const auto k = 1 - eta * eta * (1 - cosine * cosine);
        for (uint32_t n = 0; n < v.size && k >= 0; ++n)
          to[n] = eta * v.of[0][n] - (eta * cosine + std::sqrt(k)) * v.of[1][n];
      })>(bits);
    case GLSLstd450Determinant:
      return vectors<([](auto& v, auto* to) {
        to[0] = determinant(v.of[0], v.size == 4 ? 2 : v.size == 9 ? 3 : 4);
      })>(bits);
    case GLSLstd450MatrixInverse:
      return vectors<([](auto& v, auto* to) { invert(v.of[0],
                                                     v.size == 4   ? 2
                                                     : v.size == 9 ? 3
                                                                   : 4,
                                                     to); })>(
          bits);
    case GLSLstd450ModfStruct:
      return bits == 16 ? split_whole<Half> : bits == 64 ? split_whole<double> : split_whole<float>;
    case GLSLstd450FrexpStruct:
      return bits == 16 ? split_exponent<Half> : bits == 64 ? split_exponent<double> : split_exponent<float>;
    case GLSLstd450Ldexp:
      return bits == 16 ? join_exponent<Half> : bits == 64 ? join_exponent<double> : join_exponent<float>;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
