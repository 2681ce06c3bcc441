#include "mms/io/text/lower_case.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(LowerCase, KeepsDigitsAndOtherBytes) {
  EXPECT_EQ(lower_case("IMG_1.JPG"), "img_1.jpg");
  EXPECT_EQ(lower_case("\xC3\x84"), "\xC3\x84");
  EXPECT_EQ(lower_case(""), "");
}

}  // namespace
}  // namespace mms
