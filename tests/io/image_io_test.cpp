#include "mms/io/image/image_io.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;
namespace fs = std::filesystem;

Image<Rgb> color_pattern() {
  Image<Rgb> image(37, 21);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) {
      image(x, y) = {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11), 200};
    }
  }
  return image;
}

template <class T>
Image<T> plain_pattern(int step) {
  Image<T> image(37, 21);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = static_cast<T>(i * static_cast<std::size_t>(step));
  }
  return image;
}

TEST(ImageIo, PngRoundTripsExactly) {
  const TempFolder folder;
  const auto path = folder.path() / "image.png";
  write_png(path, color_pattern());
  EXPECT_EQ(read_color(path).pixels(), color_pattern().pixels());
  write_png(path, plain_pattern<std::uint16_t>(83));
  EXPECT_EQ(read_depth16(path).pixels(), plain_pattern<std::uint16_t>(83).pixels());
  EXPECT_EQ(read_depth16(path).width(), 37);
  write_png(path, plain_pattern<std::uint8_t>(1));
  EXPECT_EQ(read_mask(path).pixels(), plain_pattern<std::uint8_t>(1).pixels());
}

TEST(ImageIo, JpegKeepsColors) {
  const TempFolder folder;
  const auto path = folder.path() / "image.jpg";
  write_file(path, encode_jpeg(Image<Rgb>(32, 16, Rgb{250, 120, 10}), 95));
  const Image<Rgb> read = read_color(path);
  ASSERT_EQ(read.width(), 32);
  EXPECT_NEAR(read(16, 8).r, 250, 3);
  EXPECT_NEAR(read(16, 8).g, 120, 3);
  EXPECT_NEAR(read(16, 8).b, 10, 3);
}

TEST(ImageIo, ReadsGreyImagesAsColor) {
  const TempFolder folder;
  const auto path = folder.path() / "grey.png";
  write_png(path, Image<std::uint8_t>(4, 3, 77));
  EXPECT_EQ(read_color(path)(3, 2), (Rgb{77, 77, 77}));
}

TEST(ImageIo, RejectsDepthAndMasksOfOtherType) {
  const TempFolder folder;
  const auto grey8 = folder.path() / "grey8.png";
  const auto grey16 = folder.path() / "grey16.png";
  const auto color = folder.path() / "color.png";
  write_png(grey8, Image<std::uint8_t>(4, 3));
  write_png(grey16, Image<std::uint16_t>(4, 3));
  write_png(color, Image<Rgb>(4, 3));
  expect_in(
      grey8.string() + ": has pixels of 8 bits and 1 channel(s), expected a 16-bit depth image",
      message_of<DataError>([&] { read_depth16(grey8); }));
  expect_in("8 bits and 3 channel(s)", message_of<DataError>([&] { read_depth16(color); }));
  expect_in("16 bits and 1 channel(s), expected an 8-bit label PNG",
            message_of<DataError>([&] { read_mask(grey16); }));
  message_of<DataError>([&] { read_mask(color); });
}

TEST(ImageIo, RejectsTruncatedImages) {
  const TempFolder folder;
  const std::pair<const char*, std::vector<std::uint8_t>> files[] = {
      {"a.png", encode_png(color_pattern())}, {"a.jpg", encode_jpeg(color_pattern())}};
  for (const auto& [name, whole] : files) {
    const std::string bytes(whole.begin(), whole.end());
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 13) {
      const auto path = folder.write(name, bytes.substr(0, size));
      EXPECT_THROW(read_color(path), DataError) << name << " of " << size << " bytes";
    }
    const auto half = folder.write(name, bytes.substr(0, bytes.size() / 2));
    expect_in("is a truncated", message_of<DataError>([&] { read_color(half); }));
  }
}

TEST(ImageIo, IgnoresBytesAfterImage) {
  const TempFolder folder;
  const auto jpeg = encode_jpeg(color_pattern());
  const std::string padded = std::string(jpeg.begin(), jpeg.end()) + std::string(100, '\0');
  EXPECT_EQ(read_color(folder.write("a.jpg", padded)).width(), 37);
  const auto png = encode_png(color_pattern());
  EXPECT_EQ(read_color(folder.write("a.png", std::string(png.begin(), png.end()) + "x")).width(),
            37);
}

TEST(ImageIo, RejectsDamagedImages) {
  const TempFolder folder;
  const auto png = encode_png(color_pattern());
  std::string flipped(png.begin(), png.end());
  flipped[flipped.size() / 2] = static_cast<char>(~flipped[flipped.size() / 2]);
  const auto damaged = folder.write("a.png", flipped);
  expect_in("damaged", message_of<DataError>([&] { read_color(damaged); }));

  std::string huge(png.begin(), png.end());
  huge[16] = 0x7f;
  const auto too_large = folder.write("b.png", huge);
  expect_in("allowed: up to 16384x16384", message_of<DataError>([&] { read_color(too_large); }));
}

/// libpng's own messages would be between those of the program.
TEST(ImageIo, DamagedPngPrintsNothing) {
  const TempFolder folder;
  const auto png = encode_png(color_pattern());
  ::testing::internal::CaptureStderr();
  for (std::size_t at = 8; at < png.size(); at += 7) {
    std::string damaged(png.begin(), png.end());
    damaged[at] = static_cast<char>(~damaged[at]);
    try {
      read_color(folder.write("a.png", damaged));
    } catch (const DataError&) {  // most of them
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

/// Pixels of all kinds of PNG are those that OpenCV decodes.
TEST(ImageIo, DecodesPngAsOpencv) {
  const TempFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}) {
    cv::Mat stored(7, 9, type);
    cv::randu(stored, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
    const fs::path file = folder.path() / "a.png";
    cv::imwrite(file.string(), stored);
    const cv::Mat expected = cv::imread(file.string(), cv::IMREAD_COLOR);
    const Image<Rgb> color = read_color(file);
    for (int y = 0; y < expected.rows; ++y) {
      for (int x = 0; x < expected.cols; ++x) {
        const auto& bgr = expected.at<cv::Vec3b>(y, x);
        ASSERT_EQ(color(x, y), (Rgb{bgr[2], bgr[1], bgr[0]})) << type << " at " << x << ", " << y;
      }
    }
    if (type != CV_16UC1) continue;
    EXPECT_EQ(read_depth16(file)(3, 2), stored.at<std::uint16_t>(2, 3));
  }
}

TEST(ImageIo, RejectsOtherFiles) {
  const TempFolder folder;
  const auto text = folder.write("a.png", "hello");
  const auto empty = folder.write("b.png", "");
  expect_in("no image that can be read", message_of<DataError>([&] { read_color(text); }));
  expect_in("is empty", message_of<DataError>([&] { read_color(empty); }));
  message_of<FileError>([&] { read_color(folder.path() / "missing.png"); });
  message_of<FileError>([&] { read_color(folder.path()); });
}

TEST(ImageIo, RejectsWritingEmptyImages) {
  message_of<DataError>([] { encode_png(Image<Rgb>()); });
  message_of<DataError>([] { encode_jpeg(Image<Rgb>()); });
}

}  // namespace
}  // namespace mms
