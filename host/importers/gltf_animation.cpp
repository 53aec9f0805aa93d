#include "host/importers/gltf_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace eyeray::engine::importers {

namespace {

// The keys that a channel may animate, and the types of their outputs.
struct AnimatedKey {
  std::string_view name;
  std::string_view type;
  size_t width;  // numbers of one value; 0: one a morph target
};
constexpr AnimatedKey animated_keys[] = {
    {"translation", "VEC3", 3}, {"rotation", "VEC4", 4}, {"scale", "VEC3", 3}, {"weights", "SCALAR", 0}};

enum class Interpolation { step, linear, cubic };
constexpr std::string_view interpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};

// The keys of a sampler that a channel reads.
struct KeyCurve {
  Interpolation interpolation;
  bool rotates;
  std::vector<double> times;   // rising
  std::vector<double> values;  // for each time one, or an in-tangent, a value and an out-tangent
  size_t width = 0;            // numbers of one value or tangent

  enum Part : size_t { in_tangent, value, out_tangent };
  const double* at(size_t key, Part part = value) const {
    return &values[(interpolation == Interpolation::cubic ? key * 3 + part : key) * width];
  }
};

glm::dquat quaternion(const double* xyzw) {
  return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

// The value at a time: before the first key it is the first value, after the last key the last one.
std::vector<double> value_at(const KeyCurve& curve, double time) {
  const auto later = std::ranges::upper_bound(curve.times, time);
  const size_t next = size_t(later - curve.times.begin()), last = next == 0 ? 0 : next - 1;
  std::vector<double> value(curve.at(last), curve.at(last) + curve.width);
  if (next == 0 || next == curve.times.size() || curve.interpolation == Interpolation::step) return value;

  const double length = curve.times[next] - curve.times[last], t = (time - curve.times[last]) / length;
  const double *from = curve.at(last), *to = curve.at(next);
  if (curve.interpolation == Interpolation::cubic) {
    const double *leaving = curve.at(last, KeyCurve::out_tangent),
                 *arriving = curve.at(next, KeyCurve::in_tangent);
    for (size_t i = 0; i < curve.width; ++i) {
      value[i] = (2 * t * t * t - 3 * t * t + 1) * from[i] +
                 length * (t * t * t - 2 * t * t + t) * leaving[i] + (3 * t * t - 2 * t * t * t) * to[i] +
                 length * (t * t * t - t * t) * arriving[i];
    }
  } else if (curve.rotates) {
    const glm::dquat q = glm::slerp(glm::normalize(quaternion(from)), glm::normalize(quaternion(to)), t);
    value = {q.x, q.y, q.z, q.w};
  } else {
    for (size_t i = 0; i < curve.width; ++i) value[i] = from[i] + (to[i] - from[i]) * t;
  }
  return value;
}

// Reads the channels of one animation.
class AnimationReader {
 public:
  AnimationReader(const GltfObject& document, const GltfObject& animation, GltfBuffers& buffers,
                  GltfLeftOut& left_out, GltfBreaches& breaches)
      : document_(document),
        animation_(animation),
        buffers_(buffers),
        left_out_(left_out),
        breaches_(breaches) {}

  GltfMotion read(const Playing& playing) {
    for (size_t i = 0; i < animation_.size("channels"); ++i) read_channel(animation_.element("channels", i));
    GltfMotion motion;
    for (const auto& [target, curve] : curves_) {
      PlayedAnimation& played = motion.played;
      const double first = curve.times.front(), last = curve.times.back();
      played.first = played.values == 0 ? first : std::min(played.first, first);
      played.last = played.values == 0 ? last : std::max(played.last, last);
      ++played.values;
    }
    double time = playing.seconds;
    if (const double end = motion.played.last; playing.loop && end > 0) time -= end * std::floor(time / end);
    for (const auto& [target, curve] : curves_) {
      std::vector<double> value = value_at(curve, time);
      if (curve.rotates) {
        const glm::dquat q = quaternion(value.data());
        if (!(glm::length(q) > 1e-6))
          animation_.fail(fmt::format("gives nodes[{}] a rotation of length 0", target.first));
        for (double& component : value) component /= glm::length(q);
      }
      motion.values.emplace(target, std::move(value));
    }
    return motion;
  }

 private:
  void read_channel(const GltfObject& channel) {
    const auto target = channel.object("target");
    if (!target) channel.fail("has no target");
    const auto node = target->index("node", document_.size("nodes"));
    const std::string path = target->text("path");
    if (!node || path == "pointer") return left_out_.add("animated values that belong to no node");
    const auto key = std::ranges::find(animated_keys, path, &AnimatedKey::name);
    if (key == std::end(animated_keys)) target->fail("has a path that glTF does not define");
    if (path != "weights" && document_.element("nodes", *node).has("matrix"))
      target->fail(fmt::format("moves the {} of nodes[{}], which has a matrix", path, *node));
    if (path == "weights" && !has_targets(*node))
      return breaches_.add("animated weights of nodes without morph targets, left out", target->location());
    const auto sampler = channel.index("sampler", animation_.size("samplers"));
    if (!sampler) channel.fail("has no sampler");
    if (curves_.contains({*node, path}))
      target->fail(fmt::format("moves the {} of nodes[{}], as another channel does", path, *node));
    curves_.emplace(std::pair(*node, path), read_sampler(animation_.element("samplers", *sampler), *key));
  }

  bool has_targets(size_t node) {
    const auto index = document_.element("nodes", node).index("mesh", document_.size("meshes"));
    if (!index) return false;
    const GltfObject mesh = document_.element("meshes", *index);
    for (size_t i = 0; i < mesh.size("primitives"); ++i)
      if (mesh.element("primitives", i).size("targets") > 0) return true;
    return false;
  }

  KeyCurve read_sampler(const GltfObject& sampler, const AnimatedKey& key) {
    const std::string written = sampler.has("interpolation") ? sampler.text("interpolation") : "LINEAR";
    const auto form = std::ranges::find(interpolations, written);
    if (form == std::end(interpolations)) sampler.fail("has an interpolation that glTF does not define");
    const auto input = sampler.index("input", document_.size("accessors"));
    const auto output = sampler.index("output", document_.size("accessors"));
    if (!input || !output) sampler.fail("needs an input and an output");
    KeyCurve curve{Interpolation(form - interpolations), key.name == "rotation", times(*input), {}, 0};

    breaches_.check_attribute(key.name, *output);
    curve.values = buffers_.numbers(*output, key.type);
    const GltfObject accessor = document_.element("accessors", *output);
    if (!std::ranges::all_of(curve.values, [](double x) { return std::isfinite(x); }))
      accessor.fail(fmt::format("contains a {} that is not finite", key.name));
    if (curve.interpolation == Interpolation::cubic && curve.times.size() < 2)
      breaches_.add("animations along splines with one key, which do not move", sampler.location());
    const size_t parts = curve.times.size() * (curve.interpolation == Interpolation::cubic ? 3 : 1);
    curve.width = key.width > 0 ? key.width : curve.values.size() / parts;
    if (curve.width == 0 || curve.values.size() != parts * curve.width)
      sampler.fail(
          fmt::format("has {} outputs for {} times", accessor.count("count", 0), curve.times.size()));
    if (curve.rotates) check_rotations(curve, accessor);
    return curve;
  }

  // The times of an accessor, which many samplers may share.
  const std::vector<double>& times(size_t index) {
    const auto [entry, fresh] = times_.try_emplace(index);
    if (!fresh) return entry->second;
    breaches_.check_attribute("times", index);
    entry->second = buffers_.numbers(index, "SCALAR");
    const GltfObject accessor = document_.element("accessors", index);
    const std::vector<double>& all = entry->second;
    for (size_t i = 0; i < all.size(); ++i) {
      if (!std::isfinite(all[i])) accessor.fail("contains a time that is not finite");
      if (i > 0 && !(all[i] > all[i - 1]))
        accessor.fail(fmt::format("contains the time {} after {}: times must increase", all[i], all[i - 1]));
    }
    if (all.front() < 0) breaches_.add("animations that begin before 0", accessor.location());
    return all;
  }

  void check_rotations(const KeyCurve& curve, const GltfObject& accessor) {
    for (size_t i = 0; i < curve.times.size(); ++i) {
      const double length = glm::length(quaternion(curve.at(i)));
      if (!(length > 1e-6)) accessor.fail("contains a rotation of length 0");
      if (std::abs(length - 1) > 0.01)
        breaches_.add("rotations that are not of unit length, normalised", accessor.location());
    }
  }

  const GltfObject& document_;
  const GltfObject& animation_;
  GltfBuffers& buffers_;
  GltfLeftOut& left_out_;
  GltfBreaches& breaches_;
  std::map<size_t, std::vector<double>> times_;                // by accessor
  std::map<std::pair<size_t, std::string>, KeyCurve> curves_;  // by node and its moving property
};

}  // namespace

std::optional<size_t> find_animation(std::span<const std::string> names, const Playing& playing) {
  if (!playing.animation) return names.empty() ? std::nullopt : std::optional(size_t{0});
  return find_named(names, *playing.animation);
}

GltfMotion motion_at(const GltfObject& document, size_t animation, const Playing& playing,
                     GltfBuffers& buffers, GltfLeftOut& left_out, GltfBreaches& breaches) {
  const GltfObject source = document.element("animations", animation);
  return AnimationReader(document, source, buffers, left_out, breaches).read(playing);
}

}  // namespace eyeray::engine::importers
