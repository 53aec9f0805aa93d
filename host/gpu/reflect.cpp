#include "host/gpu/reflect.hpp"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <map>
#include <optional>

#include "host/spirv/words.hpp"

namespace eyeray::engine::gpu {
namespace {

struct Member {
  std::string name;
  std::optional<uint32_t> offset;
  uint32_t matrix_stride = 0;
};

struct Id {
  std::string name;
  std::map<uint32_t, Member> members;
  std::optional<uint32_t> set, binding, array_stride;
  bool buffer_block = false;
  std::vector<uint32_t> definition;  // the type or constant instruction
};

struct Variable {
  uint32_t id, pointer, storage;
};

// The ids of a module that matter here, and how large their types are in memory.
struct Module {
  std::map<uint32_t, Id> ids;
  std::vector<uint32_t> structs;
  std::vector<Variable> variables;
  std::array<uint32_t, 3> local_size{1, 1, 1};

  explicit Module(std::span<const uint32_t> spirv) {
    spirv::for_each_instruction(spirv,
                                [&](uint32_t opcode, std::span<const uint32_t> i) { read(opcode, i); });
  }

  void read(uint32_t opcode, std::span<const uint32_t> i) {
    switch (opcode) {
      case spv::OpName:
        ids[i[1]].name = spirv::string_at(i, 2);
        break;
      case spv::OpMemberName:
        ids[i[1]].members[i[2]].name = spirv::string_at(i, 3);
        break;
      case spv::OpMemberDecorate:
        if (i[3] == spv::DecorationOffset) ids[i[1]].members[i[2]].offset = i[4];
        if (i[3] == spv::DecorationMatrixStride) ids[i[1]].members[i[2]].matrix_stride = i[4];
        break;
      case spv::OpDecorate:
        if (i[2] == spv::DecorationDescriptorSet) ids[i[1]].set = i[3];
        if (i[2] == spv::DecorationBinding) ids[i[1]].binding = i[3];
        if (i[2] == spv::DecorationArrayStride) ids[i[1]].array_stride = i[3];
        if (i[2] == spv::DecorationBufferBlock) ids[i[1]].buffer_block = true;
        break;
      case spv::OpExecutionMode:
        if (i[2] == spv::ExecutionModeLocalSize) local_size = {i[3], i[4], i[5]};
        break;
      case spv::OpTypeStruct:
        structs.push_back(i[1]);
        [[fallthrough]];
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
      case spv::OpTypeArray:
      case spv::OpTypeRuntimeArray:
      case spv::OpTypePointer:
      case spv::OpTypeImage:
      case spv::OpTypeSampledImage:
        ids[i[1]].definition.assign(i.begin(), i.end());
        break;
      case spv::OpConstant:
        ids[i[2]].definition.assign(i.begin(), i.end());
        break;
      case spv::OpVariable:
        variables.push_back({i[2], i[1], i[3]});
        break;
      default:
        break;
    }
  }

  // Bytes of a type, with `matrix_stride` bytes for each column of a matrix; 0 for a run-time array.
  uint32_t size(uint32_t type, uint32_t matrix_stride = 0) const {
    const Id& id = ids.at(type);
    const std::vector<uint32_t>& i = id.definition;
    switch (i.empty() ? uint32_t(spv::OpNop) : i[0] & 0xffffu) {
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        return i[2] / 8;
      case spv::OpTypeVector:
        return size(i[2]) * i[3];
      case spv::OpTypeMatrix:
        return matrix_stride * i[3];
      case spv::OpTypeArray:
        return id.array_stride.value_or(0) * ids.at(i[3]).definition.at(3);
      case spv::OpTypeStruct: {
        uint32_t end = 0;
        for (const auto& [index, member] : id.members)
          end = std::max(end, member.offset.value_or(0) + size(i[2 + index], member.matrix_stride));
        return end;
      }
      default:
        return 0;
    }
  }
};

// The kind of a variable's binding, if eyeray binds it; `image` is set for one of BindingKind::image.
std::optional<BindingKind> binding_kind(const Module& module, const Variable& variable,
                                        ReflectedImage& image) {
  if (variable.storage == spv::StorageClassStorageBuffer) return BindingKind::storage;
  const Id& target = module.ids.at(module.ids.at(variable.pointer).definition.at(3));
  const std::vector<uint32_t>& type = target.definition;
  const bool block = !type.empty() && (type[0] & 0xffffu) == spv::OpTypeStruct;
  if (variable.storage == spv::StorageClassUniform && block)
    return target.buffer_block ? BindingKind::storage : BindingKind::uniform;
  const bool texels = !type.empty() && (type[0] & 0xffffu) == spv::OpTypeImage && type[3] == spv::DimBuffer &&
                      type[7] == 2 && type[8] == spv::ImageFormatRgba32ui;
  if (variable.storage != spv::StorageClassUniformConstant || type.empty()) return std::nullopt;
  if (texels) return BindingKind::texels;
  image.combined = (type[0] & 0xffffu) == spv::OpTypeSampledImage;
  if (read_image_type(image.combined ? module.ids.at(type[2]).definition : type, image))
    return BindingKind::image;
  return std::nullopt;
}

bool has_layout(const Id& type) {
  return !type.members.empty() && std::all_of(type.members.begin(), type.members.end(),
                                              [](const auto& m) { return m.second.offset.has_value(); });
}

}  // namespace

Reflection reflect(std::span<const uint32_t> spirv) {
  const Module module(spirv);
  Reflection reflection;
  reflection.local_size = module.local_size;
  for (const Variable& variable : module.variables) {
    const auto found = module.ids.find(variable.id);
    if (found == module.ids.end()) continue;  // neither named nor bound: a local variable
    const Id& id = found->second;
    if (variable.storage == spv::StorageClassPushConstant)
      // Vulkan sets them in words.
      reflection.push_constant_bytes =
          (module.size(module.ids.at(variable.pointer).definition.at(3)) + 3) / 4 * 4;
    if (!id.binding) continue;
    ReflectedImage image;
    const std::optional<BindingKind> kind = binding_kind(module, variable, image);
    if (!kind || id.set.value_or(0) != 0)
      throw Error(
          ExitCode::bad_input,
          "the shader binds '{}' at set {}, binding {}: eyeray provides only storage buffers, uniform "
          "buffers, texel buffers (uimageBuffer, rgba32ui), and images of one to three axes, in set 0",
          id.name, id.set.value_or(0), *id.binding);
    reflection.bindings.emplace(*id.binding, *kind);
    if (kind == BindingKind::image) reflection.images.emplace(*id.binding, image);
  }
  for (const uint32_t type : module.structs) {
    const Id& id = module.ids.at(type);
    if (!has_layout(id)) continue;
    ReflectedStruct& result = reflection.structs.emplace_back();
    result.name = id.name;
    result.size = module.size(type);
    for (const auto& [index, member] : id.members) result.members.push_back({member.name, *member.offset});
  }
  return reflection;
}

}  // namespace eyeray::engine::gpu
