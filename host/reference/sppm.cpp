// Knaus, Zwicker: Progressive Photon Mapping: A Probabilistic Approach, TOG 30(3), 2011. Hachisuka, Jensen:
// Stochastic Progressive Photon Mapping, TOG 28(5), 2009. Jensen: Global Illumination Using Photon Maps,
// 1996.
#include <algorithm>
#include <cmath>

#include "host/reference/path_sample.hpp"

namespace eyeray::engine::reference {

extern const Integrator sppm_integrator;

namespace {

constexpr std::string_view manual =
    "Photon mapping. It works as `path` does, but light that more than one surface scatters is found from "
    "the lights. For each sample the lights emit `photons` new photons, which surfaces scatter "
    "and store. A path from the eye gathers the photons around the first point that scatters light widely. "
    "The radius shrinks from sample to sample. Caustics of point lights and small area lights are therefore "
    "soon free of noise. Light that only one surface scatters is the same as in `path`. Volume caustics in "
    "media are not computed.";

}  // namespace

// The light of the photons on a disk around the point. Epanechnikov's kernel is in Silverman: Density
// Estimation, 1986.
Vec3 PathSample::gathered(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& wide,
                          const PhotonMap& photons) const {
  const double radius = photons.radius();
  const Vec3 &n = at.surface.normal_geometric, &p = at.surface.position;
  const auto kernel = [&](double distance) {
    const double share = distance * distance / (radius * radius);
    return 2 / (M_PI * radius * radius) * (1 - share);
  };
  Vec3 light(0), most(0);  // the largest change of light by one photon that rounding displaces
  photons.near(p, [&](const Photon& photon) {
    const Vec3 apart = photon.position - p;
    const double distance = glm::length(apart);
    const bool before = leaving(at, photon.direction) == Leaving::in_front;
    // The photon's weight if it were nearer to the point by this share of the radius. Its limits of height
    // above the plane and of its normal are wider by the same share.
    const auto weight = [&](double nearer) {
      const double moved = std::max(0.0, distance - nearer * radius);
      const bool counts = moved < radius && std::abs(glm::dot(apart, n)) < (0.1 + nearer) * radius &&
                          glm::dot(photon.normal, before ? n : -n) > 0.9 - nearer;
      return counts ? kernel(moved) : 0;
    };
    const double here = weight(0), displaced = weight(photon_ * rounding::photon_displacement);
    if ((here == 0 && displaced == 0) || photon.depth + depth_ > scene_.render.max_depth) return;
    const auto brought = [&](const Vec3& direction) {
      return wide.at(frame.into(direction), before).value / std::abs(glm::dot(direction, n)) * photon.flux;
    };
    const Vec3 undisplaced = brought(photon.direction);
    light += undisplaced * here;
    if (photon_ == 0) return;
    Vec3 turned = undisplaced;
    for (const double turn : {rounding::photon_turn, -rounding::photon_turn})
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction = photon.direction;
        direction[axis] += turn;
        const Vec3 other = brought(glm::normalize(direction));
        if (photon_ * (glm::length(other) - glm::length(turned)) > 0) turned = other;
      }
    const Vec3 change =
        turned * (1 + photon_ * rounding::photon_flux_change) * displaced - undisplaced * here;
    if (glm::length(change) > glm::length(most)) most = change;
  });
  return (light + most) / double(photons.count());
}

// The light scattered from one light: in full by the wide lobes. By the sharp lobes, only the part counts
// that the path does not find itself.
Vec3 PathSample::direct_on_parts(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& wide,
                                 const ViewedBsdf& sharp, const MediaStack& media) {
  if (depth_ > scene_.render.max_depth) return Vec3(0);
  const auto light = arriving(at);
  if (!light || light->radiance == Vec3(0)) return Vec3(0);
  const Vec3 i = frame.into(light->l);
  const bool before = rays_.is_before(at.surface, light->l, light->distance);
  const BsdfValue by_path = sharp.at(i, before);
  const double weight = light->density > 0 ? power_heuristic(light->density, by_path.density) : 1;
  const Vec3 value = wide.at(i, before).value + weight * by_path.value;
  if (value == Vec3(0)) return Vec3(0);
  return direct(at, *light, {value, 0}, before ? media : at.media_beyond);
}

// Gathers photons where a path hits a surface with wide lobes. In a medium the path continues as for `path`,
// since no photon is stored there.
std::optional<Ray> PathSample::hit_gathering(const Interaction& at, const LocalFrame& frame,
                                             const ViewedBsdf& bsdf, MediaStack& media, Vec3& color) {
  const ViewedBsdf wide = bsdf.part(true), sharp = bsdf.part(false);
  Vec3 light = emitted(at);
  if (!bsdf.black()) light += direct_on_parts(at, frame, wide, sharp, media);
  if (!wide.black() && depth_ <= scene_.render.max_depth)
    light += gathered(at, frame, wide, *tracer_.photons(id_.index));
  gain(light, color);
  const bool goes_on = wide.black() || pair(scatter_pair).x < sharp.followed();
  return goes_on ? scatter(at, frame, sharp, media) : std::nullopt;
}

PhotonWay PathSample::photon(const PhotonSources& sources, std::vector<Photon>& stopped) {
  const PhotonSource source = sources.draw([&](uint32_t use) { return pair_of(use); });
  rays_.decided(Event::light, 2 * (source.light + 2) + (source.below ? 1 : 0));
  if (!sources.settings().targets.empty()) rays_.decided(Event::aim, source.aim);
  MediaStack media = source.media;
  Ray ray = rays_.start_ray(source.ray);
  vertex_ = ray.o;
  if (source.flux == Vec3(0)) return {.trail = rays_.sample(Vec3(0)).trail};
  // Radiance is index² times the value that paths carry; flux is as well.
  const auto squared_index = [&](const MediaStack& in, const Vec3& light) {
    return std::pow(rays_.medium(in).index(light), 2);
  };
  const Vec3 sent = source.flux * squared_index(media, Vec3(1));
  PhotonWay way{.sent = sent};
  while (depth_ <= scene_.render.max_depth) {
    ray = with_key(ray, 0);
    const auto hit = rays_.trace(ray);
    const Flight flight = fly(ray, media, hit);
    const Vec3 before = throughput_;
    const Vec3 weight = flight.weight * dispersed(hit, flight, media);
    throughput_ *= weight;
    std::optional<Ray> next;
    if (flight.scattered) {
      rays_.decided(Event::hit, in_medium);
      next = scatter_in(rays_.medium(media), scattered_at(ray, flight.t));
    } else if (hit) {
      const Interaction at = rays_.interaction(ray, *hit, media, before, weight);
      rays_.decided(Event::hit, at.primitive + 1);
      const LocalFrame frame = LocalFrame::of(at.surface);
      const ViewedBsdf bsdf(at.bsdf, frame.seen(-at.d));
      const Vec3 &bent = at.surface.normal, &n = at.surface.normal_geometric;
      if (depth_ > 0 && !bsdf.part(true).black()) {
        const Vec3 flux = sent * throughput_ / squared_index(media, throughput_);
        stopped.push_back({at.surface.position, -at.d, n, flux, id_.index, depth_});
        way.add(at.surface.position, -at.d, flux);
      }
      next = scatter(at, frame, bsdf.adjoint(), media);
      // Weigh a path from the light by the cosines with the bent normal, for the incoming and the outgoing
      // direction. Veach: Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 5.3.
      if (next && bent != n)
        throughput_ *= std::abs(glm::dot(next->d, n) / glm::dot(next->d, bent) * glm::dot(at.d, bent) /
                                glm::dot(at.d, n));
      // No camera path comes from a direction that is on different sides of normal_side and of the geometric
      // normal: there the photon ends.
      if (next && glm::dot(next->d, n) * glm::dot(next->d, at.surface.normal_side) < 0) break;
    } else {
      rays_.decided(Event::hit, 0);
      break;
    }
    if (!next) {
      rays_.decided(Event::way, 0);
      break;
    }
    ray = *next;
  }
  way.trail = rays_.sample(Vec3(0)).trail;
  return way;
}

namespace {

PixelSample sppm(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                 const rounding::Displacement& displacement, const Observer& observer) {
  return PathSample(tracer, id, displacement, observer).gathering_sample(ray, media);
}

}  // namespace

extern const Integrator sppm_integrator{.manual = manual, .sample = sppm};

}  // namespace eyeray::engine::reference
