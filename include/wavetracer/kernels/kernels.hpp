// SPDX-License-Identifier: Apache-2.0
// All headers of the kernel suite.
#pragma once
#include "wavetracer/kernels/compact.hpp"
#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/scan.hpp"
#include "wavetracer/kernels/sort.hpp"
