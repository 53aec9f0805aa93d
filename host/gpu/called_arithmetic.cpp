#include "host/gpu/called_arithmetic.hpp"

#include <spirv/unified1/GLSL.std.450.h>

#include <map>
#include <set>
#include <string>

#include "host/core/error.hpp"
#include "host/spirv/module.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::gpu {
namespace {

// The functions of floats whose result Vulkan leaves to the device, in its rounding, or for NaN and zeros.
constexpr struct {
  uint32_t function;
  std::string_view name;
} inexact_functions[] = {{GLSLstd450Radians, "radians"},
                         {GLSLstd450Degrees, "degrees"},
                         {GLSLstd450Sin, "sin"},
                         {GLSLstd450Cos, "cos"},
                         {GLSLstd450Tan, "tan"},
                         {GLSLstd450Asin, "asin"},
                         {GLSLstd450Acos, "acos"},
                         {GLSLstd450Atan, "atan"},
                         {GLSLstd450Sinh, "sinh"},
                         {GLSLstd450Cosh, "cosh"},
                         {GLSLstd450Tanh, "tanh"},
                         {GLSLstd450Asinh, "asinh"},
                         {GLSLstd450Acosh, "acosh"},
                         {GLSLstd450Atanh, "atanh"},
                         {GLSLstd450Atan2, "atan"},
                         {GLSLstd450Pow, "pow"},
                         {GLSLstd450Exp, "exp"},
                         {GLSLstd450Log, "log"},
                         {GLSLstd450Exp2, "exp2"},
                         {GLSLstd450Log2, "log2"},
                         {GLSLstd450InverseSqrt, "inversesqrt"},
                         {GLSLstd450FMin, "min"},
                         {GLSLstd450FMax, "max"},
                         {GLSLstd450FClamp, "clamp"},
                         {GLSLstd450FMix, "mix"},
                         {GLSLstd450SmoothStep, "smoothstep"},
                         {GLSLstd450Fma, "fma"},
                         {GLSLstd450Length, "length"},
                         {GLSLstd450Distance, "distance"},
                         {GLSLstd450Cross, "cross"},
                         {GLSLstd450Normalize, "normalize"},
                         {GLSLstd450Reflect, "reflect"},
                         {GLSLstd450Refract, "refract"}};

class Caller {
 public:
  Caller(std::span<const uint32_t> spirv, std::string_view prefix)
      : module_(spirv::read(spirv)), prefix_(prefix) {
    for (const spirv::Instruction& i : module_.declarations) {
      if (spirv::opcode_of(i) == spv::OpName) names_[i[1]] = spirv::string_at(i, 2);
      if (spirv::opcode_of(i) == spv::OpTypeFloat && i[2] == 32) float_ = i[1];
      if (spirv::opcode_of(i) == spv::OpTypeVector && i[2] == float_) components_[i[1]] = i[3];
    }
  }

  std::vector<uint32_t> called() {
    for (spirv::Function& function : module_.functions) {
      const std::string& name = names_[function.head[0][2]];
      if (name.starts_with(prefix_) || name.starts_with("worst")) continue;
      for (spirv::Block& block : function.blocks) call_in(block);
    }
    // A call rounds as the function does.
    std::erase_if(module_.declarations, [&](const spirv::Instruction& i) {
      return spirv::opcode_of(i) == spv::OpDecorate && i[2] == spv::DecorationNoContraction &&
             replaced_.contains(i[1]);
    });
    return spirv::write(module_);
  }

 private:
  void call_in(spirv::Block& block) {
    std::vector<spirv::Instruction> body;
    for (const spirv::Instruction& i : block.body) {
      refuse(i);
      const bool divides = spirv::opcode_of(i) == spv::OpFDiv;
      const bool is_root = spirv::opcode_of(i) == spv::OpExtInst && i[4] == GLSLstd450Sqrt;
      if (divides || is_root)
        call(body, i[1], i[2], divides ? "_quotient(" : "_root(", std::span(i).subspan(divides ? 3 : 5));
      else
        body.push_back(i);
    }
    block.body = std::move(body);
  }

  void call(std::vector<spirv::Instruction>& body, uint32_t type, uint32_t result, std::string_view name,
            std::span<const uint32_t> operands) {
    replaced_.insert(result);
    if (type == float_) {
      call_one(body, result, name, {operands.begin(), operands.end()});
      return;
    }
    const auto vector = components_.find(type);
    if (vector == components_.end()) return unknown("a division of a type that is not float or a vector");
    spirv::Instruction whole{0, type, result};
    for (uint32_t component = 0; component < vector->second; ++component) {
      std::vector<uint32_t> parts;
      for (const uint32_t operand : operands) {
        parts.push_back(module_.new_id());
        body.push_back(
            spirv::instruction(spv::OpCompositeExtract, {float_, parts.back(), operand, component}));
      }
      whole.push_back(module_.new_id());
      call_one(body, whole.back(), name, parts);
    }
    whole[0] = uint32_t(whole.size()) << spv::WordCountShift | uint32_t(spv::OpCompositeConstruct);
    body.push_back(std::move(whole));
  }

  void call_one(std::vector<spirv::Instruction>& body, uint32_t result, std::string_view name,
                const std::vector<uint32_t>& operands) {
    spirv::Instruction call = spirv::instruction(spv::OpFunctionCall, {float_, result, function_named(name)});
    call.insert(call.end(), operands.begin(), operands.end());
    call[0] = uint32_t(call.size()) << spv::WordCountShift | uint32_t(spv::OpFunctionCall);
    body.push_back(std::move(call));
  }

  uint32_t function_named(std::string_view name) const {
    for (const auto& [id, named] : names_)
      if (named.starts_with(prefix_ + std::string(name))) return id;
    throw Error(ExitCode::internal, "a kernel has no function {}{}…)", prefix_, name);
  }

  static void refuse(const spirv::Instruction& i) {
    switch (spirv::opcode_of(i)) {
      case spv::OpFRem:
      case spv::OpFMod:
        return unknown("mod");
      case spv::OpDot:
        return unknown("dot");
      case spv::OpVectorTimesMatrix:
      case spv::OpMatrixTimesVector:
      case spv::OpMatrixTimesMatrix:
        return unknown("a product of matrices");
      case spv::OpExtInst:
        for (const auto& [function, name] : inexact_functions)
          if (i[4] == function) unknown(name);
        return;
      default:
        return;
    }
  }

  [[noreturn]] static void unknown(std::string_view what) {
    throw Error(
        ExitCode::bad_input,
        "a shader uses {}, whose result differs between devices; write it with + - * / sqrt, comparisons "
        "and the functions of math/math.glsl",
        what);
  }

  spirv::Module module_;
  std::string prefix_;
  std::map<uint32_t, std::string> names_;
  std::map<uint32_t, uint32_t> components_;  // count of each type of float vectors
  std::set<uint32_t> replaced_;
  uint32_t float_ = 0;
};

}  // namespace

std::vector<uint32_t> call_for_arithmetic(std::span<const uint32_t> spirv, std::string_view prefix) {
  return Caller(spirv, prefix).called();
}

}  // namespace eyeray::engine::gpu
