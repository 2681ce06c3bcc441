#include "mms/io/stb/stb_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

/// Smooth gradients, as in photographs.
Image<Rgb> gradient_image() {
  Image<Rgb> image(61, 43);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image(x, y) = {static_cast<std::uint8_t>(x * 4), static_cast<std::uint8_t>(y * 5),
                     static_cast<std::uint8_t>(x + y)};
    }
  }
  return image;
}

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(StbPicture, PngIsExact) {
  const std::vector<std::uint8_t> file = encode_png(gradient_image());
  EXPECT_EQ(decode_with_stb(text_of(file), "a.png").pixels(), gradient_image().pixels());
}

TEST(StbPicture, ReadsGreyImagesAsColor) {
  const std::vector<std::uint8_t> file = encode_png(Image<std::uint8_t>(5, 4, 130));
  const Image<Rgb> read = decode_with_stb(text_of(file), "a.png");
  EXPECT_EQ(read.height(), 4);
  EXPECT_EQ(read(4, 3), (Rgb{130, 130, 130}));
}

TEST(StbPicture, JpegEqualsOpenCvUpToRounding) {
  const std::vector<std::uint8_t> file = encode_jpeg(gradient_image(), 95);
  const Image<Rgb> expected = decode_color(file, "a.jpg");
  const Image<Rgb> read = decode_with_stb(text_of(file), "a.jpg");
  ASSERT_EQ(read.size(), expected.size());
  int max_difference = 0;
  for (std::size_t i = 0; i < read.size(); ++i) {
    max_difference =
        std::max({max_difference, std::abs(read[i].r - expected[i].r),
                  std::abs(read[i].g - expected[i].g), std::abs(read[i].b - expected[i].b)});
  }
  EXPECT_LE(max_difference, 4);
}

TEST(StbPicture, RejectsDamagedFiles) {
  const std::vector<std::uint8_t> file = encode_png(gradient_image());
  const std::string_view text = text_of(file);
  for (const std::string_view bytes :
       {text.substr(0, text.size() / 2), std::string_view("GIF89a")}) {
    expect_in("a.png", message_of<DataError>([&] { decode_with_stb(bytes, "a.png"); }));
  }
  std::string garbage(text);  // complete, but with invalid pixel data
  std::fill(garbage.begin() + 45, garbage.begin() + 60, 'x');
  EXPECT_THROW(decode_with_stb(garbage, "a.png"), DataError);
}

}  // namespace
}  // namespace mms
