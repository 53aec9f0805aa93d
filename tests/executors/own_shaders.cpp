// Tests whether a shader that does not compile is reported as eyeray's fault or as the user's.
#include "host/executors/scene_kernels.hpp"
#include "tests/support/shader_overlay.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// The error of compiling a kernel of these shaders.
Error error_of(ShaderFiles files) {
  const auto device = open_device({});
  StageTimes times;
  ExecutorFacts facts;
  UploadedScene scene(device->device(), false);
  SceneKernels kernels({*device, times, facts, {}, nullptr, 1, false, false}, scene, std::move(files));
  try {
    const auto kernel = kernels.make("kernels/render.comp.glsl");
  } catch (const Error& error) {
    return error;
  }
  return {ExitCode::ok, "it compiles"};
}

}  // namespace

TEST_CASE("a built-in shader that does not compile is an internal error, a user's is bad input") {
  const std::string nonsense = "nonsense;\n";
  const Error own = error_of(ShaderFiles({}, nonsense));
  const std::string message = own.what();
  CHECK(own.code() == ExitCode::internal);
  CHECK(message.starts_with("internal error: scene.glsl:1:"));
  CHECK(message.find("please report it") != std::string::npos);

  const test::TemporaryFolder folder;
  test::lay_shader(folder.path(), "kernels/pixel.glsl", nonsense);
  const Error users = error_of(ShaderFiles(folder.path(), ""));
  const std::string of_users = users.what();
  CHECK(users.code() == ExitCode::bad_input);
  CHECK(of_users.starts_with(folder / "kernels/pixel.glsl:1:"));
  CHECK(of_users.find("please report it") == std::string::npos);
}
