#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <variant>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

/// Width 5, height 4; every pixel differs.
cv::Mat pattern(int type) {
  cv::Mat image(4, 5, type);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (type == CV_32FC1) image.at<float>(y, x) = 0.25F + static_cast<float>(10 * y + x);
      if (type == CV_16UC1) {
        image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1000 * y + x);
      }
      if (type == CV_8UC3) {
        image.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(10 * x),
                                     static_cast<std::uint8_t>(20 * y), 200};
      }
    }
  }
  return image;
}

std::string encoded(const std::string& ending, const cv::Mat& image,
                    const std::vector<int>& options = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, image, bytes, options);
  return {bytes.begin(), bytes.end()};
}

void enable_exr() {
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
}

TEST(ImageFormats, ReadsColorOfEachFormat) {
  const TempFolder folder;
  for (const std::string ending : {".png", ".bmp", ".tif", ".webp"}) {
    const std::vector<int> lossless =
        ending == ".webp" ? std::vector<int>{cv::IMWRITE_WEBP_QUALITY, 101} : std::vector<int>{};
    const fs::path file = folder.write("a" + ending, encoded(ending, pattern(CV_8UC3), lossless));
    const Image<Rgb> image = read_color(file);
    ASSERT_EQ(image.width(), 5) << ending;
    ASSERT_EQ(image.height(), 4) << ending;
    EXPECT_EQ(image(3, 2), (Rgb{200, 40, 30})) << ending;
    EXPECT_TRUE(is_picture(file));
  }
  EXPECT_TRUE(is_picture("A.JPG"));
  EXPECT_FALSE(is_picture("a.txt"));
}

/// libjpeg skips bytes between segments, and would allocate what the size says.
TEST(ImageFormats, FindsTheSizeOfAJpegBehindOtherBytes) {
  std::string bytes = encoded(".jpg", pattern(CV_8UC3));
  const std::size_t frame = bytes.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  bytes.replace(frame + 5, 4, std::string("\x7D\x00\x7D\x00", 4));
  bytes.insert(frame, 1, '\0');
  const TempFolder folder;
  const auto file = folder.write("a.jpg", bytes);
  expect_in("32000", message_of<DataError>([&] { read_color(file); }));
}

TEST(ImageFormats, ReadsWholeNumbersOfDepth) {
  const TempFolder folder;
  for (const std::string ending : {".png", ".tif", ".pgm"}) {
    const fs::path file = folder.write("a" + ending, encoded(ending, pattern(CV_16UC1)));
    const StoredDepth depth = read_stored_depth(file);
    ASSERT_TRUE(std::holds_alternative<Image<std::uint16_t>>(depth)) << ending;
    EXPECT_EQ(std::get<Image<std::uint16_t>>(depth)(3, 2), 2003) << ending;
    EXPECT_EQ(read_depth16(file)(3, 2), 2003) << ending;
  }
}

TEST(ImageFormats, ReadsPgmWithComments) {
  const TempFolder folder;
  const std::string pixels("\x03\xE8\x07\xD0", 4);  // high bytes first
  const fs::path file = folder.write("a.pgm", "P5\n# by a tool\n2 1 # width\n65535\n" + pixels);
  EXPECT_EQ(read_depth16(file)(1, 0), 2000);
  expect_in("is 99999x1 pixels, allowed: up to 16384x16384", message_of<DataError>([&] {
              read_depth16(folder.write("b.pgm", "P5 99999 1 65535\n" + pixels));
            }));
}

TEST(ImageFormats, ReadsFloatingPointDepth) {
  enable_exr();
  const TempFolder folder;
  for (const std::string ending : {".tif", ".exr", ".pfm"}) {
    const fs::path file = folder.write("a" + ending, encoded(ending, pattern(CV_32FC1)));
    const StoredDepth depth = read_stored_depth(file);
    ASSERT_TRUE(std::holds_alternative<Image<float>>(depth)) << ending;
    EXPECT_EQ(std::get<Image<float>>(depth)(3, 2), 23.25F) << ending;
    EXPECT_EQ(std::get<Image<float>>(depth).width(), 5) << ending;
  }
}

TEST(ImageFormats, RejectsOtherDepth) {
  const TempFolder folder;
  const fs::path color = folder.write("a.tif", encoded(".tif", pattern(CV_8UC3)));
  expect_in(
      "8 bits and 3 channel(s), expected a 16-bit depth image of 1 channel, or 32-bit numbers",
      message_of<DataError>([&] { read_stored_depth(color); }));
  const fs::path numbers = folder.write("b.tif", encoded(".tif", pattern(CV_32FC1)));
  expect_in("32 bits and 1 channel(s), expected a 16-bit depth image",
            message_of<DataError>([&] { read_depth16(numbers); }));
}

TEST(ImageFormats, RejectsTruncatedFiles) {
  enable_exr();
  const TempFolder folder;
  const std::pair<std::string, int> files[] = {{".bmp", CV_8UC3},  {".webp", CV_8UC3},
                                               {".tif", CV_16UC1}, {".pgm", CV_16UC1},
                                               {".pfm", CV_32FC1}, {".exr", CV_32FC1}};
  for (const auto& [ending, type] : files) {
    const std::string whole = encoded(ending, pattern(type));
    for (std::size_t size = 0; size < whole.size() / 2; size += 3) {
      const fs::path file = folder.write("a" + ending, whole.substr(0, size));
      EXPECT_THROW(type == CV_8UC3 ? void(read_color(file)) : void(read_stored_depth(file)),
                   DataError)
          << ending << " of " << size << " bytes";
    }
  }
}

/// The file with `bytes` at `at`.
std::string changed(std::string file, std::size_t at, const std::string& bytes) {
  return file.replace(at, bytes.size(), bytes);
}

TEST(ImageFormats, RejectsHugeSizesBeforeDecoding) {
  const TempFolder folder;
  const std::string bmp = encoded(".bmp", pattern(CV_8UC3));
  expect_in("is 65535x4 pixels, allowed: up to 16384x16384", message_of<DataError>([&] {
              read_color(folder.write("a.bmp", changed(bmp, 18, {"\xFF\xFF\0\0", 4})));
            }));
  const std::string jpeg = encoded(".jpg", pattern(CV_8UC3));
  const std::size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  expect_in("is 5x65535 pixels", message_of<DataError>([&] {
              read_color(folder.write("a.jpg", changed(jpeg, frame + 5, "\xFF\xFF")));
            }));
  enable_exr();
  const std::string exr = encoded(".exr", pattern(CV_32FC1));
  const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t right = exr.find(window) + window.size() + 8;
  ASSERT_NE(exr.find(window), std::string::npos);
  expect_in("is 65536x4 pixels, allowed: up to 16384x16384", message_of<DataError>([&] {
              read_stored_depth(folder.write("a.exr", changed(exr, right, {"\xFF\xFF\0\0", 4})));
            }));
  // OpenEXR would allocate the size of an attribute.
  expect_in(
      "is a truncated EXR", message_of<DataError>([&] {
        read_stored_depth(folder.write("a.exr", changed(exr, right - 12, {"\xFF\xFF\xFF\x7F", 4})));
      }));
}

TEST(ImageFormats, RejectsTooManyPixelsBeforeDecoding) {
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& bytes) {
    return message_of<DataError>([&] { read_color(folder.write(name, bytes)); });
  };
  const std::string side("\0\0\x40\0", 4);  // 16384
  std::string png = changed(encoded(".png", pattern(CV_16UC3)), 16, side + side);
  expect_in("is 16384x16384 pixels of up to 8 bytes, allowed: up to 67108864 pixels and 512 MiB",
            error("a.png", png));
  const std::string jpeg = encoded(".jpg", pattern(CV_8UC3));
  const std::size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  expect_in("is 16384x16384 pixels", error("a.jpg", changed(jpeg, frame + 5, {"\x40\0\x40\0", 4})));
  const std::string webp = encoded(".webp", pattern(CV_8UC3), {cv::IMWRITE_WEBP_QUALITY, 90});
  ASSERT_EQ(webp.substr(12, 4), "VP8 ");
  expect_in("is 16383x16383 pixels", error("a.webp", changed(webp, 26, {"\xFF\x3F\xFF\x3F", 4})));
  const std::string lossless = encoded(".webp", pattern(CV_8UC3), {cv::IMWRITE_WEBP_QUALITY, 101});
  ASSERT_EQ(lossless.substr(12, 4), "VP8L");
  expect_in("is 16384x16384 pixels",
            error("b.webp", changed(lossless, 21, {"\xFF\xFF\xFF\x0F", 4})));
}

TEST(ImageFormats, RejectsTooMuchMemoryBeforeDecoding) {
  const TempFolder folder;
  std::string exr(8, '\0');
  exr.replace(0, 4, "\x76\x2F\x31\x01");
  exr += std::string("dataWindow\0box2i\0\x10\0\0\0", 21) + std::string(8, '\0') +
         std::string("\xFF\x1F\0\0\xFF\x1F\0\0\0", 9);
  expect_in("is 8192x8192 pixels of up to 16 bytes, allowed: up to 67108864 pixels and 512 MiB",
            message_of<DataError>([&] { read_stored_depth(folder.write("a.exr", exr)); }));
}

}  // namespace
}  // namespace mms
