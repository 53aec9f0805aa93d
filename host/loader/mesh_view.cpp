#include "host/loader/mesh_view.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "host/core/error.hpp"
#include "host/loader/animation.hpp"
#include "host/loader/overrides.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::loader {

namespace {

// The key of an override, and words for its value in messages.
struct MeshChoice {
  std::string_view key, words;
};
constexpr MeshChoice look_choice{"look", "a look"}, camera_choice{"camera", "a camera by name"},
    turntable_choice{"turntable", "a turntable"}, point_shape_choice{"point_shape", "a point shape"},
    point_size_choice{"point_size", "a point size"}, line_width_choice{"line_width", "a line width"},
    up_choice{"up", "an axis that is up"}, scene_choice{"gltf_scene", "a scene by name"},
    variant_choice{"variant", "a variant"};

bool chooses(const Override& each, const MeshChoice& choice) {
  return each.text.starts_with(choice.key) &&
         std::string_view(each.text).substr(choice.key.size()).starts_with('=');
}

std::string value_of(const Override& choice) {
  std::string value = choice.text.substr(choice.text.find('=') + 1);
  if (value.size() > 1 && value.front() == '"' && value.back() == '"')
    value = value.substr(1, value.size() - 2);
  return value;
}

// Takes the last override with that key out of the list, and all before it.
std::optional<Override> take(std::vector<Override>& overrides, const MeshChoice& choice) {
  std::optional<Override> last;
  std::erase_if(overrides, [&](const Override& each) {
    if (!chooses(each, choice)) return false;
    last = each;
    return true;
  });
  return last;
}

std::optional<MeshLook> take_look(std::vector<Override>& overrides) {
  const auto change = take(overrides, look_choice);
  if (!change) return std::nullopt;
  const auto found = std::ranges::find(look_names, value_of(*change));
  if (found == std::end(look_names))
    throw Error(ExitCode::bad_input, "{}: a look is {}", as_written(*change), fmt::join(look_names, ", "));
  return MeshLook(found - std::begin(look_names));
}

int take_turntable(std::vector<Override>& overrides) {
  const auto change = take(overrides, turntable_choice);
  if (!change) return 0;
  const size_t count = as_index(value_of(*change)).value_or(0);
  if (count < 2 || count > size_t(most_frames))
    throw Error(ExitCode::bad_input, "{}: a turntable has 2 to {} frames", as_written(*change), most_frames);
  return int(count);
}

// A length above 0.
std::optional<double> take_length(std::vector<Override>& overrides, const MeshChoice& choice) {
  const auto change = take(overrides, choice);
  if (!change) return std::nullopt;
  const std::string text = value_of(*change);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value <= max_coordinate))
    throw Error(ExitCode::bad_input, "{}: {} is a number above 0", as_written(*change), choice.words);
  return value;
}

// One of the names; absent, the first. `noun`: of the message, "the axis that is up".
template <typename Value>
Value take_named(std::vector<Override>& overrides, const MeshChoice& choice, const auto& names,
                 const char* noun) {
  const auto change = take(overrides, choice);
  if (!change) return Value(0);
  const auto found = std::ranges::find(names, value_of(*change));
  if (found == std::end(names))
    throw Error(ExitCode::bad_input, "{}: {} is {}", as_written(*change), noun, fmt::join(names, ", "));
  return Value(found - std::begin(names));
}

std::optional<std::string> take_name(std::vector<Override>& overrides, const MeshChoice& choice) {
  const auto change = take(overrides, choice);
  return change ? std::optional(value_of(*change)) : std::nullopt;
}

}  // namespace

MeshChoices take_mesh_choices(std::vector<Override>& overrides) {
  return {.look = take_look(overrides),
          .turntable = take_turntable(overrides),
          .reading = {.point_shape = take_named<importers::PointShape>(
                          overrides, point_shape_choice, importers::point_shape_names, "a point shape"),
                      .point_size = take_length(overrides, point_size_choice),
                      .line_width = take_length(overrides, line_width_choice),
                      .up = take_named<importers::UpAxis>(overrides, up_choice, importers::up_names,
                                                          "the axis that is up"),
                      .gltf_scene = take_name(overrides, scene_choice),
                      .variant = take_name(overrides, variant_choice)},
          .camera = take(overrides, camera_choice)};
}

void refuse_mesh_choices(std::span<const Override> overrides, const std::filesystem::path& file) {
  for (const Override& each : overrides)
    for (const MeshChoice& choice :
         {look_choice, camera_choice, turntable_choice, point_shape_choice, point_size_choice,
          line_width_choice, up_choice, scene_choice, variant_choice})
      if (chooses(each, choice))
        throw Error(ExitCode::bad_input, "{}: {} is for a mesh alone, and {} is a scene", as_written(each),
                    choice.words, file.string());
}

void choose_camera(std::vector<importers::ImportedCamera>& cameras, const std::optional<Override>& choice,
                   const std::filesystem::path& file, DiagnosticLog& log) {
  std::vector<std::string> names;
  for (const importers::ImportedCamera& camera : cameras) names.push_back(camera.name);
  const std::string all = importers::list_names(names);
  if (choice) {
    const auto index = importers::find_named(names, value_of(*choice));
    if (!index)
      throw Error(ExitCode::bad_input, "{}: {} has no such camera; it has {}", as_written(*choice),
                  file.string(), names.empty() ? "none" : all);
    std::swap(cameras[0], cameras[*index]);
  } else if (cameras.size() > 1) {
    log.warning({}, fmt::format("shows the first of its cameras; --camera NAME shows another: {}", all));
  }
  if (cameras.empty()) return;
  cameras.resize(1);
  if (cameras[0].fault) throw InputError({*cameras[0].fault});
}

}  // namespace eyeray::engine::loader
