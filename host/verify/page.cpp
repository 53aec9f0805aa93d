#include "host/verify/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "host/compare/cause_picture.hpp"
#include "host/core/base64.hpp"
#include "host/core/embedded_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/image/image_file.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::verify {

std::span<const EmbeddedFile> page_files();  // page.html

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t most_pixels = 500;  // limit on the pixels of which the page has all values

std::string data_url(const image::Image& image) {
  return "data:image/png;base64," + base64(image::encode_png(image));
}

// Codes 0 … 255 for log10 of the difference from −8 to 0, as the page reads them.
image::Image difference_codes(const image::Image& a, const image::Image& b) {
  image::Image codes = compare::log_difference(a, b);
  for (float& sample : codes.samples())
    sample = float(image::linear_from_srgb(std::clamp(double(sample) / 8 + 1, 0.0, 1.0)));
  return codes;
}

// The executor that the page compares with the reference: the first that fails, or the first of all.
size_t compared(const compare::Report& report) {
  const auto failing = std::ranges::find_if(
      report.against_reference,
      [](const compare::ReferenceResult& result) { return !result.comparison.passes(); });
  return failing == report.against_reference.end() ? 0 : size_t(failing - report.against_reference.begin());
}

// True if gate A found the i-th executor's pixels to be the first one's, bit by bit.
bool same_as_first(const compare::Report& report, size_t i) {
  return std::ranges::any_of(report.exact, [&](const compare::ExactResult& exact) {
    return exact.other == report.participants[i].name && exact.comparison.passes(0);
  });
}

std::string outcome_name(const compare::PixelOutcome& pixel) {
  using compare::Outcome;
  return pixel.outcome == Outcome::unexplained  ? "unexplained"
         : pixel.outcome == Outcome::unexamined ? "not examined"
                                                : std::string("explained: ") + name(pixel.cause);
}

Json values(const compare::Frame& frame, int x, int y) {
  const Vec3 color = compare::color_at(frame.color, x, y);
  const compare::Counts counts = compare::counts_at(frame, x, y);
  const FirstHit& hit = frame.first_hit(x, y);
  const auto number = [](double value) { return fmt::format("{:.9g}", value); };
  return {{"color", {number(color.x), number(color.y), number(color.z)}},
          {"hits", number(counts.x)},
          {"rays", number(counts.y)},
          {"first_hit", hit.primitive < 0 ? "nothing is hit"
                                          : fmt::format("primitive {}, material {}, t {:.9g}", hit.primitive,
                                                        hit.material, hit.t)}};
}

// The most telling pixels that do not match: unexplained before explained.
Json pixels(const compare::Report& report, std::span<const compare::Frame> frames,
            const std::vector<compare::PixelOutcome>& outcomes) {
  std::vector<size_t> chosen;
  for (size_t i = 0; i < outcomes.size(); ++i)
    if (outcomes[i].outcome >= compare::Outcome::explained) chosen.push_back(i);
  std::ranges::stable_sort(chosen, std::greater(), [&](size_t i) { return outcomes[i].outcome; });
  chosen.resize(std::min(chosen.size(), most_pixels));

  Json all = Json::array();
  for (const size_t i : chosen) {
    const int x = int(i) % report.area.width, y = int(i) / report.area.width;
    Json pixel{{"at", {report.area.x + x, report.area.y + y}}, {"outcome", outcome_name(outcomes[i])}};
    for (size_t k = 0; k < frames.size(); ++k)
      if (k == 0 || !same_as_first(report, k)) pixel[report.participants[k].name] = values(frames[k], x, y);
    all.push_back(std::move(pixel));
  }
  return all;
}

Json scene_of(const compare::Report& report) {
  Json scene = Json::parse(to_json(std::span(&report, 1)))["scenes"][0];
  scene["text"] = to_text(report);
  return scene;
}

}  // namespace

void Page::add(const compare::Report& report, std::span<const compare::Frame> frames,
               std::span<const std::vector<compare::PixelOutcome>> outcomes) {
  Json scene = scene_of(report);
  const size_t executor = compared(report);
  if (outcomes[executor].empty()) return scenes_.push_back(json_text(scene));

  Json& pictures = scene["pictures"] = Json::object();
  for (size_t i = 0; i < frames.size(); ++i)
    if (i == 0 || !same_as_first(report, i))
      pictures[report.participants[i].name] = data_url(frames[i].color);
  if (report.golden && report.golden->incomparable.empty())
    pictures["golden"] = data_url(report.golden->picture);
  const image::Image& reference = frames.back().color;
  pictures["difference"] = data_url(difference_codes(frames[executor].color, reference));
  pictures["causes"] = data_url(compare::cause_picture(reference, outcomes[executor]));
  scene["causes"] = Json::parse(compare::cause_legend(outcomes[executor]));
  scene["pixels"] = pixels(report, frames, outcomes[executor]);
  scenes_.push_back(json_text(scene));
}

void Page::add(const compare::Report& report) {
  scenes_.push_back(json_text(scene_of(report)));
}

std::string Page::html(const std::string& summary) const {
  std::string data = fmt::format("{{\"summary\":{},\"scenes\":[", json_text(Json(summary)));
  for (size_t i = 0; i < scenes_.size(); ++i) data += (i == 0 ? "" : ",") + scenes_[i];
  data += "]}";
  // Escape each <, which JSON has only in strings: the data must not contain a script's end, nor
  // "<!--<script>", which hides that end.
  for (size_t at = 0; (at = data.find('<', at)) != std::string::npos;) data.replace(at, 1, "\\u003c");

  std::string page(page_files()[0].text);
  constexpr std::string_view marker = "@DATA@";
  return page.replace(page.find(marker), marker.size(), data);
}

}  // namespace eyeray::engine::verify
