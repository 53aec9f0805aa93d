// verify SCENE: is what this machine renders right? Exit code 0 when every gate passes.
#include <eyeray/eyeray.hpp>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) return std::fputs("usage: verify SCENE\n", stderr), 2;
  eyeray::Renderer renderer;
  const eyeray::Report report = renderer.verify(eyeray::Scene::read(argv[1]));
  std::fputs(report.text.c_str(), stdout);
  return report.passed ? 0 : 1;
} catch (const eyeray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
