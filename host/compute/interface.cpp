#include "host/compute/interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "host/core/error.hpp"
#include "host/spirv/module.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::compute {
namespace {

// Bytes of one buffer's layout at most, so that sums of offsets fit 64 bits.
constexpr uint64_t most_layout_bytes = uint64_t{1} << 40;

// The declarations of a module that matter here.
class Declarations {
 public:
  explicit Declarations(std::span<const uint32_t> spirv) : module_(spirv::read(spirv)) {
    for (const spirv::Instruction& i : module_.declarations) note(i);
  }

  const std::vector<spirv::Instruction>& all() const { return module_.declarations; }
  const std::string& name(uint32_t id) { return names_[id]; }
  bool has(uint32_t id, spv::Decoration decoration) { return decorations_[id].contains(decoration); }
  uint32_t value(uint32_t id, spv::Decoration decoration) { return decorations_[id][decoration]; }
  // True if all members of a structure have it.
  bool all_members_have(uint32_t id, spv::Decoration decoration) {
    const size_t members = definition(id).size() - 2;
    size_t with = 0;
    for (const auto& [key, decorations] : members_)
      if (key.first == id && decorations.contains(decoration)) ++with;
    return members > 0 && with == members;
  }
  // A type or constant. Error (bad_input) if it is of a kind that no buffer has.
  const spirv::Instruction& definition(uint32_t id) const {
    const auto found = definitions_.find(id);
    if (found == definitions_.end())
      throw Error(ExitCode::bad_input,
                  "a kernel's interface has a type or a length, %{}, that eyeray does not know", id);
    return found->second;
  }

  TypePtr type(uint32_t id, uint32_t parent = 0, uint32_t member = 0);

 private:
  void note(const spirv::Instruction& i);

  spirv::Module module_;
  std::map<uint32_t, std::string> names_;
  std::map<uint32_t, spirv::Instruction> definitions_;  // the types and constants
  std::map<uint32_t, std::map<uint32_t, uint32_t>> decorations_;
  using MemberKey = std::pair<uint32_t, uint32_t>;  // the structure and the member's index
  std::map<MemberKey, std::map<uint32_t, uint32_t>> members_;
  std::map<MemberKey, std::string> member_names_;
};

void Declarations::note(const spirv::Instruction& i) {
  switch (spirv::opcode_of(i)) {
    case spv::OpName:
      names_[i[1]] = spirv::string_at(i, 2);
      break;
    case spv::OpMemberName:
      member_names_[{i[1], i[2]}] = spirv::string_at(i, 3);
      break;
    case spv::OpDecorate:
      decorations_[i[1]][i[2]] = i.size() > 3 ? i[3] : 0;
      break;
    case spv::OpMemberDecorate:
      members_[{i[1], i[2]}][i[3]] = i.size() > 4 ? i[4] : 0;
      break;
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
    case spv::OpTypeBool:
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray:
    case spv::OpTypeStruct:
    case spv::OpTypePointer:
    case spv::OpTypeImage:
    case spv::OpTypeSampler:
    case spv::OpTypeSampledImage:
      definitions_[i[1]] = i;
      break;
    case spv::OpConstant:
    case spv::OpConstantComposite:
      definitions_[i[2]] = i;
      break;
    default:
      break;
  }
}

// `parent` and `member`: the structure's member that has this type, or an array of it.
TypePtr Declarations::type(uint32_t id, uint32_t parent, uint32_t member) {
  const spirv::Instruction& i = definition(id);
  Type made;
  const std::map<uint32_t, uint32_t>& placement = members_[{parent, member}];
  switch (spirv::opcode_of(i)) {
    case spv::OpTypeInt:
      made.number = {i[3] ? NumberKind::signed_integer : NumberKind::unsigned_integer, i[2]};
      break;
    case spv::OpTypeFloat:
      made.number = {NumberKind::real, i[2]};
      break;
    case spv::OpTypeVector:
      made = {.form = Form::vector, .element = type(i[2]), .count = i[3]};
      made.stride = made.element->number.bytes();
      break;
    case spv::OpTypeMatrix: {
      const auto stride = placement.find(spv::DecorationMatrixStride);
      const uint64_t apart = stride == placement.end() ? 0 : stride->second;
      made = {.form = Form::matrix, .element = type(i[2]), .count = i[3], .stride = apart};
      if (placement.contains(spv::DecorationRowMajor)) {
        auto column = std::make_shared<Type>(*made.element);
        made.stride = column->stride;
        column->stride = apart;
        made.element = column;
      }
      break;
    }
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray: {
      const bool sized = spirv::opcode_of(i) == spv::OpTypeArray;
      made = {.form = Form::array,
              .element = type(i[2], parent, member),
              .count = sized ? definition(i[3]).at(3) : 0,
              .stride = value(id, spv::DecorationArrayStride)};
      break;
    }
    case spv::OpTypeStruct: {
      made = {.form = Form::structure, .name = names_[id]};
      for (uint32_t n = 0; n + 2 < i.size(); ++n) {
        std::string member_name = member_names_[{id, n}];
        if (member_name.empty()) member_name = fmt::format("member{}", n);
        const auto& decorations = members_[{id, n}];
        const auto offset = decorations.find(spv::DecorationOffset);
        made.members.push_back({std::move(member_name), offset == decorations.end() ? 0 : offset->second,
                                type(i[n + 2], id, n)});
      }
      break;
    }
    default:
      throw Error(ExitCode::bad_input, "a kernel's buffer has a member of opcode {}, which is no data",
                  uint32_t(spirv::opcode_of(i)));
  }
  if (made.form == Form::array && made.stride > most_layout_bytes / std::max<uint64_t>(made.count, 1))
    throw Error(ExitCode::bad_input,
                "a kernel declares an array of {} elements of {} bytes, which is more than "
                "2^40 bytes",
                made.count, made.stride);
  return std::make_shared<Type>(std::move(made));
}

const char* kind_of(spv::Op op) {
  switch (op) {
    case spv::OpTypeImage:
      return "an image";
    case spv::OpTypeSampledImage:
      return "a sampled image";
    case spv::OpTypeSampler:
      return "a sampler";
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray:
      return "an array of bindings";
    default:
      return "a binding of another kind";
  }
}

// The uvec4s of a texel buffer.
TypePtr texels() {
  const auto number = std::make_shared<Type>(Type{.number = {NumberKind::unsigned_integer, 32}});
  const auto texel =
      std::make_shared<Type>(Type{.form = Form::vector, .element = number, .count = 4, .stride = 4});
  const auto array = std::make_shared<Type>(Type{.form = Form::array, .element = texel, .stride = 16});
  return std::make_shared<Type>(
      Type{.form = Form::structure, .name = "texels", .members = {{"texels", 0, array}}});
}

// The format of an image that declares none: numbers of 32 bits.
const gpu::TexelFormat& default_format(const spirv::Instruction& number) {
  const bool real = spirv::opcode_of(number) == spv::OpTypeFloat;
  return *gpu::find_format(real ? "rgba32f" : number[3] ? "rgba32i" : "rgba32ui");
}

}  // namespace

TypePtr image_type(const gpu::TexelFormat& format, uint32_t axes) {
  using Kind = emulator::Format::Kind;
  const emulator::Format& texel = format.numbers;
  const NumberKind kind = texel.kind == Kind::real ? NumberKind::real
                          : texel.kind == Kind::natural || texel.kind == Kind::unorm
                              ? NumberKind::unsigned_integer
                              : NumberKind::signed_integer;
  auto element = std::make_shared<Type>(Type{.number = {kind, texel.bits}});
  if (texel.components > 1)
    element = std::make_shared<Type>(
        Type{.form = Form::vector, .element = element, .count = texel.components, .stride = texel.bits / 8});
  return std::make_shared<Type>(Type{.form = Form::array,
                                     .element = element,
                                     .stride = texel.bytes(),
                                     .name = std::string(format.name),
                                     .extent = std::vector<uint64_t>(axes)});
}

std::vector<SpecConstant> spec_constants(std::span<const uint32_t> spirv) {
  Declarations declarations(spirv);
  std::vector<SpecConstant> constants;
  for (const spirv::Instruction& i : declarations.all()) {
    const spv::Op op = spirv::opcode_of(i);
    const bool boolean = op == spv::OpSpecConstantTrue || op == spv::OpSpecConstantFalse;
    if (op != spv::OpSpecConstant && !boolean) continue;
    if (!declarations.has(i[2], spv::DecorationSpecId)) continue;
    SpecConstant constant{.id = declarations.value(i[2], spv::DecorationSpecId),
                          .name = declarations.name(i[2]),
                          .number = {NumberKind::unsigned_integer, 32},
                          .boolean = boolean,
                          .bits = op == spv::OpSpecConstantTrue};
    if (!boolean) {
      constant.number = declarations.type(i[1])->number;
      constant.bits = i[3] | (i.size() > 4 ? uint64_t{i[4]} << 32 : 0);
    }
    constants.push_back(std::move(constant));
  }
  std::ranges::sort(constants, {}, &SpecConstant::id);
  return constants;
}

Interface interface_of(std::span<const uint32_t> spirv) {
  Declarations module(spirv);
  Interface found;
  for (const spirv::Instruction& i : module.all()) {
    if (spirv::opcode_of(i) == spv::OpExecutionMode && i[2] == spv::ExecutionModeLocalSize)
      found.local_size = {i[3], i[4], i[5]};
    if (spirv::opcode_of(i) != spv::OpVariable) continue;
    const uint32_t target = module.definition(i[1])[3];
    if (i[3] == spv::StorageClassPushConstant) found.push = module.type(target);
    if (!module.has(i[2], spv::DecorationBinding)) continue;
    const spirv::Instruction& type = module.definition(target);
    const spv::Op op = spirv::opcode_of(type);
    BufferSlot slot;
    slot.set = module.value(i[2], spv::DecorationDescriptorSet);
    slot.binding = module.value(i[2], spv::DecorationBinding);
    const bool texel_buffer = op == spv::OpTypeImage && type[3] == spv::DimBuffer && type[7] == 2 &&
                              type[8] == spv::ImageFormatRgba32ui;
    slot.variable = module.name(i[2]);
    slot.name = op == spv::OpTypeStruct ? module.name(target) : slot.variable;
    // Compilers of other languages make names such as "type.RWStructuredBuffer.float".
    if (slot.name.empty() || slot.name.find('.') != std::string::npos) slot.name = slot.variable;
    if (slot.name.empty()) slot.name = fmt::format("{}.{}", slot.set, slot.binding);
    slot.image.combined = op == spv::OpTypeSampledImage;
    const spirv::Instruction& image = slot.image.combined ? module.definition(type[2]) : type;
    const bool is_image = gpu::read_image_type(image, slot.image);
    if (op != spv::OpTypeStruct && !texel_buffer && !is_image)
      throw Error(
          ExitCode::bad_input,
          "the kernel binds {}, '{}', at set {}, binding {}: eyeray runs kernels with storage buffers, "
          "uniform buffers, texel buffers (uimageBuffer, rgba32ui), and images of one to three axes that are "
          "read "
          "by imageLoad or texelFetch",
          kind_of(op), slot.name, slot.set, slot.binding);
    const bool uniform = i[3] == spv::StorageClassUniform && !module.has(target, spv::DecorationBufferBlock);
    if (is_image && slot.image.spirv_format != 0 && !slot.image.format)
      throw Error(ExitCode::bad_input,
                  "the kernel declares the image '{}' in a format that eyeray does not have; it has {}",
                  slot.name, gpu::format_names());
    const auto declared = [&](spv::Decoration decoration) {
      return module.has(i[2], decoration) ||
             (op == spv::OpTypeStruct && module.all_members_have(target, decoration));
    };
    slot.kind = is_image       ? gpu::BindingKind::image
                : texel_buffer ? gpu::BindingKind::texels
                : uniform      ? gpu::BindingKind::uniform
                               : gpu::BindingKind::storage;
    slot.type = texel_buffer ? texels()
                : is_image   ? image_type(slot.image.format ? *slot.image.format
                                                            : default_format(module.definition(image[2])),
                                        slot.image.coordinates())
                           : module.type(target);
    slot.readable = !declared(spv::DecorationNonReadable);
    slot.writable = !uniform && !slot.image.sampled && !declared(spv::DecorationNonWritable);
    found.buffers.push_back(std::move(slot));
  }
  const auto place = [](const BufferSlot& slot) { return std::pair(slot.set, slot.binding); };
  std::ranges::stable_sort(found.buffers, {}, place);
  // Variables that share a binding see one buffer, by the first's name.
  const auto same = [&](const BufferSlot& a, const BufferSlot& b) { return place(a) == place(b); };
  found.buffers.erase(std::unique(found.buffers.begin(), found.buffers.end(), same), found.buffers.end());
  const std::vector<BufferSlot> all = found.buffers;
  for (BufferSlot& slot : found.buffers)
    if (std::ranges::count(all, slot.name, &BufferSlot::name) > 1 && !slot.variable.empty())
      slot.name = slot.variable;
  return found;
}

}  // namespace eyeray::engine::compute
