#pragma once

#include <algorithm>
#include <cstdint>

#include "mms/core/image.hpp"

namespace mms {

/// RGB of a color in limited range: y from 16 (black) to 235; cb and cr from -112 to 112, 0 is
/// gray. [1/256]: factors of ITU-R BT.601.
inline Rgb rgb_of_yuv(int y, int cb, int cr) {
  constexpr int kLuma = 298;
  constexpr int kRedOfCr = 409;
  constexpr int kGreenOfCb = -100;
  constexpr int kGreenOfCr = -208;
  constexpr int kBlueOfCb = 516;
  constexpr int kBlack = 16;
  const auto channel = [](int value) {
    return static_cast<std::uint8_t>(std::clamp((value + 128) >> 8, 0, 255));
  };
  const int luma = kLuma * (y - kBlack);
  return {channel(luma + kRedOfCr * cr), channel(luma + kGreenOfCb * cb + kGreenOfCr * cr),
          channel(luma + kBlueOfCb * cb)};
}

}  // namespace mms
