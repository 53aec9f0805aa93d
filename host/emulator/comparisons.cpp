#include <cmath>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {

Execute comparison(spv::Op op, uint32_t bits) {
  switch (op) {
    case spv::OpLogicalNot:
      return map<bool, bool, 1, ([](bool x) { return !x; })>;
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
      return naturals<2, ([](auto x, auto y) { return x == y; }), true>(bits);
    case spv::OpINotEqual:
      return naturals<2, ([](auto x, auto y) { return x != y; }), true>(bits);
    case spv::OpULessThan:
      return naturals<2, ([](auto x, auto y) { return x < y; }), true>(bits);
    case spv::OpULessThanEqual:
      return naturals<2, ([](auto x, auto y) { return x <= y; }), true>(bits);
    case spv::OpUGreaterThan:
      return naturals<2, ([](auto x, auto y) { return x > y; }), true>(bits);
    case spv::OpUGreaterThanEqual:
      return naturals<2, ([](auto x, auto y) { return x >= y; }), true>(bits);
    case spv::OpSLessThan:
      return integers<2, ([](auto x, auto y) { return x < y; }), true>(bits);
    case spv::OpSLessThanEqual:
      return integers<2, ([](auto x, auto y) { return x <= y; }), true>(bits);
    case spv::OpSGreaterThan:
      return integers<2, ([](auto x, auto y) { return x > y; }), true>(bits);
    case spv::OpSGreaterThanEqual:
      return integers<2, ([](auto x, auto y) { return x >= y; }), true>(bits);
    case spv::OpFOrdEqual:
      return reals<2, ([](auto x, auto y) { return x == y; }), true>(bits);
    case spv::OpFUnordEqual:
      return reals<2, ([](auto x, auto y) { return !(x < y || x > y); }), true>(bits);
    case spv::OpFOrdNotEqual:
      return reals<2, ([](auto x, auto y) { return x < y || x > y; }), true>(bits);
    case spv::OpFUnordNotEqual:
      return reals<2, ([](auto x, auto y) { return x != y; }), true>(bits);
    case spv::OpFOrdLessThan:
      return reals<2, ([](auto x, auto y) { return x < y; }), true>(bits);
    case spv::OpFOrdLessThanEqual:
      return reals<2, ([](auto x, auto y) { return x <= y; }), true>(bits);
    case spv::OpFOrdGreaterThan:
      return reals<2, ([](auto x, auto y) { return x > y; }), true>(bits);
    case spv::OpFOrdGreaterThanEqual:
      return reals<2, ([](auto x, auto y) { return x >= y; }), true>(bits);
    case spv::OpFUnordLessThan:
      return reals<2, ([](auto x, auto y) { return !(x >= y); }), true>(bits);
    case spv::OpFUnordLessThanEqual:
      return reals<2, ([](auto x, auto y) { return !(x > y); }), true>(bits);
    case spv::OpFUnordGreaterThan:
      return reals<2, ([](auto x, auto y) { return !(x <= y); }), true>(bits);
    case spv::OpFUnordGreaterThanEqual:
      return reals<2, ([](auto x, auto y) { return !(x < y); }), true>(bits);
    case spv::OpIsNan:
      return reals<1, ([](auto x) { return std::isnan(x); }), true>(bits);
    case spv::OpIsInf:
      return reals<1, ([](auto x) { return std::isinf(x); }), true>(bits);
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
