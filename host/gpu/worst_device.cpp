#include "host/gpu/worst_device.hpp"

#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "host/gpu/float_policy.hpp"
#include "host/spirv/module.hpp"

namespace eyeray::engine::gpu {
namespace {

enum class Scalar { boolean, uint32, float32, float64 };

// The scalars and vectors of a module, by the kind and the count of their components.
class NumberTypes {
 public:
  explicit NumberTypes(spirv::Module& module) : module_(module) {
    for (const spirv::Instruction& i : module.declarations) see(i);
  }

  // The number of components of a type; 0 if it is neither a scalar nor a vector of that kind.
  uint32_t components(uint32_t type, Scalar scalar) const {
    const auto found = kinds_.find(type);
    return found != kinds_.end() && found->second.first == scalar ? found->second.second : 0;
  }

  // The number of components of a type of any kind; 1 for those that are unknown.
  uint32_t components(uint32_t type) const {
    const auto found = kinds_.find(type);
    return found == kinds_.end() ? 1 : found->second.second;
  }

  uint32_t type(Scalar scalar, uint32_t components) {
    for (const auto& [id, kind] : kinds_)
      if (kind == std::pair(scalar, components)) return id;
    if (components > 1) {
      const uint32_t component = type(scalar, 1);
      return declare(spirv::instruction(spv::OpTypeVector, {module_.new_id(), component, components}));
    }
    switch (scalar) {
      case Scalar::boolean:
        return declare(spirv::instruction(spv::OpTypeBool, {module_.new_id()}));
      case Scalar::uint32:
        return declare(spirv::instruction(spv::OpTypeInt, {module_.new_id(), 32, 0}));
      case Scalar::float32:
        return declare(spirv::instruction(spv::OpTypeFloat, {module_.new_id(), 32}));
      case Scalar::float64:
        module_.declarations.insert(
            module_.declarations.begin(),
            spirv::instruction(spv::OpCapability, {uint32_t(spv::CapabilityFloat64)}));
        return declare(spirv::instruction(spv::OpTypeFloat, {module_.new_id(), 64}));
    }
    return 0;
  }

  // A constant of uint32, the same in each component.
  uint32_t constant(uint32_t value, uint32_t components) {
    uint32_t& id = constants_[{value, components}];
    if (id != 0) return id;
    const uint32_t its_type = type(Scalar::uint32, components);
    const uint32_t component = components > 1 ? constant(value, 1) : 0;
    id = module_.new_id();
    spirv::Instruction made{0, its_type, id};
    made.insert(made.end(), components > 1 ? components : 1, components > 1 ? component : value);
    made[0] = uint32_t(made.size()) << spv::WordCountShift |
              uint32_t(components > 1 ? spv::OpConstantComposite : spv::OpConstant);
    module_.declarations.push_back(std::move(made));
    return id;
  }

 private:
  void see(const spirv::Instruction& i) {
    if (spirv::opcode_of(i) == spv::OpTypeBool) kinds_[i[1]] = {Scalar::boolean, 1};
    if (spirv::opcode_of(i) == spv::OpTypeInt && i[2] == 32 && i[3] == 0) kinds_[i[1]] = {Scalar::uint32, 1};
    if (spirv::opcode_of(i) == spv::OpTypeFloat)
      kinds_[i[1]] = {i[2] == 32 ? Scalar::float32 : Scalar::float64, 1};
    if (spirv::opcode_of(i) == spv::OpTypeVector && kinds_.contains(i[2]))
      kinds_[i[1]] = {kinds_[i[2]].first, i[3]};
  }
  uint32_t declare(spirv::Instruction instruction) {
    module_.declarations.push_back(std::move(instruction));
    see(module_.declarations.back());
    return module_.declarations.back()[1];
  }

  spirv::Module& module_;
  std::map<uint32_t, std::pair<Scalar, uint32_t>> kinds_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> constants_;
};

std::set<uint32_t> with_no_contraction(const spirv::Module& module) {
  std::set<uint32_t> ids;
  for (const spirv::Instruction& i : module.declarations)
    if (spirv::opcode_of(i) == spv::OpDecorate && i[2] == spv::DecorationNoContraction) ids.insert(i[1]);
  return ids;
}

// Replaces instructions one by one by several.
class Rewriter {
 protected:
  explicit Rewriter(spirv::Module& module) : module_(module), types_(module) {}

  // Calls rewrite(i) for every instruction of every function. It adds the instructions that replace i.
  template <typename Rewrite>
  void rewrite_all(const Rewrite& rewrite) {
    for (spirv::Function& function : module_.functions) {
      for (spirv::Block& block : function.blocks) {
        for (spirv::Instruction& i : std::exchange(block.body, {})) rewrite(i);
        block.body = std::exchange(body_, {});
      }
    }
  }

  void add(spirv::Instruction instruction) { body_.push_back(std::move(instruction)); }
  // Adds an instruction with a result, which gets the id `result`, or a new one.
  uint32_t add(spv::Op opcode, uint32_t type, std::initializer_list<uint32_t> operands, uint32_t result = 0) {
    if (result == 0) result = module_.new_id();
    spirv::Instruction i{0, type, result};
    i.insert(i.end(), operands);
    i[0] = uint32_t(i.size()) << spv::WordCountShift | uint32_t(opcode);
    add(std::move(i));
    return result;
  }

  spirv::Module& module_;
  NumberTypes types_;

 private:
  std::vector<spirv::Instruction> body_;
};

// Rounds a·b ± c and c ± a·b once, in float64, where neither operation has NoContraction, and fma in any
// case. The optimiser also makes an fma of operations that may be contracted.
class Contractor : Rewriter {
 public:
  explicit Contractor(spirv::Module& module) : Rewriter(module), exact_(with_no_contraction(module)) {}

  void run() {
    rewrite_all([&](const spirv::Instruction& i) {
      const spv::Op opcode = spirv::opcode_of(i);
      if (opcode == spv::OpFMul || opcode == spv::OpVectorTimesScalar) products_[i[2]] = i;
      if (opcode == spv::OpExtInst && i[4] == GLSLstd450Fma) return fuse(i);
      const bool sums = opcode == spv::OpFAdd || opcode == spv::OpFSub;
      if (!sums || exact_.contains(i[2]) || !(is_free(i[3]) || is_free(i[4]))) return add(i);
      const uint32_t wide = types_.type(Scalar::float64, types_.components(i[1]));
      const bool first = is_free(i[3]);
      const uint32_t product = widened(products_[i[first ? 3 : 4]], wide);
      const uint32_t other = add(spv::OpFConvert, wide, {i[first ? 4 : 3]});
      add(spv::OpFConvert, i[1], {add(opcode, wide, {first ? product : other, first ? other : product})},
          i[2]);
    });
  }

 private:
  void fuse(const spirv::Instruction& fma) {
    const uint32_t wide = types_.type(Scalar::float64, types_.components(fma[1]));
    const uint32_t a = add(spv::OpFConvert, wide, {fma[5]}), b = add(spv::OpFConvert, wide, {fma[6]});
    const uint32_t c = add(spv::OpFConvert, wide, {fma[7]});
    const uint32_t sum = add(spv::OpFAdd, wide, {add(spv::OpFMul, wide, {a, b}), c});
    add(spv::OpFConvert, fma[1], {sum}, fma[2]);
  }

  bool is_free(uint32_t id) const { return products_.contains(id) && !exact_.contains(id); }

  uint32_t widened(const spirv::Instruction& product, uint32_t wide) {
    const bool scales = spirv::opcode_of(product) == spv::OpVectorTimesScalar;
    const uint32_t a = add(spv::OpFConvert, wide, {product[3]});
    const uint32_t b = add(spv::OpFConvert, scales ? types_.type(Scalar::float64, 1) : wide, {product[4]});
    return add(spirv::opcode_of(product), wide, {a, b});
  }

  std::set<uint32_t> exact_;
  std::map<uint32_t, spirv::Instruction> products_;
};

// Lets FMin and FMax, and FClamp, which is both, return their second operand if it equals the first or one is
// NaN: the opposite of `minimum` and `maximum` (math/math.glsl).
class ExtremeChooser : Rewriter {
 public:
  explicit ExtremeChooser(spirv::Module& module) : Rewriter(module) {}

  void run() {
    rewrite_all([&](const spirv::Instruction& i) {
      const uint32_t function = spirv::opcode_of(i) == spv::OpExtInst ? i[4] : 0;
      if (function == GLSLstd450FMin || function == GLSLstd450FMax) {
        choose(i, function, i[5], i[6], i[2]);
      } else if (function == GLSLstd450FClamp) {
        const uint32_t lower = module_.new_id();
        choose(i, GLSLstd450FMax, i[5], i[6], lower);
        choose(i, GLSLstd450FMin, lower, i[7], i[2]);
      } else {
        add(i);
      }
    });
  }

 private:
  void choose(const spirv::Instruction& i, uint32_t function, uint32_t a, uint32_t b, uint32_t result) {
    const uint32_t count = types_.components(i[1]);
    const uint32_t own = add(spv::OpExtInst, i[1], {i[3], function, a, b});
    const uint32_t free = add(spv::OpFUnordEqual, types_.type(Scalar::boolean, count), {a, b});
    add(spv::OpSelect, i[1], {free, b, own}, result);
  }
};

// Flushes denormal operands and results of arithmetic, and denormal operands of comparisons and conversions.
class Flusher : Rewriter {
 public:
  explicit Flusher(spirv::Module& module) : Rewriter(module), exact_(with_no_contraction(module)) {
    for (const spirv::Function& function : module.functions)
      for (const spirv::Block& block : function.blocks)
        for (const spirv::Instruction& i : block.body)
          if (computes(i)) flushed_.insert(i[2]);
  }

  void run() {
    rewrite_all([&](spirv::Instruction& i) {
      const bool result = computes(i);
      if (!result && !reads(i)) return add(std::move(i));
      if (!result || spirv::opcode_of(i) != spv::OpFConvert) flush_operands(i);
      if (!result) return add(std::move(i));
      const uint32_t own = module_.new_id();
      const uint32_t given = std::exchange(i[2], own);
      const uint32_t count = types_.components(i[1]);
      if (exact_.contains(given)) renamed_[given] = own;
      add(std::move(i));
      flush(own, count, given);
    });
    for (spirv::Instruction& i : module_.declarations)
      if (spirv::opcode_of(i) == spv::OpDecorate && i[2] == spv::DecorationNoContraction &&
          renamed_.contains(i[1]))
        i[1] = renamed_[i[1]];
  }

 private:
  bool computes(const spirv::Instruction& i) const {
    const spv::Op opcode = spirv::opcode_of(i);
    const bool arithmetic = is_float_arithmetic(opcode) || opcode == spv::OpFConvert ||
                            (opcode == spv::OpExtInst && functions.contains(i[4]));
    return arithmetic && opcode != spv::OpDot && types_.components(i[1], Scalar::float32) > 0;
  }
  static bool reads(const spirv::Instruction& i) {
    const spv::Op opcode = spirv::opcode_of(i);
    return (opcode >= spv::OpFOrdEqual && opcode <= spv::OpFUnordGreaterThanEqual) ||
           opcode == spv::OpConvertFToS || opcode == spv::OpConvertFToU || opcode == spv::OpFConvert;
  }

  // All operands of an instruction have as many components as its result, except for the factor of a vector.
  void flush_operands(spirv::Instruction& i) {
    for (size_t k = spirv::opcode_of(i) == spv::OpExtInst ? 5 : 3; k < i.size(); ++k) {
      const bool is_factor = spirv::opcode_of(i) == spv::OpVectorTimesScalar && k == 4;
      if (!flushed_.contains(i[k])) i[k] = flush(i[k], is_factor ? 1 : types_.components(i[1]), 0);
    }
  }

  // The float32 of so many components without its digits if its exponent is 0.
  uint32_t flush(uint32_t id, uint32_t count, uint32_t result) {
    const uint32_t words = types_.type(Scalar::uint32, count);
    const uint32_t bits = add(spv::OpBitcast, words, {id});
    const uint32_t exponent = add(spv::OpBitwiseAnd, words, {bits, types_.constant(0x7f800000u, count)});
    const uint32_t tiny =
        add(spv::OpIEqual, types_.type(Scalar::boolean, count), {exponent, types_.constant(0, count)});
    const uint32_t sign = add(spv::OpBitwiseAnd, words, {bits, types_.constant(0x80000000u, count)});
    return add(spv::OpBitcast, types_.type(Scalar::float32, count),
               {add(spv::OpSelect, words, {tiny, sign, bits})}, result);
  }

  // The functions of GLSL.std.450 that shaders use, or may use, on floats alone.
  static inline const std::set<uint32_t> functions = {GLSLstd450FAbs, GLSLstd450Floor, GLSLstd450Sqrt,
                                                      GLSLstd450FMin, GLSLstd450FMax,  GLSLstd450FClamp};
  std::set<uint32_t> exact_, flushed_;
  std::map<uint32_t, uint32_t> renamed_;
};

bool preserves_denormals(const spirv::Module& module) {
  return std::ranges::any_of(module.declarations, [](const spirv::Instruction& i) {
    return spirv::opcode_of(i) == spv::OpExecutionMode && i[2] == spv::ExecutionModeDenormPreserve;
  });
}

}  // namespace

std::vector<uint32_t> on_worst_device(std::span<const uint32_t> spirv, const WorstDevice& worst) {
  spirv::Module module = spirv::read(spirv);
  if (worst.contraction) Contractor(module).run();
  if (worst.nan) ExtremeChooser(module).run();
  if (worst.denormals && !preserves_denormals(module)) Flusher(module).run();
  return spirv::write(module);
}

}  // namespace eyeray::engine::gpu
