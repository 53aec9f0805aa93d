#include "formula/cpp_language.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/embedded_shaders.hpp"
#include "core/error.hpp"

namespace eyeray::formula {

namespace {

constexpr std::string_view start = R"cpp(
#define EXPORT extern "C" __attribute__((visibility("default")))
#define SHADER_BEGIN
#define SHADER_END
#define OUT(T) T&
#define INOUT(T) T&
  namespace {
  typedef unsigned uint;
  thread_local uint turns;
)cpp";

// Numbers and vectors over `real`. Integers are classes: nothing that a formula does with them is undefined,
// neither a division by 0 nor an overflow, and none of C++'s own conversions gets in the way.
constexpr std::string_view types = R"cpp(
  struct Uint;
  struct Int {
    int v;
    Int() : v(0) {}
    Int(int x) : v(x) {}
    explicit Int(bool x) : v(x) {}
    explicit Int(real x) : v(x >= real(-2147483648.0) && x < real(2147483648.0) ? int(x) : -2147483647 - 1) {}
    explicit Int(Uint x);
    operator real() const { return real(v); }
  };
  struct Uint {
    uint v;
    Uint() : v(0) {}
    Uint(Int x) : v(uint(x.v)) {}
    explicit Uint(uint x) : v(x) {}
    explicit Uint(bool x) : v(x) {}
    explicit Uint(real x) : v(x >= 0 && x < real(4294967296.0) ? uint(x) : 0) {}
    operator real() const { return real(v); }
  };
  inline Int::Int(Uint x) : v(int(x.v)) {}
  inline Int operator/(Int a, Int b) {
    return Int(b.v == 0 ? 0 : b.v == -1 ? int(0u - uint(a.v)) : a.v / b.v);
  }
  inline Int operator%(Int a, Int b) {
    return Int(b.v == 0 || b.v == -1 ? 0 : a.v % b.v);
  }
  inline Int operator>>(Int a, Int b) {
    return Int(a.v >> (b.v & 31));
  }
  inline Uint operator/(Uint a, Uint b) {
    return Uint(b.v == 0 ? 0 : a.v / b.v);
  }
  inline Uint operator%(Uint a, Uint b) {
    return Uint(b.v == 0 ? 0 : a.v % b.v);
  }
  inline Uint operator>>(Uint a, Uint b) {
    return Uint(a.v >> (b.v & 31));
  }
#define WRAPS(T, S, op)                  \
    inline T operator op(T a, T b) {       \
      return T(S(uint(a.v) op uint(b.v))); \
    }
#define COMPARES(T, op)               \
    inline bool operator op(T a, T b) { \
      return a.v op b.v;                \
    }
#define STORES(T, op)                   \
    inline T& operator op##=(T& a, T b) { \
      return a = a op b;                  \
    }
#define OPERATORS(T, S)                                                                                      \
    WRAPS(T, S, +)                                                                                             \
    WRAPS(T, S, -) WRAPS(T, S, *) WRAPS(T, S, &) WRAPS(T, S, |) WRAPS(T, S, ^) inline T operator<<(T a, T b) { \
      return T(S(uint(a.v) << (uint(b.v) & 31u)));                                                             \
    }                                                                                                          \
    COMPARES(T, ==)                                                                                            \
    COMPARES(T, !=)                                                                                            \
    COMPARES(T, <) COMPARES(T, <=) COMPARES(T, >) COMPARES(T, >=) STORES(T, +) STORES(T, -) STORES(T, *)       \
        STORES(T, /) STORES(T, %) STORES(T, &) STORES(T, |) STORES(T, ^) STORES(T, <<)                         \
            STORES(T, >>) inline T                                                                             \
            operator-(T a) {                                                                                   \
      return T(S(0u - uint(a.v)));                                                                             \
    }                                                                                                          \
    inline T operator~(T a) {                                                                                  \
      return T(S(~uint(a.v)));                                                                                 \
    }                                                                                                          \
    inline T& operator++(T& a) {                                                                               \
      return a = T(S(uint(a.v) + 1u));                                                                         \
    }                                                                                                          \
    inline T& operator--(T& a) {                                                                               \
      return a = T(S(uint(a.v) - 1u));                                                                         \
    }                                                                                                          \
    inline T operator++(T& a, int) {                                                                           \
      T b = a;                                                                                                 \
      ++a;                                                                                                     \
      return b;                                                                                                \
    }                                                                                                          \
    inline T operator--(T& a, int) {                                                                           \
      T b = a;                                                                                                 \
      --a;                                                                                                     \
      return b;                                                                                                \
    }
  OPERATORS(Int, int)
  OPERATORS(Uint, uint)
#undef OPERATORS
#undef STORES
#undef COMPARES
#undef WRAPS
  template <uint n>
  uint element(Int i) {
    return uint(i.v) < n ? uint(i.v) : n - 1;
  }
  template <uint n>
  uint element(Uint i) {
    return i.v < n ? i.v : n - 1;
  }

  struct vec2;
  struct vec3;
  struct vec4;
  template <int n>
  struct Vector;
  template <>
  struct Vector<2> {
    typedef vec2 type;
  };
  template <>
  struct Vector<3> {
    typedef vec3 type;
  };
  template <>
  struct Vector<4> {
    typedef vec4 type;
  };
  // v.zx as something that is written to: what is stored here goes to v at the end of the statement.
  template <class V, int... i>
  struct Part {
    typedef typename Vector<sizeof...(i)>::type T;
    V& v;
    T copy;
    explicit Part(V& from) : v(from), copy(from.template get<i...>()) {}
    ~Part() {
      int k = 0;
      ((v[Int(i)] = copy[Int(k++)]), ...);
    }
    operator T&() { return copy; }
    T& operator=(const T& x) { return copy = x; }
    template <class X>
    T& operator+=(const X& x) {
      return copy = copy + x;
    }
    template <class X>
    T& operator-=(const X& x) {
      return copy = copy - x;
    }
    template <class X>
    T& operator*=(const X& x) {
      return copy = copy * x;
    }
    template <class X>
    T& operator/=(const X& x) {
      return copy = copy / x;
    }
  };
#define OF_A_VECTOR(T, n)                                           \
    real& operator[](Int i) {                                         \
      return (&x)[element<n>(i)];                                     \
    }                                                                 \
    const real& operator[](Int i) const {                             \
      return (&x)[element<n>(i)];                                     \
    }                                                                 \
    template <int... i>                                               \
    typename Vector<sizeof...(i)>::type get() const {                 \
      return typename Vector<sizeof...(i)>::type((*this)[Int(i)]...); \
    }                                                                 \
    template <int... i>                                               \
    Part<T, i...> part() {                                            \
      return Part<T, i...>(*this);                                    \
    }                                                                 \
    T& operator+=(const T& b) {                                       \
      return *this = *this + b;                                       \
    }                                                                 \
    T& operator-=(const T& b) {                                       \
      return *this = *this - b;                                       \
    }                                                                 \
    T& operator*=(const T& b) {                                       \
      return *this = *this * b;                                       \
    }                                                                 \
    T& operator/=(const T& b) {                                       \
      return *this = *this / b;                                       \
    }                                                                 \
    T& operator*=(real b) {                                           \
      return *this = *this * T(b);                                    \
    }                                                                 \
    T& operator/=(real b) {                                           \
      return *this = *this / T(b);                                    \
    }                                                                 \
    T& operator+=(real b) {                                           \
      return *this = *this + T(b);                                    \
    }                                                                 \
    T& operator-=(real b) {                                           \
      return *this = *this - T(b);                                    \
    }                                                                 \
    friend T operator+(T a, real b) {                                 \
      return a + T(b);                                                \
    }                                                                 \
    friend T operator-(T a, real b) {                                 \
      return a - T(b);                                                \
    }                                                                 \
    friend T operator*(T a, real b) {                                 \
      return a * T(b);                                                \
    }                                                                 \
    friend T operator/(T a, real b) {                                 \
      return a / T(b);                                                \
    }                                                                 \
    friend T operator+(real a, T b) {                                 \
      return T(a) + b;                                                \
    }                                                                 \
    friend T operator-(real a, T b) {                                 \
      return T(a) - b;                                                \
    }                                                                 \
    friend T operator*(real a, T b) {                                 \
      return T(a) * b;                                                \
    }                                                                 \
    friend T operator/(real a, T b) {                                 \
      return T(a) / b;                                                \
    }                                                                 \
    friend bool operator!=(T a, T b) {                                \
      return !(a == b);                                               \
    }                                                                 \
    friend T operator+(T a) {                                         \
      return a;                                                       \
    }
  struct vec2 {
    real x, y;
    vec2() : x(0), y(0) {}
    vec2(real a, real b) : x(a), y(b) {}
    explicit vec2(real a) : x(a), y(a) {}
    explicit vec2(const vec3& v);
    explicit vec2(const vec4& v);
    friend vec2 operator+(vec2 a, vec2 b) { return vec2(a.x + b.x, a.y + b.y); }
    friend vec2 operator-(vec2 a, vec2 b) { return vec2(a.x - b.x, a.y - b.y); }
    friend vec2 operator*(vec2 a, vec2 b) { return vec2(a.x * b.x, a.y * b.y); }
    friend vec2 operator/(vec2 a, vec2 b) { return vec2(a.x / b.x, a.y / b.y); }
    friend vec2 operator-(vec2 a) { return vec2(-a.x, -a.y); }
    friend bool operator==(vec2 a, vec2 b) { return a.x == b.x && a.y == b.y; }
    OF_A_VECTOR(vec2, 2)
  };
  struct vec3 {
    real x, y, z;
    vec3() : x(0), y(0), z(0) {}
    vec3(real a, real b, real c) : x(a), y(b), z(c) {}
    vec3(vec2 a, real b) : x(a.x), y(a.y), z(b) {}
    vec3(real a, vec2 b) : x(a), y(b.x), z(b.y) {}
    explicit vec3(real a) : x(a), y(a), z(a) {}
    explicit vec3(const vec4& v);
    friend vec3 operator+(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
    friend vec3 operator-(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
    friend vec3 operator*(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
    friend vec3 operator/(vec3 a, vec3 b) { return vec3(a.x / b.x, a.y / b.y, a.z / b.z); }
    friend vec3 operator-(vec3 a) { return vec3(-a.x, -a.y, -a.z); }
    friend bool operator==(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
    OF_A_VECTOR(vec3, 3)
  };
  struct vec4 {
    real x, y, z, w;
    vec4() : x(0), y(0), z(0), w(0) {}
    vec4(real a, real b, real c, real d) : x(a), y(b), z(c), w(d) {}
    vec4(vec3 a, real b) : x(a.x), y(a.y), z(a.z), w(b) {}
    vec4(real a, vec3 b) : x(a), y(b.x), z(b.y), w(b.z) {}
    vec4(vec2 a, vec2 b) : x(a.x), y(a.y), z(b.x), w(b.y) {}
    vec4(vec2 a, real b, real c) : x(a.x), y(a.y), z(b), w(c) {}
    vec4(real a, vec2 b, real c) : x(a), y(b.x), z(b.y), w(c) {}
    vec4(real a, real b, vec2 c) : x(a), y(b), z(c.x), w(c.y) {}
    explicit vec4(real a) : x(a), y(a), z(a), w(a) {}
    friend vec4 operator+(vec4 a, vec4 b) { return vec4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
    friend vec4 operator-(vec4 a, vec4 b) { return vec4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w); }
    friend vec4 operator*(vec4 a, vec4 b) { return vec4(a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w); }
    friend vec4 operator/(vec4 a, vec4 b) { return vec4(a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w); }
    friend vec4 operator-(vec4 a) { return vec4(-a.x, -a.y, -a.z, -a.w); }
    friend bool operator==(vec4 a, vec4 b) { return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w; }
    OF_A_VECTOR(vec4, 4)
  };
  inline vec2::vec2(const vec3& v) : x(v.x), y(v.y) {}
  inline vec2::vec2(const vec4& v) : x(v.x), y(v.y) {}
  inline vec3::vec3(const vec4& v) : x(v.x), y(v.y), z(v.z) {}
#undef OF_A_VECTOR
)cpp";

// What math.glsl takes from the language.
constexpr std::string_view shader_basis = R"cpp(
  struct uvec4 {
    uint x, y, z, w;
  };
  inline float abs(float x) {
    return __builtin_fabsf(x);
  }
  inline float floor(float x) {
    return __builtin_floorf(x);
  }
  inline float sqrt(float x) {
    return __builtin_sqrtf(x);
  }
  inline uint floatBitsToUint(float x) {
    uint y;
    __builtin_memcpy(&y, &x, 4);
    return y;
  }
  inline float uintBitsToFloat(uint x) {
    float y;
    __builtin_memcpy(&y, &x, 4);
    return y;
  }
)cpp";

// The functions of formula.glsl, by C's library and GLSL's definitions.
constexpr std::string_view library_functions = R"cpp(
#define ONE(name, value)                                                         \
    inline real fn_##name(real x) {                                                \
      return value;                                                                \
    }                                                                              \
    inline vec2 fn_##name(vec2 v) {                                                \
      return vec2(fn_##name(v.x), fn_##name(v.y));                                 \
    }                                                                              \
    inline vec3 fn_##name(vec3 v) {                                                \
      return vec3(fn_##name(v.x), fn_##name(v.y), fn_##name(v.z));                 \
    }                                                                              \
    inline vec4 fn_##name(vec4 v) {                                                \
      return vec4(fn_##name(v.x), fn_##name(v.y), fn_##name(v.z), fn_##name(v.w)); \
    }
#define TWO(name, value)                                                                             \
    inline real fn_##name(real x, real y) {                                                            \
      return value;                                                                                    \
    }                                                                                                  \
    inline vec2 fn_##name(vec2 a, vec2 b) {                                                            \
      return vec2(fn_##name(a.x, b.x), fn_##name(a.y, b.y));                                           \
    }                                                                                                  \
    inline vec3 fn_##name(vec3 a, vec3 b) {                                                            \
      return vec3(fn_##name(a.x, b.x), fn_##name(a.y, b.y), fn_##name(a.z, b.z));                      \
    }                                                                                                  \
    inline vec4 fn_##name(vec4 a, vec4 b) {                                                            \
      return vec4(fn_##name(a.x, b.x), fn_##name(a.y, b.y), fn_##name(a.z, b.z), fn_##name(a.w, b.w)); \
    }
#define THREE(name, value)                                                                     \
    inline real fn_##name(real x, real y, real z) {                                              \
      return value;                                                                              \
    }                                                                                            \
    inline vec2 fn_##name(vec2 a, vec2 b, vec2 c) {                                              \
      return vec2(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y));                           \
    }                                                                                            \
    inline vec3 fn_##name(vec3 a, vec3 b, vec3 c) {                                              \
      return vec3(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y), fn_##name(a.z, b.z, c.z)); \
    }                                                                                            \
    inline vec4 fn_##name(vec4 a, vec4 b, vec4 c) {                                              \
      return vec4(fn_##name(a.x, b.x, c.x), fn_##name(a.y, b.y, c.y), fn_##name(a.z, b.z, c.z),  \
                  fn_##name(a.w, b.w, c.w));                                                     \
    }
#define LAST_ONE(name)                    \
    inline vec2 fn_##name(vec2 a, real b) { \
      return fn_##name(a, vec2(b));         \
    }                                       \
    inline vec3 fn_##name(vec3 a, real b) { \
      return fn_##name(a, vec3(b));         \
    }                                       \
    inline vec4 fn_##name(vec4 a, real b) { \
      return fn_##name(a, vec4(b));         \
    }
#define EACH(T)                                 \
    inline T fn_step(real a, T b) {               \
      return fn_step(T(a), b);                    \
    }                                             \
    inline T fn_clamp(T a, real b, real c) {      \
      return fn_clamp(a, T(b), T(c));             \
    }                                             \
    inline T fn_mix(T a, T b, real c) {           \
      return fn_mix(a, b, T(c));                  \
    }                                             \
    inline T fn_smoothstep(real a, real b, T c) { \
      return fn_smoothstep(T(a), T(b), c);        \
    }                                             \
    inline real fn_length(T a) {                  \
      return __builtin_sqrt(fn_dot(a, a));        \
    }                                             \
    inline real fn_distance(T a, T b) {           \
      return fn_length(a - b);                    \
    }                                             \
    inline T fn_normalize(T a) {                  \
      return a / fn_length(a);                    \
    }
  ONE(abs, __builtin_fabs(x))
  ONE(sign, real(x > 0) - real(x < 0))
  ONE(floor, __builtin_floor(x))
  ONE(ceil, __builtin_ceil(x))
  ONE(trunc, __builtin_trunc(x))
  ONE(round, __builtin_floor(x + 0.5))
  ONE(fract, x - __builtin_floor(x))
  ONE(sqrt, __builtin_sqrt(x))
  ONE(inversesqrt, 1 / __builtin_sqrt(x))
  ONE(radians, x * 0.017453292519943295)
  ONE(degrees, x * 57.29577951308232)
  ONE(sin, __builtin_sin(x))
  ONE(cos, __builtin_cos(x))
  ONE(tan, __builtin_tan(x))
  ONE(asin, __builtin_asin(x))
  ONE(acos, __builtin_acos(x))
  ONE(atan, __builtin_atan(x))
  TWO(atan, __builtin_atan2(x, y))
  ONE(exp, __builtin_exp(x))
  ONE(log, __builtin_log(x))
  ONE(exp2, __builtin_exp2(x))
  ONE(log2, __builtin_log2(x))
  TWO(pow, __builtin_pow(x, y))
  ONE(sinh, __builtin_sinh(x))
  ONE(cosh, __builtin_cosh(x))
  ONE(tanh, __builtin_tanh(x))
  TWO(min, y < x ? y : x)
  TWO(max, x < y ? y : x)
  LAST_ONE(min)
  LAST_ONE(max)
  TWO(mod, x - y * __builtin_floor(x / y))
  LAST_ONE(mod)
  TWO(step, y < x ? 0.0 : 1.0)
  THREE(clamp, fn_min(fn_max(x, y), z))
  THREE(mix, x + (y - x) * z)
  inline real hermite(real t) {
    return t * t * (3 - 2 * t);
  }
  THREE(smoothstep, hermite(fn_clamp((z - x) / (y - x), 0, 1)))
  inline real fn_dot(real a, real b) {
    return a * b;
  }
  inline real fn_dot(vec2 a, vec2 b) {
    return a.x * b.x + a.y * b.y;
  }
  inline real fn_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  inline real fn_dot(vec4 a, vec4 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  }
  EACH(vec2)
  EACH(vec3)
  EACH(vec4)
  inline real fn_length(real a) {
    return __builtin_fabs(a);
  }
  inline real fn_distance(real a, real b) {
    return __builtin_fabs(a - b);
  }
  inline vec3 fn_cross(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  }
  inline vec2 fn_reflect(vec2 v, vec2 n) {
    return v - n * (2 * fn_dot(n, v));
  }
  inline vec3 fn_reflect(vec3 v, vec3 n) {
    return v - n * (2 * fn_dot(n, v));
  }
)cpp";

// A shader file without its #includes.
std::string shader(std::string_view name) {
  const auto shaders = embedded_shaders();
  const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
  CHECK(found != shaders.end());
  std::string text;
  for (std::string_view rest = found->text; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    if (!rest.starts_with("#include")) text += rest.substr(0, end);
    rest.remove_prefix(end);
  }
  return text;
}

}  // namespace

std::string cpp_unit(std::string_view constants32, std::string_view constants64, std::string_view program) {
  const auto value = [](std::string_view scope, std::string_view real) {
    return fmt::format(
        "EXPORT int eyeray_{0}({1} x, {1} y, {1} z, {1}* value) {{\n  turns = 0;\n"
        "  *value = {0}::u_f({0}::vec3(x, y, z));\n  return turns > FORMULA_TURNS;\n}}\n",
        scope, real);
  };
  const std::string functions = shader("math.glsl") + shader("formula.glsl");
  // The shaders' macros would stand in the way of nothing: what a formula names has a prefix.
  return fmt::format(
      "{}namespace f32 {{\ntypedef float real;\n{}{}{}inline bool turn() {{ return ++turns <= FORMULA_TURNS; "
      "}}\n"
      "{}{}}}\nnamespace f64 {{\ntypedef double real;\n{}{}"
      "inline bool turn() {{ return ++turns <= FORMULA_TURNS; }}\n{}{}}}\n}}\n{}{}",
      start, types, shader_basis, functions, constants32, program, types, library_functions, constants64,
      program, value("f32", "float"), value("f64", "double"));
}

}  // namespace eyeray::formula
