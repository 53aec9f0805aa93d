// render_file SCENE PICTURE: a scene's file becomes a picture; Ctrl-C keeps the picture so far.
#include <eyeray/eyeray.hpp>

#include <csignal>
#include <cstdio>

namespace {

eyeray::Cancellation cancellation;

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) return std::fputs("usage: render_file SCENE PICTURE\n", stderr), 2;
  const eyeray::Scene scene = eyeray::Scene::read(argv[1]);
  for (const eyeray::Diagnostic& warning : scene.warnings())
    std::fprintf(stderr, "%s:%d: %s\n", warning.file.c_str(), warning.line, warning.message.c_str());

  eyeray::RenderOptions options;
  options.aovs = {"depth"};
  options.cancellation = cancellation;
  options.progress = [](const eyeray::Progress& now) {
    std::fprintf(stderr, "\r%3.0f %%", 100 * now.share);
    return true;  // false would cancel
  };
  std::signal(SIGINT, [](int) { cancellation.request(); });

  eyeray::Renderer renderer;
  const eyeray::Picture picture = renderer.render(scene, options);
  std::fprintf(stderr, "\r%d samples a pixel in %.2f s\n", picture.samples_done(), picture.seconds());
  if (picture.samples_done() == 0) return 130;
  picture.write(argv[2]);

  // The nearest point that is seen.
  if (picture.complete()) {
    const eyeray::Plane depth = picture.aov("depth");
    float nearest = depth.values[0];
    for (const float each : depth.values) nearest = each < nearest ? each : nearest;
    std::printf("nearest %.3f\n", double(nearest));
  }
  return 0;
} catch (const eyeray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return error.kind() == eyeray::ErrorKind::bad_input ? 2 : 1;
}
