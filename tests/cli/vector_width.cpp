// The width of llvmpipe's vectors: eyeray chooses it by the picture, or LP_NATIVE_VECTOR_WIDTH sets it.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The kernel's own report of the processor's abilities.
bool has_wide_vectors() {
  const std::string processor = read_text("/proc/cpuinfo");
  return std::ranges::all_of(std::array{" avx512f", " avx512bw", " avx512dq", " avx512vl"},
                             [&](const char* flag) { return processor.find(flag) != std::string::npos; });
}

// Pictures made on lavapipe, with caches in this folder.
class Pictures : public SceneFolder {
 public:
  // Renders a corner of a picture of this size, and returns the devices that made it:
  // "gpu: llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6 (LLVM 15.0.6); …"
  std::string device(const std::string& size, Environment environment = {}) const {
    environment.emplace_back("EYERAY_CACHE_DIR", *this / "eyeray");
    const ProcessResult result = run_eyeray({"render", scene(), "--device", "llvmpipe", "-s", size, "--crop",
                                             "0,0,64,48", "-o", picture(), "-q", "--json"},
                                            environment);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(result.err == "");
    return nlohmann::json::parse(result.out).at("device");
  }
  // The width of its vectors in bits.
  int bits(const std::string& size, Environment environment = {}) const {
    const std::string device = this->device(size, std::move(environment));
    return std::stoi(device.substr(device.rfind(' ', device.find(" bits)") - 1)));
  }
  std::string picture() const { return *this / "picture.pfm"; }
};

size_t count_files(const std::filesystem::path& folder) {
  size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    count += entry.is_regular_file();
  return count;
}

}  // namespace

TEST_CASE("big pictures use 512-bit vectors on Mesa 22 if the processor can, unless the user chooses") {
  const Pictures pictures;
  const int usual = pictures.bits("64x48");
  CHECK(usual <= 256);
  const bool gains = pictures.device("64x48").find(" Mesa 22.") != std::string::npos;
  CHECK(pictures.bits("1024x1024") == (gains && has_wide_vectors() ? 512 : usual));
  CHECK(pictures.bits("1024x1024", {{"LP_NATIVE_VECTOR_WIDTH", "256"}}) == 256);
}

TEST_CASE("compiled code is cached separately for each vector width") {
  const Pictures pictures;
  const std::filesystem::path mesa = pictures / "mesa";
  std::string first;
  for (const int width : {256, 512, 256, 512}) {
    CAPTURE(width);
    CHECK(pictures.bits("64x48", {{"LP_NATIVE_VECTOR_WIDTH", std::to_string(width)},
                                  {"MESA_SHADER_CACHE_DIR", mesa}}) == width);
    if (first.empty()) first = read_text(pictures.picture());
    CHECK(read_text(pictures.picture()) == first);
  }
  CHECK(count_files(mesa / "vectors-256") > 0);
  CHECK(count_files(mesa / "vectors-512") == count_files(mesa / "vectors-256"));
  CHECK(std::distance(std::filesystem::directory_iterator(mesa), {}) == 2);
}

TEST_CASE("vectors of a chosen width need no cache") {
  const Pictures pictures;
  write_text(pictures / "file", "");
  for (const std::string& folder : {pictures / "file/mesa", std::string()})
    CHECK(pictures.bits("64x48", {{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DIR", folder}}) ==
          512);
}
