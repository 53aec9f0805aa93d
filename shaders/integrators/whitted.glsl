// Whitted's recursion as a loop: a ray's weight travels with it, and of two children one waits on a stack.
#ifndef WHITTED_GLSL
#define WHITTED_GLSL
#include "lights/light.glsl"
#include "materials/material.glsl"
#include "materials/media.glsl"
#include "geometry/surface.glsl"
#include "bvh/traverse.glsl"

SHADER_BEGIN

struct PathRay {
  vec3 o;
  vec3 d;
  vec3 throughput;  // what its radiance counts for in the pixel
  uint depth;   // reflections and refractions so far
  uint media;
};

// Its own light, the ambient one and what every visible light adds at a point.
vec3 direct_light(Frame frame, Material material, Scattering scattering, Surface seen, vec3 to_viewer,
                  INOUT(uvec4) counts) {
  vec3 color = scattering.ambient * vec3(frame.ambient);
#if HAS_EMISSION
  color = color + scattering.emitted;
#endif
  // Tested at the bottom: Mesa 22.3.6 would go round once more, with all lanes idle.
  uint i = 0u;
  if (LIGHT_COUNT > 0u) do {
    counts.w += 1u + TRACE_ITERATIONS;
    LightSample light = sample_light(load_light(i), seen.p);
    float cosine = dot3(seen.normal, light.direction);
    if (cosine > 0.0f && dot3(seen.normal_geometric, light.direction) > 0.0f) {
      counts.x += 1u;
#if STORED_HITS
      uint occluded = load_occlusion(i);
#else
      uint occluded = occlusion(spawn_ray(seen, light.direction), light.distance, counts.z);
#endif
      float visible = visibility(occluded);
      float lobe = highlight(material, seen.normal, light.direction, to_viewer);
      color = color + light.color * (scattering.diffuse * cosine + scattering.specular * lobe) * visible;
    }
    i += 1u;
  } while (i < LIGHT_COUNT);
  return color;
}

// The refracted direction; only asked for when refraction is possible.
vec3 refracted(vec3 d, vec3 n, float cos_view, float eta) {
  float cos_squared = 1.0f - eta * eta * (1.0f - cos_view * cos_view);
  return normalize3(d * eta + n * (eta * cos_view - sqrt(maximum(cos_squared, 0.0f))));
}

// What a path comes to where it strikes something: the children that go on from there.
struct Children {
  PathRay reflected;
  PathRay transmitted;
  bool reflects;
  bool transmits;
#if RAY_KINDS
  bool totally;  // whether all is reflected where light may pass
#endif
};

// Adds what `path`, traced to `hit`, sees there, and finds its children.
Children follow(Frame frame, PathRay path, Ray ray, Hit hit, INOUT(vec3) color, INOUT(uvec4) counts) {
  Children children;
  children.reflected = path;
  children.transmitted = path;
  children.reflects = false;
  children.transmits = false;
#if RAY_KINDS
  children.totally = false;
#endif
  bool struck = hit.slot != NONE;
  counts.x += 1u;
  counts.y += struck ? 1u : 0u;
  counts.w += TRACE_ITERATIONS + 1u;
  if (!struck) {
    color = color + path.throughput * vec3(frame.background);
  } else {
    // Weaken by the medium that the ray came through.
    Primitive primitive = primitive_at(hit);
    Material material = load_material(material_of(primitive));
    vec3 throughput = path.throughput;
#if HAS_MEDIA
    Medium from = load_medium(innermost_medium(path.media));
#if HAS_ABSORPTION
    throughput = throughput * vec3(exp_negative(-from.absorption_ior.x * hit.t), exp_negative(-from.absorption_ior.y * hit.t),
                           exp_negative(-from.absorption_ior.z * hit.t));
#endif
#endif

    // Find the surface as the viewer sees it, and the medium behind it.
    Surface surface = surface_at(primitive, ray, hit);
    bool front = dot3(ray.d, surface.normal_geometric) < 0.0f;
    Surface seen = face_viewer(surface, front);
    float cos_view = minimum(maximum(-dot3(ray.d, seen.normal), 0.0f), 1.0f);
    ScatteringContext context;
    context.uv = surface.uv;
    context.color = vec3(1.0f, 1.0f, 1.0f);
#if HAS_COLORS
    context.color = vertex_color(primitive, hit);
#endif
    context.cos_view = cos_view;
    context.ior_from = 1.0f;
    context.ior_to = 1.0f;
#if HAS_MEDIA
    uint media_behind = path.media;
    if (material.head.z != 0u)
      media_behind = front ? enter_medium(path.media, material.head.z, counts.z)
                           : leave_medium(path.media, material.head.z);
    context.ior_from = from.absorption_ior.w;
    context.ior_to = load_medium(innermost_medium(media_behind)).absorption_ior.w;
#endif

    // Shade.
    Scattering scattering = scattering_of(material_of(primitive), material, context);
    color = color + throughput * direct_light(frame, material, scattering, seen, -ray.d, counts);

#if HAS_SECONDARY
    // Send out the children that count for enough.
    bool deeper = path.depth < frame.camera.w;
    children.reflected.d = normalize3(ray.d + seen.normal * (2.0f * cos_view));
    children.reflected.o = spawn_ray(surface, children.reflected.d).o;
    children.reflected.throughput = throughput * scattering.reflected;
    children.reflected.depth = path.depth + 1u;
    children.reflects = deeper && max_component(children.reflected.throughput) > frame.right.w;
#if HAS_MEDIA
    children.transmitted.d = refracted(ray.d, seen.normal, cos_view, context.ior_from / context.ior_to);
    children.transmitted.o = spawn_ray(surface, children.transmitted.d).o;
    children.transmitted.throughput = throughput * scattering.transmitted;
    children.transmitted.depth = path.depth + 1u;
    children.transmitted.media = media_behind;
    children.transmits = deeper && max_component(children.transmitted.throughput) > frame.right.w;
#if RAY_KINDS
    children.totally = deeper && material.head.z != 0u && max_component(scattering.transmitted) == 0.0f;
#endif
#endif
#endif
  }
  return children;
}

#if RAY_KINDS
// What a sample counted, as a result holds it where rays are counted by their kinds. What does not fit stays at the most that does.
uint at_most(uint x, uint most) { return x < most ? x : most; }
uvec4 counts_by_kind(uvec4 counts, uint reflected, uint refracted, uint total) {
  return uvec4(counts.x, counts.y, counts.z | at_most(refracted, 0xffffffffu >> REFRACTED_SHIFT) << REFRACTED_SHIFT,
               at_most(reflected, (1u << TOTAL_SHIFT) - 1u) |
                   at_most(total, 0xffffffffu >> TOTAL_SHIFT) << TOTAL_SHIFT);
}
#endif

PathRay eye_path(Frame frame, Ray eye_ray) {
  PathRay path;
  path.o = eye_ray.o;
  path.d = eye_ray.d;
  path.throughput = vec3(1.0f, 1.0f, 1.0f);
  path.depth = 0u;
  path.media = frame.camera.z;
  return path;
}

vec3 whitted_radiance(Frame frame, Ray eye_ray, INOUT(uvec4) counts) {
#if WHITTED_STACK > 0
  PathRay stack[WHITTED_STACK];
  uint pending = 0u;
#endif
#if RAY_KINDS
  uint rays_reflected = 0u;
  uint rays_refracted = 0u;
  uint total_reflections = 0u;
#endif
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
  PathRay path = eye_path(frame, eye_ray);
  bool going = true;
  for (; going;) {
    Ray ray = make_ray(path.o, path.d);
    Hit hit = trace(ray, counts.z);
    Children children = follow(frame, path, ray, hit, color, counts);

    // Go on with one child, and let the other wait.
#if WHITTED_STACK > 0
    if (children.reflects && children.transmits) {
      if (pending == uint(WHITTED_STACK)) {
        counts.z = counts.z | FLAG_STACK_OVERFLOW;
      } else {
        stack[pending] = children.reflected;
        pending += 1u;
      }
    }
#endif
    going = children.reflects || children.transmits;
    path = children.reflected;
    if (children.transmits) path = children.transmitted;

#if WHITTED_STACK > 0
    if (!going && pending > 0u) {
      pending -= 1u;
      path = stack[pending];
      going = true;
    }
#endif
#ifdef LOOP_BUDGET
    if (going && counts.w > LOOP_BUDGET) {
      counts.z = counts.z | FLAG_LOOP_BUDGET;
      going = false;
    }
#endif
#if RAY_KINDS
    // What waited is a reflected ray.
    rays_reflected += going && !children.transmits ? 1u : 0u;
    rays_refracted += going && children.transmits ? 1u : 0u;
    total_reflections += children.totally ? 1u : 0u;
#endif
    // Tested at the bottom, which saves a round with all lanes idle; but not where no loop over lights is inside this one: there Mesa
    // 22.3.6 may take what it computed last from the rounds of other rays (docs/lavapipe.md).
    if (LIGHT_COUNT > 0u && !going) break;
  }
#if RAY_KINDS
  counts = counts_by_kind(counts, rays_reflected, rays_refracted, total_reflections);
#endif
  return color;
}

SHADER_END
#endif
