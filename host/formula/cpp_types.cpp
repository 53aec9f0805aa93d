#include "formula/cpp_language.hpp"

namespace eyeray::formula {

namespace {

// Numbers and vectors over `real`. Integers are classes: nothing that a formula does with them is undefined,
// neither a division by 0 nor an overflow, and none of C++'s own conversions gets in the way.
constexpr std::string_view types = R"text(
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
#define OPERATORS(T, S)                                                                 \
WRAPS(T, S, +) WRAPS(T, S, -) WRAPS(T, S, *) WRAPS(T, S, &) WRAPS(T, S, |)            \
WRAPS(T, S, ^)                                                                        \
inline T operator<<(T a, T b) { return T(S(uint(a.v) << (uint(b.v) & 31u))); }        \
COMPARES(T, ==) COMPARES(T, !=) COMPARES(T, <) COMPARES(T, <=) COMPARES(T, >)         \
COMPARES(T, >=)                                                                       \
STORES(T, +) STORES(T, -) STORES(T, *) STORES(T, /) STORES(T, %) STORES(T, &)         \
STORES(T, |) STORES(T, ^) STORES(T, <<) STORES(T, >>)                                 \
inline T operator-(T a) { return T(S(0u - uint(a.v))); }                              \
inline T operator~(T a) { return T(S(~uint(a.v))); }                                  \
inline T& operator++(T& a) { return a = T(S(uint(a.v) + 1u)); }                       \
inline T& operator--(T& a) { return a = T(S(uint(a.v) - 1u)); }                       \
inline T operator++(T& a, int) { T b = a; ++a; return b; }                            \
inline T operator--(T& a, int) { T b = a; --a; return b; }
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
)text";

}  // namespace

std::string_view cpp_types() {
  return types;
}

}  // namespace eyeray::formula
