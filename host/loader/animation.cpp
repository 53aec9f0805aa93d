#include "host/loader/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "host/loader/keyframes.hpp"
#include "host/loader/overrides.hpp"
#include "host/loader/sections.hpp"
#include "host/loader/variables.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;
namespace {

constexpr std::string_view curves[] = {"step", "linear", "smooth"};

constexpr Key table_of_animation[] = {
    {.name = "frame",
     .type = KeyType::number,
     .doc = "The frame to show. Fractions and frames before 0 are allowed. `render --frames` sets it, and -D "
            "animation.frame=12.5 sets it for every command.",
     .fallback = "0",
     .min = -most_frames,
     .max = most_frames},
    {.name = "frames_per_second",
     .type = KeyType::number,
     .doc = "Frames per second, for animations of mesh files and for a video made of the frames.",
     .fallback = "24",
     .min = 0,
     .max = 1000,
     .above_min = true},
    {.name = "shutter",
     .type = KeyType::number,
     .doc = "Motion blur: time for which the shutter is open, in frames, half before `frame` and half after "
            "it. A film camera has 0.5. Only `render` makes blurred pictures. `verify`, `probe`, `dev` and "
            "first-hit AOVs use the moment `frame`.",
     .fallback = "0",
     .min = 0,
     .max = 1000},
    {.name = "shutter_steps",
     .type = KeyType::integer,
     .doc = "Number of moments within the shutter time that a picture shows, if it has at least as many "
            "samples per pixel.",
     .fallback = "16",
     .min = 1,
     .max = 4096},
};

constexpr Key table_of_track[] = {
    {.name = "target",
     .type = KeyType::string,
     .doc = "The value to animate, named as for -D: `camera.eye`, `sphere.0.radius`, `light.key.intensity`, "
            "`mesh.wheel.transform`."},
    {.name = "keyframes",
     .type = KeyType::keyframes,
     .doc = "Pairs of a frame and a value. The values are those that the target accepts, all in the same "
            "form. The first value holds before the first keyframe, and the last value after the last."},
    {.name = "curve",
     .type = KeyType::choice,
     .doc = "Interpolation between keyframes. `\"step\"`: the value jumps at the next keyframe. "
            "`\"linear\"`: straight interpolation. `\"smooth\"`: a curve without kinks (Catmull-Rom).",
     .fallback = "\"linear\"",
     .choices = curves},
};

// The values that tracks have moved so far. A later track may move a part of an earlier track's value. It may
// not move that whole value or more, because the earlier track's keyframes would then have no effect.
class MovedValues {
 public:
  // Records that `track`, whose target is at `at`, moves the value at `path` (apply_track). If several
  // tracks undo the same earlier track, only the first of them is an error.
  void add(const std::vector<std::string>& path, const SourcePosition& at, reading::TableReader& track) {
    const auto earlier = tracks_.lower_bound(path);
    const bool undone = earlier != tracks_.end() && earlier->first.size() >= path.size() &&
                        std::equal(path.begin(), path.end(), earlier->first.begin());
    if (!undone) {
      tracks_.emplace(path, Track{at});
    } else if (!std::exchange(earlier->second.undone, true)) {
      const SourcePosition& first = earlier->second.at;
      track.error(
          "target",
          fmt::format("the [[track]] at {}:{} moves this already: put all its keyframes into one track",
                      printable(first.file), first.line));
    }
  }

 private:
  struct Track {
    SourcePosition at;
    bool undone = false;
  };
  std::map<std::vector<std::string>, Track> tracks_;
};

double frame_of(const toml::node& keyframe) {
  return keyframe.as_array()->get(0)->value_or(0.0);
}

}  // namespace

constexpr std::string_view manual =
    R"(A track animates one value of the scene. Every value that -D can set may be its target.

```toml
[[track]]
target = "camera.eye"
curve = "smooth"
keyframes = [[0, [0, 1, 6]], [24, [3, 1.5, 5]], [48, [6, 1, 0]]]

[[group]]
name = "wheel"

[[group.cylinder]]
from = [0, 0, -0.2]
to = [0, 0, 0.2]
radius = 1
material = "wall"

[[track]]
target = "group.wheel.transform"
keyframes = [
  [0, [{ rotate = { axis = [0, 0, 1], degrees = 0 } }, { translate = [0, 1, 0] }]],
  [48, [{ rotate = { axis = [0, 0, 1], degrees = -720 } }, { translate = [9, 1, 0] }]],
]
```

`eyeray render SCENE --frames 0:48` renders all frames. Rotations about one axis are interpolated in degrees,
through any number of full turns. Between two rotations about different axes, every intermediate value is a
rotation on the shortest path.

**Source.** Catmull, Rom: A Class of Local Interpolating Splines, 1974. Shoemake: Animating Rotation with Quaternion Curves, SIGGRAPH 1985.
)";
const std::string_view track_manual = manual;

std::span<const Key> animation_keys() {
  return table_of_animation;
}
std::span<const Key> track_keys() {
  return table_of_track;
}

Animation apply_animation(toml::table& root, DiagnosticLog& log) {
  const Section &settings = *find_section("animation"), &track = *find_section("track");
  const toml::node* const written = root.get(settings.name);
  DiagnosticLog unheard;  // for faults that the builder of the scene reports
  const reading::Variables variables = read_let(root, unheard);
  const reading::TableReader reader = reading::read_table({.title = settings.title,
                                                           .table = written ? written->as_table() : nullptr,
                                                           .keys = {settings.keys},
                                                           .sources = {.variables = &variables}},
                                                          log);
  Animation animation{.frame = reader.number("frame"),
                      .frames_per_second = reader.number("frames_per_second"),
                      .shutter = reader.number("shutter"),
                      .shutter_steps = int(reader.integer("shutter_steps"))};
  root.erase(settings.name);

  // Take the tracks out of the tree first: setting their values changes the tree.
  toml::array tracks;
  if (toml::node* const list = root.get(track.name)) tracks = std::move(*list->as_array());
  root.erase(track.name);
  MovedValues moved;
  for (const toml::node& node : tracks) {
    const toml::table& table = *node.as_table();
    reading::TableReader one =
        reading::read_table({.title = track.title, .table = &table, .keys = {track.keys}}, log);
    if (one.failed()) continue;
    const std::string target = one.string("target"), section = target.substr(0, target.find('.'));
    if (section == settings.name || section == track.name) {
      one.error("target", "an animation cannot move itself");
      continue;
    }
    const toml::array& keyframes = *table.get("keyframes")->as_array();
    const auto value = value_between(keyframes, animation.frame, Curve(one.choice("curve")), log);
    if (!value) continue;
    add_moving(1, frame_of(keyframes.front()), frame_of(keyframes.back()), animation);
    const auto path =
        apply_track(root, target, *value, one.position("target"), one.position("keyframes"), log);
    if (!path.empty()) moved.add(path, one.position("target"), one);
  }
  return animation;
}

double seconds(const Animation& animation) {
  return animation.frame / animation.frames_per_second;
}

void add_moving(int values, double first, double last, Animation& animation) {
  animation.first = animation.tracks == 0 ? first : std::min(animation.first, first);
  animation.last = animation.tracks == 0 ? last : std::max(animation.last, last);
  animation.tracks += values;
}

}  // namespace eyeray::engine::loader
