// The pictures without noise that the worker of dev shows.
#include <algorithm>
#include <cmath>

#include "served.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr const char* text = R"(
[image]
width = 96
height = 64
samples = 4
[camera]
eye = [0, 1, 5]
target = [0, 0, 0]
[render]
integrator = "path"
background = [0.1, 0.1, 0.1]
[[material]]
name = "light"
type = "diffuse"
emission = 20
[[material]]
name = "grey"
type = "diffuse"
color = 0.5
[[sphere]]
center = [2, 3, 1]
radius = 0.5
material = "light"
[[plane]]
point = [0, -1, 0]
normal = [0, 1, 0]
material = "grey"
)";
const std::string denoised = "render.denoise=true", noisy = "render.denoise=false";

std::string changed(const std::string& from, const std::string& to) {
  std::string scene = text;
  return scene.replace(scene.find(from), from.size(), to);
}

// The sum of the squared differences between neighbours.
double roughness(const image::Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 1; x < image.width(); ++x)
      sum += std::pow(double(image.pixel(x, y)[0]) - double(image.pixel(x - 1, y)[0]), 2);
  return sum;
}

// The messages of a revision, with "done" as the last.
std::vector<Json> messages(Served& served, int revision) {
  std::vector<Json> all;
  do all.push_back(served.next(revision));
  while (all.back().at("event") != "done");
  return all;
}

bool denoises(const Json& message) {
  return message.at("event") == "stage" && message.at("stage") == "denoise";
}

}  // namespace

TEST_CASE("the picture without noise replaces the noisy one after the last sample") {
  Served served(text);
  served.ask(1, noisy, false);
  const std::vector<Json> plain = messages(served, 1);
  CHECK(std::ranges::none_of(plain, denoises));
  CHECK(plain.back().at("noise_left").is_null());
  const image::Image before = served.board.picture("gpu")->image;

  served.ask(2, denoised, true);
  const std::vector<Json> all = messages(served, 2);
  const auto stage = std::ranges::find_if(all, denoises);
  REQUIRE(stage != all.end());
  CHECK(stage->at("share") == 0);
  const auto rows =
      std::ranges::find(stage, all.end(), "rows", [](const Json& each) { return each.at("event"); });
  REQUIRE(rows != all.end());
  CHECK(rows->at("rows") == 64);
  CHECK(rows->at("sample") == 3);
  CHECK(all.back().at("noise_left") > 0.0);
  CHECK(all.back().at("noise_left") < 0.5);
  CHECK(all.back().at("stages").contains("denoise"));
  CHECK(roughness(served.board.picture("gpu")->image) < 0.75 * roughness(before));

  // The twin makes the same bits.
  served.ask(3, denoised, false, {"twin"});
  messages(served, 3);
  CHECK(served.board.picture("twin")->image.samples() == served.picture());
}

TEST_CASE("the views of a difference, AOVs and pictures that cannot be denoised stay as they are") {
  Served served(text);
  served.ask(1, denoised, false, {"gpu", "reference"});
  CHECK(std::ranges::none_of(messages(served, 1), denoises));
  served.ask(2, denoised, false, {"albedo"});
  CHECK(std::ranges::none_of(messages(served, 2), denoises));

  const auto scene_of = [&](int revision, const std::string& define) {
    served.ask(revision, define, false);
    const std::vector<Json> all = messages(served, revision);
    CHECK(std::ranges::none_of(all, denoises));
    return std::pair(*std::ranges::find(all, "scene", [](const Json& each) { return each.at("event"); }),
                     all.back().at("doubts"));
  };
  CHECK(scene_of(3, noisy).first.at("denoise") == false);
  const auto one_sample = scene_of(4, "image.samples=1");
  CHECK(one_sample.first.at("denoise").is_null());
  CHECK(one_sample.second.empty());

  Served raycast(changed("\"path\"", "\"raycast\""));
  raycast.ask(1, denoised, false);
  const std::vector<Json> all = messages(raycast, 1);
  CHECK(all.back().at("doubts").back().get<std::string>().starts_with(
      "only pictures by random paths are denoised: "));
}

TEST_CASE("an edit ends denoising") {
  Served served(changed("width = 96\nheight = 64\nsamples = 4", "width = 900\nheight = 600\nsamples = 2"));
  served.ask(1, denoised, false);
  while (!denoises(served.next())) continue;
  served.ask(2, noisy, false);
  Json message = served.next();
  for (; message.at("generation") == 1; message = served.next()) CHECK(denoises(message));
  CHECK(message.at("generation") == 2);
}
