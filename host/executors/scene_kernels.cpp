#include "host/executors/scene_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "host/core/error.hpp"
#include "host/core/free_memory.hpp"
#include "host/executors/profile.hpp"
#include "host/pack/collapse.hpp"

namespace eyeray::engine::executors {

namespace {

// The name of a kernel: "render-first-hits" for "kernels/render.comp.glsl" and "#define FIRST_HITS\n".
std::string name_of(const std::string& entry, const std::string& defines) {
  const size_t start = entry.rfind('/') + 1;
  const std::string stem = entry.substr(start, entry.find('.', start) - start);
  std::string name = stem;
  std::istringstream lines(defines);
  for (std::string directive, define, rest; lines >> directive >> define && std::getline(lines, rest);) {
    std::ranges::transform(define, define.begin(),
                           [](char c) { return c == '_' ? '-' : char(std::tolower(c)); });
    if (define.ends_with("-" + stem)) continue;  // SENDS_PHOTONS of photons.comp.glsl
    name += define.starts_with(stem + "-") ? define.substr(stem.size()) : "-" + define;
  }
  return name;
}

}  // namespace

std::shared_ptr<gpu::Kernel> SceneKernels::make(const std::string& entry, std::string defines) {
  const std::string name = name_of(entry, defines);
  if (entry == trace_entries[size_t(Rays::cooperative)]) {
    upload_bvh4();
    defines += fmt::format("#define BVH4_STACK_SIZE {}\n", bvh4_stack_);
  }
  const std::vector<uint32_t> spirv = workshop_.times.measure("shader compile", [&] {
    try {
      const gpu::ShaderSource text = source(entry, true);
      if (moves_tunables()) defines += "#define TUNABLES 1\n";
      const auto compile = [&](const gpu::ShaderSource& source) {
        return gpu::compile_kernel(source, defines, workshop_.how, workshop_.device.cache()).spirv;
      };
      if (!files_.gave_users()) return of_own_input([&] { return compile(text); });
      if (!guard_.active()) return compile(text);
      try {
        return compile(text);
      } catch (const InputError&) {  // so that messages show the lines as their author wrote them
        return compile(source(entry));
      }
    } catch (const InputError& error) {
      std::vector<Diagnostic> diagnostics = error.diagnostics();
      for (Diagnostic& d : diagnostics) d.position.file = files_.shown(d.position.file);
      throw InputError(std::move(diagnostics));
    }
  });
  auto kernel = workshop_.times.measure("pipeline", [&] { return workshop_.device.kernel(spirv, entry); });
  if (workshop_.examines)
    workshop_.facts.kernels.push_back({name, spirv, kernel->build_seconds(), kernel->executables()});
  scene_.bind(*kernel);
  if (moves_tunables()) {
    upload_tunables();
    kernel->set_buffer(BINDING_TUNABLES, *tunables_);
  }
  workshop_.facts.geometry_bytes = scene_.geometry_bytes();
  workshop_.facts.source_files = {files_.looked_for().begin(), files_.looked_for().end()};
  return kernel;
}

gpu::ShaderSource SceneKernels::source(const std::string& entry, bool guarded) {
  const auto read = [&](std::string_view name) {
    auto text = files_.read(name);
    if (text && workshop_.tunables) text = workshop_.tunables->apply(std::string(name), *text);
    if (const auto original = files_.replaced(name); text && original && guarded)
      text = guard_.guard(files_.shown(std::string(name)), *text, *original);
    if (text && name == "scene.glsl" && !files_.folder().empty()) *text = guard_.definitions() + *text;
    return text;
  };
  return gpu::read_shader(read, entry);
}

bool SceneKernels::moves_tunables() const {
  return workshop_.tunables && !workshop_.tunables->as_constants && !workshop_.tunables->found().empty();
}

void SceneKernels::upload_tunables() {
  const auto records = workshop_.tunables->records();
  const auto bytes = std::as_bytes(std::span(records));
  if (!tunables_) tunables_.emplace(workshop_.device.device(), bytes.size(), "tunables");
  tunables_->upload(bytes);
  uploaded_ = choice();
}

void SceneKernels::upload_bvh4() {
  if (binary_nodes_.empty()) return;
  const pack::CollapsedBvh bvh4 =
      workshop_.times.measure("collapse", [&] { return pack::collapse(binary_nodes_, bvh_); });
  free_memory(binary_nodes_);
  bvh4_stack_ = bvh4.stack_size;
  scene_.add(bvh4_buffer(bvh4.nodes));
}

}  // namespace eyeray::engine::executors
