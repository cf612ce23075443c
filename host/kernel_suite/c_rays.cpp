// SPDX-License-Identifier: Apache-2.0
// The C face of keys along curves, trees and ray caches: kernels.h over the C++ classes, as c_api.cpp has the others.
#include <fmt/format.h>

#include <optional>

#include "kernel_suite/c_handles.hpp"
#include "wavetracer/kernels/bvh.hpp"
#include "wavetracer/kernels/curves.hpp"
#include "wavetracer/kernels/ray_cache.hpp"

namespace {

namespace suite = wavetracer::kernels;
using suite::c_face::call_of;
using suite::c_face::done_or_error;
using suite::c_face::given;
using suite::c_face::guarded;
using suite::c_face::SharedContext;

}  // namespace

struct wavetracer_kernels_curve_keys {
  SharedContext context;
  unsigned key_bits;
  suite::CurveKeys keys;
};

struct wavetracer_kernels_bvh {
  SharedContext context;
  suite::Bvh bvh;
};

struct wavetracer_kernels_ray_cache {
  SharedContext context;
  suite::RayCache cache;
  const suite::RayCache::Misses* to_trace = nullptr;
};

static_assert(WAVETRACER_KERNELS_MORTON2 == static_cast<int>(suite::Curve::morton2) &&
              WAVETRACER_KERNELS_MORTON3 == static_cast<int>(suite::Curve::morton3) &&
              WAVETRACER_KERNELS_MORTON5 == static_cast<int>(suite::Curve::morton5) &&
              WAVETRACER_KERNELS_HILBERT2 == static_cast<int>(suite::Curve::hilbert2) &&
              WAVETRACER_KERNELS_HILBERT3 == static_cast<int>(suite::Curve::hilbert3));
static_assert(WAVETRACER_KERNELS_NO_TRIANGLE == suite::no_triangle &&
              WAVETRACER_KERNELS_NO_TRIANGLE == suite::no_object);
static_assert(sizeof(wavetracer_kernels_ray) == sizeof(suite::Ray) &&
              sizeof(wavetracer_kernels_hit) == sizeof(suite::Hit));

namespace {

using wavetracer::CacheHitPoint;
using wavetracer::CacheKey;
using wavetracer::CacheKind;
using wavetracer::CacheLocking;
using wavetracer::CachePurging;
using wavetracer::CacheScope;

static_assert(CacheKind("chained").index() == WAVETRACER_KERNELS_CACHE_CHAINED &&
              CacheKind("open").index() == WAVETRACER_KERNELS_CACHE_OPEN &&
              CacheKind("concurrent").index() == WAVETRACER_KERNELS_CACHE_CONCURRENT &&
              CacheKind("thesis").index() == WAVETRACER_KERNELS_CACHE_THESIS &&
              CacheKind("thesis-chained").index() == WAVETRACER_KERNELS_CACHE_THESIS_CHAINED);
static_assert(CacheKey("exact").index() == WAVETRACER_KERNELS_CACHE_EXACT &&
              CacheHitPoint("cached").index() == WAVETRACER_KERNELS_CACHE_CACHED &&
              CachePurging("precision").index() == WAVETRACER_KERNELS_CACHE_PRECISION &&
              CacheLocking("readers").index() == WAVETRACER_KERNELS_CACHE_READERS &&
              CacheScope("all").index() == WAVETRACER_KERNELS_CACHE_ALL);

// Sets a choice by its number. Throws Error for a number that it does not have.
template <class Choice>
void choose(Choice& choice, const char* name, int number) {
  if (number < 0 || static_cast<size_t>(number) >= Choice::words.size())
    throw suite::Error(fmt::format("RayCache: {} = {}: it is one of the words of kernels.h", name, number), 0, "");
  choice = Choice::named(Choice::words[static_cast<size_t>(number)]);
}

wavetracer::CacheConfig config_of(const wavetracer_kernels_cache_options& options) {
  wavetracer::CacheConfig config;
  choose(config.kind, "kind", options.kind);
  choose(config.key, "key", options.key);
  choose(config.hit_point, "hit_point", options.hit_point);
  choose(config.purge, "purge", options.purge);
  choose(config.locking, "locking", options.locking);
  choose(config.scope, "scope", options.scope);
  config.innerframe = options.innerframe != 0;
  config.hash_method = options.hash_method;
  config.division = options.division;
  config.readers_number = options.readers_number;
  config.buffer_size = options.buffer_size;
  config.load_factor = options.load_factor;
  config.position_step_m = options.position_step_m;
  config.residual_value = options.residual_value;
  return config;
}

// Memory that a caller may leave out.
std::optional<suite::Buffer<uint32_t>> words_of(const suite::Context& context, cl_mem memory) {
  if (!memory) return {};
  return context.wrap<uint32_t>(memory);
}

}  // namespace

wavetracer_kernels_curve_keys* wavetracer_kernels_curve_keys_make(const wavetracer_kernels_context* context, int curve,
                                                                  unsigned key_bits, wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_curve_keys*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    return new wavetracer_kernels_curve_keys{shared, key_bits,
                                             suite::CurveKeys(*shared, static_cast<suite::Curve>(curve), key_bits)};
  });
}
void wavetracer_kernels_curve_keys_free(wavetracer_kernels_curve_keys* self) { delete self; }

unsigned wavetracer_kernels_curve_keys_dimensions(const wavetracer_kernels_curve_keys* self) {
  return self ? self->keys.dimensions() : 0;
}
unsigned wavetracer_kernels_curve_keys_bits(const wavetracer_kernels_curve_keys* self, uint64_t cells) {
  return self ? self->keys.bits(cells) : 0;
}

int wavetracer_kernels_curve_keys_run(wavetracer_kernels_curve_keys* self, cl_mem points, size_t n, size_t stride,
                                      const float* lower, const float* upper, uint64_t cells, cl_mem keys,
                                      cl_uint after_count, const cl_event* after, cl_event* done,
                                      wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    if (!lower || !upper) throw suite::Error("CurveKeys: the box is null", 0, "");
    const unsigned dimensions = self->keys.dimensions();
    const suite::CurveBox box{{lower, dimensions}, {upper, dimensions}, cells};
    const suite::Call call = call_of(after_count, after, done);
    const auto from = context.wrap<float>(points);
    if (self->key_bits == 64)
      self->keys(from, n, box, context.wrap<uint64_t>(keys), stride, call);
    else
      self->keys(from, n, box, context.wrap<uint32_t>(keys), stride, call);
  });
}

wavetracer_kernels_bvh* wavetracer_kernels_bvh_make(const wavetracer_kernels_context* context, const float* corners,
                                                    size_t triangles, float reach, wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_bvh*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    if (triangles > 0 && !corners) throw suite::Error("Bvh: the corners are null", 0, "");
    return new wavetracer_kernels_bvh{shared, suite::Bvh(*shared, {corners, 9 * triangles}, {.reach = reach})};
  });
}
void wavetracer_kernels_bvh_free(wavetracer_kernels_bvh* self) { delete self; }

int wavetracer_kernels_bvh_nearest(wavetracer_kernels_bvh* self, cl_mem rays, size_t n, cl_mem hits,
                                   cl_uint after_count, const cl_event* after, cl_event* done,
                                   wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    self->bvh.nearest(context.wrap<suite::Ray>(rays), n, context.wrap<suite::Hit>(hits),
                      call_of(after_count, after, done));
  });
}
int wavetracer_kernels_bvh_any(wavetracer_kernels_bvh* self, cl_mem rays, size_t n, cl_mem met, cl_uint after_count,
                               const cl_event* after, cl_event* done, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    self->bvh.any(context.wrap<suite::Ray>(rays), n, context.wrap<uint32_t>(met), call_of(after_count, after, done));
  });
}

wavetracer_kernels_cache_options wavetracer_kernels_cache_defaults() {
  const wavetracer::CacheConfig config;
  return {.kind = WAVETRACER_KERNELS_CACHE_CONCURRENT,
          .key = static_cast<int>(config.key.index()),
          .hit_point = static_cast<int>(config.hit_point.index()),
          .purge = static_cast<int>(config.purge.index()),
          .locking = static_cast<int>(config.locking.index()),
          .scope = static_cast<int>(config.scope.index()),
          .innerframe = config.innerframe,
          .hash_method = config.hash_method,
          .division = config.division,
          .readers_number = config.readers_number,
          .buffer_size = config.buffer_size,
          .load_factor = config.load_factor,
          .position_step_m = config.position_step_m,
          .residual_value = config.residual_value};
}

wavetracer_kernels_ray_cache* wavetracer_kernels_ray_cache_make(const wavetracer_kernels_context* context,
                                                                const wavetracer_kernels_cache_options* options,
                                                                const wavetracer_kernels_bvh* bvh, size_t triangles,
                                                                uint32_t regions, const uint32_t* objects,
                                                                wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_ray_cache*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    const wavetracer::CacheConfig config = config_of(given(options));
    const size_t count = bvh ? bvh->bvh.triangles() : triangles;
    const std::span<const uint32_t> of_triangles(objects, objects ? count : 0);
    return new wavetracer_kernels_ray_cache{shared,
                                            bvh ? suite::RayCache(*shared, config, bvh->bvh, regions, of_triangles)
                                                : suite::RayCache(*shared, config, count, regions, of_triangles)};
  });
}
void wavetracer_kernels_ray_cache_free(wavetracer_kernels_ray_cache* self) { delete self; }

int wavetracer_kernels_ray_cache_look_up(wavetracer_kernels_ray_cache* self, cl_mem rays, size_t n, cl_mem hits,
                                         cl_mem left, cl_mem regions, size_t* to_trace, cl_uint after_count,
                                         const cl_event* after, cl_event* done, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    const std::optional left_of = words_of(context, left), region_of = words_of(context, regions);
    self->to_trace = &self->cache.look_up(context.wrap<suite::Ray>(rays), n, context.wrap<suite::Hit>(hits),
                                          left_of ? &*left_of : nullptr, region_of ? &*region_of : nullptr,
                                          call_of(after_count, after, done));
    if (to_trace) *to_trace = self->to_trace->count;
  });
}

cl_mem wavetracer_kernels_ray_cache_rays(const wavetracer_kernels_ray_cache* self) {
  return self && self->to_trace ? self->to_trace->rays.handle() : nullptr;
}
cl_mem wavetracer_kernels_ray_cache_indices(const wavetracer_kernels_ray_cache* self) {
  return self && self->to_trace ? self->to_trace->indices.handle() : nullptr;
}

int wavetracer_kernels_ray_cache_store(wavetracer_kernels_ray_cache* self, cl_mem traced, cl_mem hits, size_t* to_trace,
                                       cl_uint after_count, const cl_event* after, cl_event* done,
                                       wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    self->to_trace = &self->cache.store(context.wrap<suite::Hit>(traced), context.wrap<suite::Hit>(hits),
                                        call_of(after_count, after, done));
    if (to_trace) *to_trace = self->to_trace->count;
  });
}

int wavetracer_kernels_ray_cache_next_frame(wavetracer_kernels_ray_cache* self, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] { given(self).cache.next_frame(); });
}
int wavetracer_kernels_ray_cache_place_region(wavetracer_kernels_ray_cache* self, uint32_t region,
                                              const double* position_m, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const double* p = &given(position_m);
    given(self).cache.place_region(region, {p[0], p[1], p[2]});
  });
}
int wavetracer_kernels_ray_cache_move_object(wavetracer_kernels_ray_cache* self, uint32_t object,
                                             wavetracer_kernels_error** error) {
  return done_or_error(error, [&] { given(self).cache.move_object(object); });
}
int wavetracer_kernels_ray_cache_purge(wavetracer_kernels_ray_cache* self, uint32_t frames,
                                       wavetracer_kernels_error** error) {
  return done_or_error(error, [&] { given(self).cache.purge(frames); });
}
int wavetracer_kernels_ray_cache_clear(wavetracer_kernels_ray_cache* self, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] { given(self).cache.clear(); });
}

int wavetracer_kernels_ray_cache_statistics(wavetracer_kernels_ray_cache* self,
                                            wavetracer_kernels_cache_statistics* statistics,
                                            wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::RayCacheStatistics s = given(self).cache.statistics();
    given(statistics) = {.look_ups = s.look_ups,
                         .hits = s.hits,
                         .shared = s.shared,
                         .conflicts = s.conflicts,
                         .stale = s.stale,
                         .stored = s.stored,
                         .replaced = s.replaced,
                         .duplicates = s.duplicates,
                         .dropped = s.dropped,
                         .evicted = s.evicted,
                         .entries = s.entries,
                         .used = s.used,
                         .bytes = s.bytes};
  });
}
