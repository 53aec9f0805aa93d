#include "host/gpu/vector_width.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include "host/core/disk_cache.hpp"
#include "host/core/private_folder.hpp"

namespace eyeray::gpu {
namespace {

constexpr const char* width_variable = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* cache_variable = "MESA_SHADER_CACHE_DIR";

bool has_wide_vectors() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

}  // namespace

bool may_widen_vectors() {
  return has_wide_vectors() && !std::getenv(width_variable);
}

bool gains_from_wide_vectors(std::string_view driver_version) {
  return driver_version.starts_with("Mesa 22.");
}

void set_vector_width(bool wide) {
  if (wide && may_widen_vectors()) setenv(width_variable, "512", 1);
  const char* const width = std::getenv(width_variable);
  if (!width) return;
  const char* const chosen = std::getenv(cache_variable);
  const std::filesystem::path folder = chosen ? chosen : DiskCache::of_user().folder();
  const std::string own = "vectors-" + std::string(width);
  // A parent process may have done the same.
  if (folder.filename() == own) return;
  if (!folder.empty() && make_private_folder(folder) && make_private_folder(folder / own))
    setenv(cache_variable, (folder / own).c_str(), 1);
  else
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

}  // namespace eyeray::gpu
