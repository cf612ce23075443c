// SPDX-License-Identifier: Apache-2.0
// The frames that every device computes alike, bit for bit: the number of their paths, and hashes of them. There is one
// row for each set of features, and then for each of CheckedWays, by CheckedFeatures::frame(). The test `device_check`
// prints the right rows.
#pragma once
#include <array>
#include <cstdint>

namespace wavetracer {

struct KnownFrame {
  uint32_t paths = 0;
  uint64_t sequences = 0;  // mix64 of the surfaces, wedges and kinds of interactions of the paths
  uint64_t points = 0;     // mix64 of their points
  bool operator==(const KnownFrame&) const = default;
};

// clang-format off
inline constexpr std::array<KnownFrame, 38> known_frames{{
    {18, 0x04b8e8fb3b35bb2b, 0x25f3beca00a5851d},
    {126, 0x249cfb51575c99c3, 0xff968b3d5804cdb9},
    {352, 0x56ebaa69dadef4db, 0xcfa6804b0c9cd768},
    {353, 0x5b8f4658e44bebf8, 0xe2c9d11f2db4fa1d},
    {16, 0xa1502ea7163ee85b, 0x016430d5e0888e8f},
    {148, 0x87d3d2ec7965f1da, 0x8598d75b7fa646e4},
    {542, 0x494be28b02fc0ac2, 0xd5da5f1c61e2fe19},
    {543, 0xac8fa270148c42ee, 0x35a62cc9a4e3671d},
    {16, 0x2639cda0955732a0, 0x181b1bdc5428fab1},
    {130, 0x41a17a2c155c03f0, 0x62fcd3b50e8aee92},
    {356, 0x9aaacb991b7b8319, 0x557846b0fcfe7417},
    {357, 0x318a68861a5bc20e, 0x8cacfc3f75cee957},
    {14, 0x9b58c340b6f2ac94, 0x365a283b118ee6a9},
    {152, 0xe4f8e151e077577c, 0x8a63c63d289242c4},
    {546, 0x7d2d463c305e5777, 0xf9fd0717774dc9c5},
    {547, 0xcdaff4987d9efafc, 0xdac877f845a2ed97},
    {104, 0x71a12522c7d99272, 0x7397ac502b4da06a},
    {212, 0x5731f71058c8d1a5, 0x9919d302e0a50d25},
    {438, 0x7d8d56ba84dfa585, 0x1e9a9ab6d2e40af8},
    {439, 0xb27975032630a069, 0x37a1d548f48a6c6b},
    {102, 0x58a7d72bc0b7c06f, 0x5b60a0d89d862c8d},
    {234, 0x9b947766ff04b180, 0x03db5c4e50410a18},
    {628, 0x659958a5ecc45814, 0xa50c45f574f194f5},
    {629, 0x171e98800a526bfe, 0xe734e46c3d9b9b5b},
    {102, 0xb69db4180e968259, 0x924ecb0676ac2646},
    {216, 0x11af7b576788f050, 0xf6706c58a91948ca},
    {442, 0x11abcc33b53d84b6, 0x149e55c6fe94263f},
    {443, 0x8394fd39fc08062b, 0xab65312dacabc770},
    {100, 0xe2589e8ac1268b81, 0xaa29eb1b4f16416a},
    {238, 0x9287a2166ed4789e, 0x3ce5eb1b4fde614b},
    {632, 0x04d45835785a38e8, 0xc44b2491c4911efb},
    {633, 0x7d1a87e3bd776d09, 0x5ba9e90908e77a90},
    {309, 0xb958b66237aaed1c, 0xfa1d3f7f70984b3a},
    {537, 0x12726c10a3310996, 0x71b1c13577c7d090},
    {700, 0xcd8444b4decac91f, 0xc7821746e38ea1ba},
    {3646, 0x5b16bf4c67ef2cce, 0x97b09da0dbc5b306},
    {126, 0x249cfb51575c99c3, 0xff968b3d5804cdb9},
    {113, 0x00ae0649d369ef0d, 0xceb3a1dca04a6d50},
}};
// clang-format on

}  // namespace wavetracer
