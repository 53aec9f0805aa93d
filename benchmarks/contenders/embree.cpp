#include "benchmarks/contenders/embree.hpp"

#include <pmmintrin.h>
#include <xmmintrin.h>

#include <limits>

#include "benchmarks/contenders/embree_world.hpp"
#include "host/bvh/embree_version.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::contenders {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr size_t rays_at_once = 4096;  // a piece of parallel work

// The layout of rays and hits in memory between a renderer's stages.
struct FloatRay {
  float o[3];
  float t_max;
  float d[3];
  uint32_t plane;  // the nearest plane, or none
};
struct FloatHit {
  float t;
  uint32_t index;
  uint32_t part;
};
constexpr uint32_t none = RTC_INVALID_GEOMETRY_ID;

// While this object lives, its thread flushes denormals to zero, as Embree wants it. The arithmetic of other
// code must not be affected.
class FlushDenormals {
 public:
  FlushDenormals() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
};

// A hit whose `part` is the instance or, without an instance, the geometry.
template <typename Hit>
FloatHit to_hit(float t, const Hit& geometry, const Hit& instance, const Hit& index) {
  return {t, index, instance == none ? geometry : instance};
}

void load(RTCRay& to, const FloatRay& ray) {
  to = {.org_x = ray.o[0],
        .org_y = ray.o[1],
        .org_z = ray.o[2],
        .tnear = 0,
        .dir_x = ray.d[0],
        .dir_y = ray.d[1],
        .dir_z = ray.d[2],
        .time = 0,
        .tfar = ray.t_max,
        .mask = ~0u,
        .id = 0,
        .flags = 0};
}

void clear(RTCHit& hit) {
  hit.geomID = hit.primID = hit.instID[0] = none;
}

// Arguments of Embree's queries: version 4 takes arguments after the rays, version 3 a context before them.
class Settings {
 public:
  explicit Settings(bool coherent) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitIntersectArguments(&nearest_);
    rtcInitOccludedArguments(&any_);
    if (coherent) nearest_.flags = any_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
    rtcInitIntersectContext(&context_);
    if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
  }

  // `valid` marks the rays of a packet; a single ray has none.
  template <auto intersect, typename RayHit, typename... Valid>
  void nearest(RTCScene scene, RayHit& query, Valid... valid) {
#if RTC_VERSION_MAJOR >= 4
    intersect(valid..., scene, &query, &nearest_);
#else
    intersect(valid..., scene, &context_, &query);
#endif
  }
  template <auto occluded, typename Ray, typename... Valid>
  void any(RTCScene scene, Ray& query, Valid... valid) {
#if RTC_VERSION_MAJOR >= 4
    occluded(valid..., scene, &query, &any_);
#else
    occluded(valid..., scene, &context_, &query);
#endif
  }

 private:
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments nearest_;
  RTCOccludedArguments any_;
#else
  RTCIntersectContext context_;
#endif
};

// A piece of the rays, traced one by one or in packets.
struct Piece {
  RTCScene scene;
  Settings settings;
  std::span<const FloatRay> rays;
  std::span<FloatHit> hits;
  QueryKind kind;

  void one_by_one();
  template <int width, auto intersect, auto occluded, typename RayHit>
  void packets();
};

void Piece::one_by_one() {
  for (size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query;
    load(query.ray, rays[i]);
    clear(query.hit);
    if (kind == QueryKind::any)
      settings.any<rtcOccluded1>(scene, query.ray);
    else
      settings.nearest<rtcIntersect1>(scene, query);
    hits[i] = to_hit(query.ray.tfar, query.hit.geomID, query.hit.instID[0], query.hit.primID);
  }
}

template <int width, auto intersect, auto occluded, typename RayHit>
void Piece::packets() {
  RayHit query;
  alignas(64) int valid[width];
  for (size_t first = 0; first < rays.size(); first += width) {
    for (int i = 0; i < width; ++i) {
      const size_t at = first + size_t(i);
      valid[i] = at < rays.size() ? -1 : 0;
      const FloatRay& ray = rays[std::min(at, rays.size() - 1)];
      query.ray.org_x[i] = ray.o[0];
      query.ray.org_y[i] = ray.o[1];
      query.ray.org_z[i] = ray.o[2];
      query.ray.dir_x[i] = ray.d[0];
      query.ray.dir_y[i] = ray.d[1];
      query.ray.dir_z[i] = ray.d[2];
      query.ray.tnear[i] = query.ray.time[i] = 0;
      query.ray.tfar[i] = ray.t_max;
      query.ray.mask[i] = ~0u;
      query.ray.flags[i] = 0;
      query.hit.geomID[i] = query.hit.primID[i] = query.hit.instID[0][i] = none;
    }
    const int* const marks = valid;
    if (kind == QueryKind::any)
      settings.any<occluded>(scene, query.ray, marks);
    else
      settings.nearest<intersect>(scene, query, marks);
    for (int i = 0; i < width && first + size_t(i) < rays.size(); ++i)
      hits[first + size_t(i)] =
          to_hit(query.ray.tfar[i], query.hit.geomID[i], query.hit.instID[0][i], query.hit.primID[i]);
  }
}

void trace(Piece& piece, EmbreeCalls calls) {
  switch (calls) {
    case EmbreeCalls::one:
      return piece.one_by_one();
    case EmbreeCalls::packets_of_8:
      return piece.packets<8, rtcIntersect8, rtcOccluded8, RTCRayHit8>();
    case EmbreeCalls::packets_of_16:
      return piece.packets<16, rtcIntersect16, rtcOccluded16, RTCRayHit16>();
  }
}

}  // namespace

std::string_view name(EmbreeCalls calls) {
  switch (calls) {
    case EmbreeCalls::one:
      return "single";
    case EmbreeCalls::packets_of_8:
      return "packets of 8";
    case EmbreeCalls::packets_of_16:
      return "packets of 16";
  }
  return "";
}

Embree::Embree(const Scene& scene) : world_(std::make_unique<EmbreeWorld>(scene)) {}
Embree::~Embree() = default;

double Embree::query(std::span<const Query> rays, QueryKind kind, std::span<QueryHit> hits, EmbreeCalls calls,
                     bool coherent) const {
  CHECK_EQ(rays.size(), hits.size());
  std::vector<FloatRay> float_rays(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    FloatRay& ray = float_rays[i];
    for (int k = 0; k < 3; ++k) {
      ray.o[k] = float(rays[i].o[k]);
      ray.d[k] = float(rays[i].d[k]);
    }
    ray.t_max = float(rays[i].t_max);
    ray.plane = none;
  }
  std::vector<FloatHit> float_hits(rays.size());

  const Stopwatch watch;
  const int pieces = int((rays.size() + rays_at_once - 1) / rays_at_once);
  parallel_for(0, pieces, [&](int number) {
    const FlushDenormals mode;
    const size_t first = size_t(number) * rays_at_once, count = std::min(rays_at_once, rays.size() - first);
    const std::span<FloatRay> some(float_rays.data() + first, count);

    // Test the planes first: hits behind them need not be searched.
    for (FloatRay& ray : some) {
      for (uint32_t i = 0; i < world_->planes.size(); ++i) {
        const EmbreePlane& plane = world_->planes[i];
        if (kind == QueryKind::any && !plane.opaque) continue;
        const float* const n = plane.normal;
        const float t = (plane.distance - (n[0] * ray.o[0] + n[1] * ray.o[1] + n[2] * ray.o[2])) /
                        (n[0] * ray.d[0] + n[1] * ray.d[1] + n[2] * ray.d[2]);
        if (!(t > 0 && t < ray.t_max)) continue;
        ray.t_max = kind == QueryKind::any ? -infinity : t;  // Embree skips a ray that ends before it begins
        ray.plane = i;
      }
    }
    Piece piece{kind == QueryKind::any ? world_->opaque() : world_->all(),
                Settings(coherent),
                some,
                {float_hits.data() + first, count},
                kind};
    trace(piece, calls);
  });
  const double seconds = watch.seconds();

  for (size_t i = 0; i < hits.size(); ++i) {
    const FloatHit& hit = float_hits[i];
    if (kind == QueryKind::any) {
      hits[i] = {hit.t < 0 ? 0 : double(infinity), -1};
    } else if (hit.part != none) {
      hits[i] = {double(hit.t), world_->parts[hit.part].primitive(hit.index)};
    } else if (float_rays[i].plane != none) {
      hits[i] = {double(float_rays[i].t_max), world_->planes[float_rays[i].plane].primitive};
    } else {
      hits[i] = {double(infinity), -1};
    }
  }
  return seconds;
}

double Embree::build_seconds() const {
  return world_->build_seconds;
}
uint64_t Embree::bytes() const {
  return uint64_t(world_->bytes.load());
}
std::string Embree::version() {
  return "Embree " RTC_VERSION_STRING;
}

}  // namespace eyeray::engine::contenders
