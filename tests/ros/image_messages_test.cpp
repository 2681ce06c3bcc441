#include "mms/ros/image_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// Two rows of two pixels, each row followed by `padding` bytes.
msg::Image image_of(const std::string& encoding, std::vector<std::uint8_t> bytes,
                    std::size_t padding = 0) {
  msg::Image message;
  message.encoding = encoding;
  message.width = 2;
  message.height = 2;
  const std::size_t row = bytes.size() / 2;
  message.step = static_cast<std::uint32_t>(row + padding);
  message.data.assign(2 * message.step, 0xEE);
  std::copy_n(bytes.begin(), row, message.data.begin());
  std::copy_n(bytes.begin() + std::ptrdiff_t(row), row, message.data.begin() + message.step);
  return message;
}

struct ColorCase {
  const char* encoding;
  std::vector<std::uint8_t> bytes;
};

TEST(ImageMessages, ReadsEveryColorEncoding) {
  const ColorCase cases[] = {
      {"rgb8", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
      {"bgr8", {3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}},
      {"8UC3", {3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}},
      {"rgba8", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 0}},
      {"bgra8", {3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7, 0, 12, 11, 10, 0}},
      {"8UC4", {3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7, 0, 12, 11, 10, 0}},
  };
  for (const ColorCase& one : cases) {
    for (const std::size_t padding : {0U, 5U}) {
      const Image<Rgb> image = color_of(image_of(one.encoding, one.bytes, padding), "test");
      EXPECT_EQ(image(0, 0), (Rgb{1, 2, 3})) << one.encoding;
      EXPECT_EQ(image(1, 0), (Rgb{4, 5, 6})) << one.encoding;
      EXPECT_EQ(image(1, 1), (Rgb{10, 11, 12})) << one.encoding;
    }
  }
}

TEST(ImageMessages, ReadsGreyImages) {
  EXPECT_EQ(color_of(image_of("mono8", {1, 2, 3, 4}), "test")(1, 1), (Rgb{4, 4, 4}));
  EXPECT_EQ(color_of(image_of("8UC1", {1, 2, 3, 4}), "test")(1, 0), (Rgb{2, 2, 2}));
  EXPECT_EQ(color_of(image_of("mono16", {0, 1, 0, 2, 0, 3, 0, 4}), "test")(0, 1), (Rgb{3, 3, 3}));
}

TEST(ImageMessages, ReadsYuv) {
  // Black and white, and twice pure red, in limited range of ITU-R BT.601.
  for (const std::string encoding : {"yuv422", "uyvy"}) {
    const Image<Rgb> image =
        color_of(image_of(encoding, {128, 16, 128, 235, 90, 81, 240, 81}, 3), "test");
    EXPECT_EQ(image(0, 0), (Rgb{0, 0, 0})) << encoding;
    EXPECT_EQ(image(1, 0), (Rgb{255, 255, 255})) << encoding;
    EXPECT_EQ(image(0, 1), (Rgb{255, 0, 0})) << encoding;
  }
  for (const std::string encoding : {"yuv422_yuy2", "yuyv"}) {
    const Image<Rgb> image =
        color_of(image_of(encoding, {16, 128, 235, 128, 81, 90, 81, 240}), "test");
    EXPECT_EQ(image(1, 0), (Rgb{255, 255, 255})) << encoding;
    EXPECT_EQ(image(1, 1), (Rgb{255, 0, 0})) << encoding;
  }
}

TEST(ImageMessages, ReadsBayerPatterns) {
  const ColorCase cases[] = {{"bayer_rggb8", {100, 50, 60, 200}},
                             {"bayer_bggr8", {200, 60, 50, 100}},
                             {"bayer_grbg8", {50, 100, 200, 60}},
                             {"bayer_gbrg8", {60, 200, 100, 50}}};
  for (const ColorCase& one : cases) {
    const Image<Rgb> image = color_of(image_of(one.encoding, one.bytes, 1), "test");
    for (int i = 0; i < 4; ++i) {
      const Rgb pixel = image(i % 2, i / 2);
      const std::uint8_t sample = one.bytes[static_cast<std::size_t>(i)];
      EXPECT_EQ(pixel.r, 100) << one.encoding << " pixel " << i;
      EXPECT_EQ(pixel.g, sample == 50 || sample == 60 ? sample : 55) << one.encoding;
      EXPECT_EQ(pixel.b, 200) << one.encoding << " pixel " << i;
    }
  }
}

/// The colors that a pixel lacks are means of its neighbors.
TEST(ImageMessages, InterpolatesBayerPatterns) {
  msg::Image message;
  message.encoding = "bayer_rggb8";
  message.width = message.height = 4;
  message.step = 4;
  message.data = {10, 0, 20, 0, 0, 7, 0, 9, 30, 0, 40, 0, 0, 11, 0, 13};
  const Image<Rgb> image = color_of(message, "test");
  EXPECT_EQ(image(1, 1), (Rgb{25, 0, 7})) << "of four red samples";
  EXPECT_EQ(image(2, 2), (Rgb{40, 0, 10})) << "of four blue samples";
  EXPECT_EQ(image(1, 2), (Rgb{35, 0, 9})) << "of two each";
}

TEST(ImageMessages, RefusesSidesThatRawColorsDoNotHave) {
  msg::Image message = image_of("yuv422", {128, 16, 128, 235, 90, 81, 240, 81});
  message.width = 1;
  expect_in("test: is 1x2 pixels of yuv422, allowed: an even width",
            message_of<DataError>([&] { color_of(message, "test"); }));
  message.encoding = "bayer_rggb8";
  expect_in("test: is 1x2 pixels of bayer_rggb8, allowed: 2x2 and more",
            message_of<DataError>([&] { color_of(message, "test"); }));
}

TEST(ImageMessages, ReadsDepthInMillimetersInBothByteOrders) {
  msg::Image message = image_of("16UC1", {0, 0, 0xE8, 0x03, 0xDC, 0x05, 0xFF, 0xFF}, 2);
  const Image<float> depth = depth_of(message, "test");
  EXPECT_EQ(depth(0, 0), 0.0F);
  EXPECT_EQ(depth(1, 0), 1.0F);
  EXPECT_EQ(depth(0, 1), 1.5F);
  EXPECT_EQ(depth(1, 1), 65.535F);
  message = image_of("mono16", {0, 0, 0x03, 0xE8, 0x05, 0xDC, 0xFF, 0xFF});
  message.is_bigendian = 1;
  EXPECT_EQ(depth_of(message, "test").pixels(), depth.pixels());
}

TEST(ImageMessages, ReadsDepthInUnitsOfAScale) {
  const msg::Image message = image_of("mono16", {0, 0, 0xE8, 0x03, 0xDC, 0x05, 0xFF, 0xFF});
  EXPECT_EQ(depth_of(message, "test", 4000.0)(1, 0), 0.25F);
  const msg::CompressedImage compressed = compressed_message({}, Image<std::uint16_t>(2, 1, 3000));
  EXPECT_EQ(depth_of(compressed, "test", 4000.0)(1, 0), 0.75F);
  const msg::CompressedImage plain{{}, "png", encode_png(Image<std::uint16_t>(2, 1, 3000))};
  EXPECT_EQ(depth_of(plain, "test", 4000.0)(1, 0), 0.75F);
  msg::Image metres = image_message({}, Image<float>(2, 1, 1.5F));
  EXPECT_EQ(depth_of(metres, "test", 4000.0)(0, 0), 1.5F) << "has meters";
}

TEST(ImageMessages, ReadsDepthInMeters) {
  const float metres[4] = {0.0F, 1.25F, NAN, 3.5F};
  std::vector<std::uint8_t> bytes(sizeof metres);
  std::memcpy(bytes.data(), metres, sizeof metres);
  const Image<float> depth = depth_of(image_of("32FC1", bytes), "test");
  EXPECT_EQ(depth(1, 0), 1.25F);
  EXPECT_TRUE(std::isnan(depth(0, 1)));
  EXPECT_EQ(depth(1, 1), 3.5F);
}

TEST(ImageMessages, ReadsCompressedImages) {
  const Image<Rgb> image(16, 16, Rgb{200, 100, 50});
  EXPECT_EQ(color_of(msg::CompressedImage{{}, "png", encode_png(image)}, "test").pixels(),
            image.pixels());
  const Image<Rgb> jpeg = color_of(compressed_message({}, image, 95), "test");
  EXPECT_NEAR(jpeg(8, 8).r, 200, 3);
  EXPECT_NEAR(jpeg(8, 8).b, 50, 3);
}

TEST(ImageMessages, ReadsCompressedDepth) {
  Image<std::uint16_t> raw(3, 2, 1500);
  raw(0, 0) = 0;
  const msg::CompressedImage with_header = compressed_message({}, raw);
  EXPECT_EQ(with_header.data.size(), 12 + encode_png(raw).size());
  for (const auto& message :
       {with_header, msg::CompressedImage{{}, "16UC1; png", encode_png(raw)}}) {
    const Image<float> depth = depth_of(message, "test");
    EXPECT_EQ(depth(0, 0), 0.0F);
    EXPECT_EQ(depth(2, 1), 1.5F);
  }
}

TEST(ImageMessages, ReadsInverseCompressedDepthOf32Bits) {
  // Encoding of compressed_depth_image_transport, up to 10 m, with its quantization at 1 m.
  constexpr float kA = 1.0F * (1.0F + 1.0F);
  constexpr float kB = 1.0F - kA / 10.0F;
  Image<std::uint16_t> raw(2, 1);
  raw(1, 0) = static_cast<std::uint16_t>(kA / 0.5F + kB);
  msg::CompressedImage message{{}, "32FC1; compressedDepth png", std::vector<std::uint8_t>(12)};
  const float parameters[2] = {kA, kB};
  std::memcpy(message.data.data() + 4, parameters, sizeof parameters);
  const auto png = encode_png(raw);
  message.data.insert(message.data.end(), png.begin(), png.end());
  const Image<float> depth = depth_of(message, "test");
  EXPECT_EQ(depth(0, 0), 0.0F);
  EXPECT_FLOAT_EQ(depth(1, 0), kA / (static_cast<float>(raw(1, 0)) - kB));
}

/// Encoder of the paper's listing, for the decoder's test.
class RvlEncoder {
 public:
  std::vector<std::uint8_t> encode(const Image<std::uint16_t>& image) {
    put(static_cast<std::uint32_t>(image.width()));
    put(static_cast<std::uint32_t>(image.height()));
    const auto& pixels = image.pixels();
    std::int32_t previous = 0;
    for (std::size_t i = 0; i < pixels.size();) {
      std::size_t zeros = i;
      while (zeros < pixels.size() && pixels[zeros] == 0) ++zeros;
      std::size_t end = zeros;
      while (end < pixels.size() && pixels[end] != 0) ++end;
      number(static_cast<std::uint32_t>(zeros - i));
      number(static_cast<std::uint32_t>(end - zeros));
      for (i = zeros; i < end; ++i) {
        const std::int32_t delta = pixels[i] - previous;
        number(static_cast<std::uint32_t>(delta >= 0 ? 2 * delta : -2 * delta - 1));
        previous = pixels[i];
      }
    }
    while (groups_ != 0) group(0);
    return bytes_;
  }

 private:
  void put(std::uint32_t word) {
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&word);
    bytes_.insert(bytes_.end(), raw, raw + sizeof word);
  }
  void group(std::uint32_t bits) {
    word_ = word_ << 4U | bits;
    if (++groups_ < 8) return;
    put(word_);
    groups_ = 0;
  }
  void number(std::uint32_t value) {
    do {
      const std::uint32_t low = value & 7U;
      value >>= 3U;
      group(value != 0 ? low | 8U : low);
    } while (value != 0);
  }

  std::vector<std::uint8_t> bytes_;
  std::uint32_t word_ = 0;
  int groups_ = 0;
};

msg::CompressedImage rvl_message(const Image<std::uint16_t>& raw) {
  msg::CompressedImage message{{}, "16UC1; compressedDepth rvl", std::vector<std::uint8_t>(12)};
  const auto rvl = RvlEncoder().encode(raw);
  message.data.insert(message.data.end(), rvl.begin(), rvl.end());
  return message;
}

TEST(ImageMessages, ReadsRvlCompressedDepth) {
  Image<std::uint16_t> raw(37, 11);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    raw[i] = static_cast<std::uint16_t>(i % 7 < 3 ? 0 : (i * 7919) % 65536);
  }
  const Image<float> depth = depth_of(rvl_message(raw), "test");
  ASSERT_EQ(depth.width(), 37);
  for (std::size_t i = 0; i < raw.size(); ++i) ASSERT_EQ(depth[i], float(raw[i]) / 1000.0F);
}

TEST(ImageMessages, RejectsDamagedRvl) {
  const msg::CompressedImage whole = rvl_message(Image<std::uint16_t>(16, 4, 1500));
  for (std::size_t size = 0; size < whole.data.size(); ++size) {
    msg::CompressedImage cut = whole;
    cut.data.resize(size);
    EXPECT_THROW(depth_of(cut, "test"), DataError) << size;
  }
  msg::CompressedImage huge = whole;
  for (std::size_t at = 12; at < 20; ++at) huge.data[at] = 0xFF;
  expect_in("4294967295x4294967295 pixels, allowed",
            message_of<DataError>([&] { depth_of(huge, "test"); }));
  for (std::size_t at = 20; at < whole.data.size(); ++at) {
    msg::CompressedImage damaged = whole;
    damaged.data[at] = 0xFF;
    try {
      depth_of(damaged, "test");
    } catch (const DataError&) {  // or another image
    }
  }
}

TEST(ImageMessages, ErrorsExplainProblem) {
  const auto error = [](msg::Image message, bool depth = false) {
    return message_of<DataError>([&] {
      if (depth) {
        depth_of(message, "topic message 3");
      } else {
        color_of(message, "topic message 3");
      }
    });
  };
  msg::Image valid = image_of("rgb8", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  expect_in("topic message 3: has the encoding 'nv12', expected rgb8", error([&] {
              msg::Image m = valid;
              m.encoding = "nv12";
              return m;
            }()));
  expect_in("has the encoding 'rgb8', expected 16UC1", error(valid, true));
  msg::Image few = valid;
  few.data.pop_back();
  expect_in("has 11 bytes in rows of 6, but 2x2 pixels of rgb8 need 12", error(few));
  msg::Image narrow = valid;
  narrow.step = 5;
  expect_in("in rows of 5", error(narrow));
  msg::Image none = valid;
  none.width = 0;
  expect_in("is 0x2 pixels", error(none));
  msg::Image huge = valid;
  huge.width = huge.height = 0xFFFFFFFF;
  expect_in("allowed: 1x1 to 16384x16384", error(huge));
  const msg::CompressedImage jpeg{{}, "16UC1; jpeg", std::vector<std::uint8_t>(20)};
  expect_in("compressed depth is supported as PNG and RVL",
            message_of<DataError>([&] { depth_of(jpeg, "test"); }));
}

TEST(ImageMessages, RoundTrip) {
  const Image<Rgb> color(3, 2, Rgb{1, 2, 3});
  EXPECT_EQ(color_of(image_message({}, color), "test").pixels(), color.pixels());
  const Image<float> depth(3, 2, 1.25F);
  EXPECT_EQ(depth_of(image_message({}, depth), "test").pixels(), depth.pixels());
  const Image<std::uint8_t> mask(3, 2, 2);
  EXPECT_EQ(mask_of(image_message({}, mask), "test").pixels(), mask.pixels());
}

}  // namespace
}  // namespace mms
