// SPDX-License-Identifier: Apache-2.0
// The C face: kernels.h over the C++ classes. A cl_mem is wrapped for each call, which costs some questions to OpenCL.
#include "kernel_suite/c_handles.hpp"
#include "wavetracer/kernels/compact.hpp"
#include "wavetracer/kernels/scan.hpp"
#include "wavetracer/kernels/sort.hpp"

namespace {

namespace suite = wavetracer::kernels;
using suite::c_face::call_of;
using suite::c_face::done_or_error;
using suite::c_face::given;
using suite::c_face::guarded;
using suite::c_face::SharedContext;

}  // namespace

struct wavetracer_kernels_sort {
  SharedContext context;
  unsigned key_bits;
  suite::Sort sort;
};

struct wavetracer_kernels_scan {
  SharedContext context;
  suite::Scan scan;
};

struct wavetracer_kernels_compact {
  SharedContext context;
  suite::Compact compact;
};

static_assert(WAVETRACER_KERNELS_NOTHING == suite::nothing);
static_assert(WAVETRACER_KERNELS_NONE == static_cast<int>(suite::Payload::none) &&
              WAVETRACER_KERNELS_WORDS == static_cast<int>(suite::Payload::words) &&
              WAVETRACER_KERNELS_INDEX == static_cast<int>(suite::Payload::index));
static_assert(WAVETRACER_KERNELS_AUTOMATIC == static_cast<int>(suite::SortMethod::automatic) &&
              WAVETRACER_KERNELS_RADIX == static_cast<int>(suite::SortMethod::radix) &&
              WAVETRACER_KERNELS_BITONIC == static_cast<int>(suite::SortMethod::bitonic));

cl_int wavetracer_kernels_error_code(const wavetracer_kernels_error* error) { return error ? error->code : 0; }
const char* wavetracer_kernels_error_message(const wavetracer_kernels_error* error) {
  return error ? error->message.c_str() : "";
}
const char* wavetracer_kernels_error_kernel(const wavetracer_kernels_error* error) {
  return error ? error->kernel.c_str() : "";
}
void wavetracer_kernels_error_free(wavetracer_kernels_error* error) { delete error; }

wavetracer_kernels_context* wavetracer_kernels_open(cl_context context, cl_device_id device, cl_command_queue queue,
                                                    wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_context*>(error, nullptr, [&] {
    return new wavetracer_kernels_context{std::make_shared<const suite::Context>(context, device, queue)};
  });
}
wavetracer_kernels_context* wavetracer_kernels_open_device(const char* device, wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_context*>(error, nullptr, [&] {
    return new wavetracer_kernels_context{std::make_shared<const suite::Context>(device ? device : "")};
  });
}
void wavetracer_kernels_close(wavetracer_kernels_context* self) { delete self; }

cl_context wavetracer_kernels_cl_context(const wavetracer_kernels_context* self) {
  return self ? self->context->context() : nullptr;
}
cl_device_id wavetracer_kernels_cl_device(const wavetracer_kernels_context* self) {
  return self ? self->context->device() : nullptr;
}
cl_command_queue wavetracer_kernels_cl_queue(const wavetracer_kernels_context* self) {
  return self ? self->context->queue() : nullptr;
}

wavetracer_kernels_sort* wavetracer_kernels_sort_make(const wavetracer_kernels_context* context, unsigned key_bits,
                                                      int payload, int method, wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_sort*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    return new wavetracer_kernels_sort{shared, key_bits,
                                       suite::Sort(*shared, {.key_bits = key_bits,
                                                             .payload = static_cast<suite::Payload>(payload),
                                                             .method = static_cast<suite::SortMethod>(method)})};
  });
}
void wavetracer_kernels_sort_free(wavetracer_kernels_sort* self) { delete self; }

int wavetracer_kernels_sort_run(wavetracer_kernels_sort* self, cl_mem keys, cl_mem values, size_t n, unsigned first_bit,
                                unsigned end_bit, cl_uint after_count, const cl_event* after, cl_event* done,
                                wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    const suite::Call call = call_of(after_count, after, done);
    const suite::BitRange bits{first_bit, end_bit};
    const auto with_keys = [&](const auto& wrapped) {
      if (values)
        self->sort(wrapped, context.wrap<uint32_t>(values), n, bits, call);
      else
        self->sort(wrapped, n, bits, call);
    };
    if (self->key_bits == 64)
      with_keys(context.wrap<uint64_t>(keys));
    else
      with_keys(context.wrap<uint32_t>(keys));
  });
}

size_t wavetracer_kernels_sort_temporary_words(const wavetracer_kernels_sort* self, size_t n) {
  return guarded<size_t>(nullptr, 0, [&] { return given(self).sort.temporary_words(n); });
}

int wavetracer_kernels_sort_reserve(wavetracer_kernels_sort* self, size_t n, wavetracer_kernels_error** error) {
  return done_or_error(error, [&] { given(self).sort.reserve(n); });
}

int wavetracer_kernels_sort_use_temporary(wavetracer_kernels_sort* self, cl_mem memory,
                                          wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    self->sort.use_temporary(memory ? context.wrap<uint32_t>(memory) : suite::Buffer<uint32_t>());
  });
}

wavetracer_kernels_scan* wavetracer_kernels_scan_make(const wavetracer_kernels_context* context,
                                                      wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_scan*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    return new wavetracer_kernels_scan{shared, suite::Scan(*shared)};
  });
}
void wavetracer_kernels_scan_free(wavetracer_kernels_scan* self) { delete self; }

int wavetracer_kernels_scan_run(wavetracer_kernels_scan* self, cl_mem words, size_t n, cl_mem total,
                                cl_uint after_count, const cl_event* after, cl_event* done,
                                wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    const suite::Call call = call_of(after_count, after, done);
    const auto wrapped = context.wrap<uint32_t>(words);
    if (total)
      self->scan(wrapped, n, context.wrap<uint32_t>(total), call);
    else
      self->scan(wrapped, n, call);
  });
}

wavetracer_kernels_compact* wavetracer_kernels_compact_make(const wavetracer_kernels_context* context,
                                                            wavetracer_kernels_error** error) {
  return guarded<wavetracer_kernels_compact*>(error, nullptr, [&] {
    const SharedContext& shared = given(context).context;
    return new wavetracer_kernels_compact{shared, suite::Compact(*shared)};
  });
}
void wavetracer_kernels_compact_free(wavetracer_kernels_compact* self) { delete self; }

int wavetracer_kernels_compact_run(wavetracer_kernels_compact* self, cl_mem words, size_t n, cl_mem indices,
                                   cl_mem total, cl_uint after_count, const cl_event* after, cl_event* done,
                                   wavetracer_kernels_error** error) {
  return done_or_error(error, [&] {
    const suite::Context& context = *given(self).context;
    const suite::Call call = call_of(after_count, after, done);
    self->compact(context.wrap<uint32_t>(words), n, context.wrap<uint32_t>(indices), context.wrap<uint32_t>(total),
                  call);
  });
}
