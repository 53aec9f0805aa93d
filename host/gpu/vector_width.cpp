#include "host/gpu/vector_width.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "host/core/disk_cache.hpp"
#include "host/core/private_folder.hpp"

namespace eyeray::engine::gpu {
namespace {

constexpr const char* width_variable = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* cache_variable = "MESA_SHADER_CACHE_DIR";

// The folder of compiled kernels that the user chose, or null. Mesa still reads the former name.
const char* chosen_cache() {
  const char* const chosen = std::getenv(cache_variable);
  return chosen ? chosen : std::getenv("MESA_GLSL_CACHE_DIR");
}

bool has_wide_vectors() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

// The folders in which Mesa may cache compiled kernels. Mesa's version decides which one it uses.
std::vector<std::filesystem::path> driver_caches() {
  if (const char* const chosen = chosen_cache()) return {chosen};
  if (std::getenv(width_variable)) return {};  // the cache is below eyeray's own
  const char* const caches = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  if (!caches && !home) return {};
  const std::filesystem::path folder = caches ? caches : std::filesystem::path(home) / ".cache";
  return {folder / "mesa_shader_cache", folder / "mesa_shader_cache_db"};
}

void disable_driver_cache() {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
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
  if (!driver_cache_warning().empty()) return disable_driver_cache();
  const char* const width = std::getenv(width_variable);
  if (!width) return;
  const char* const chosen = chosen_cache();
  const std::filesystem::path folder = chosen ? chosen : DiskCache::of_user().folder();
  const std::string own = "vectors-" + std::string(width);
  // A parent process may have set the folder already.
  if (folder.filename() == own) return;
  if (!folder.empty() && make_private_folder(folder) && make_private_folder(folder / own))
    setenv(cache_variable, (folder / own).c_str(), 1);
  else
    disable_driver_cache();
}

std::string driver_cache_warning() {
  for (const std::filesystem::path& folder : driver_caches())
    if (const std::string why = why_not_private(folder); !why.empty())
      return fmt::format("Mesa's shader cache {} is not used, so each start compiles again: {}",
                         folder.string(), why);
  return "";
}

}  // namespace eyeray::engine::gpu
