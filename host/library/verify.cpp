// Renderer::verify.
#include "host/verify/verify.hpp"

#include <algorithm>

#include "host/core/option_text.hpp"
#include "host/library/renderer.hpp"
#include "host/library/scene.hpp"
#include "host/session/request.hpp"

namespace eyeray::inline v0 {

Report Renderer::verify(const Scene& scene, const VerifyOptions& options) {
  Report report;
  engine::library::call_renderer(*data_, options.cancellation, [&] {
    const engine::OptionBackends names;
    const engine::Scene& what = scene.data().scene;
    engine::verify::Options how;
    how.backends.clear();
    for (const Backend backend : options.backends)
      how.backends.push_back(engine::library::backend_of(backend));
    if (how.backends.empty() || std::ranges::count(how.backends, engine::executors::Backend::reference) > 0)
      throw engine::Error(engine::ExitCode::bad_input,
                          "backends must be gpu, twin, or both: the executors to compare with the reference");
    how.crop = engine::session::crop_within(engine::library::rect_of(options.crop), what.image);
    how.executor = engine::library::executor_options(
        *data_, std::ranges::count(how.backends, engine::executors::Backend::gpu) > 0);
    how.progress = [&] { return engine::library::progress_of(options.progress, options.cancellation); };
    const engine::compare::Report found =
        engine::verify::verify_scene({what, what.file.string(), "", options.evidence}, how);
    report = {found.passes(), found.failures(), to_text(found), to_json(std::span(&found, 1))};
  });
  return report;
}

}  // namespace eyeray::inline v0
