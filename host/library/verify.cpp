// Renderer::verify.
#include "host/verify/verify.hpp"

#include <algorithm>

#include "host/library/renderer.hpp"
#include "host/library/scene.hpp"
#include "host/session/request.hpp"

namespace eyeray::v0 {

Report Renderer::verify(const Scene& scene, const VerifyOptions& options) {
  Report report;
  library::call_renderer(*data_, options.cancellation, [&] {
    const eyeray::Scene& what = scene.data().scene;
    verify::Options how;
    how.backends.clear();
    for (const Backend backend : options.backends) how.backends.push_back(library::backend_of(backend));
    if (how.backends.empty() || std::ranges::count(how.backends, executors::Backend::reference) > 0)
      throw eyeray::Error(ExitCode::bad_input,
                          "backends names what is compared with the reference: gpu, twin, or both");
    how.crop = session::crop_within(library::rect_of(options.crop), what.image);
    how.executor =
        library::executor_options(*data_, std::ranges::count(how.backends, executors::Backend::gpu) > 0);
    how.progress = [&] { return library::progress_of(options.progress, options.cancellation); };
    const compare::Report found = verify::verify_scene({what, what.file.string(), "", options.evidence}, how);
    report = {found.passes(), found.failures(), to_text(found), to_json(std::span(&found, 1))};
  });
  return report;
}

}  // namespace eyeray::v0
