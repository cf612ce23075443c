// SPDX-License-Identifier: Apache-2.0
// All headers of the kernel suite.
#pragma once
#include "wavetracer/kernels/bvh.hpp"
#include "wavetracer/kernels/compact.hpp"
#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/curves.hpp"
#include "wavetracer/kernels/generate_rays.hpp"
#include "wavetracer/kernels/order_keys.hpp"
#include "wavetracer/kernels/ray_cache.hpp"
#include "wavetracer/kernels/rays.hpp"
#include "wavetracer/kernels/scan.hpp"
#include "wavetracer/kernels/sort.hpp"
