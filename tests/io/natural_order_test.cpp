#include "mms/io/text/natural_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mms/io/text/lower_case.hpp"

namespace mms {
namespace {

TEST(NaturalOrder, ComparesNumbersByValue) {
  EXPECT_TRUE(natural_less("a2", "a10"));
  EXPECT_FALSE(natural_less("a10", "a2"));
  EXPECT_TRUE(natural_less("frame-000009.png", "frame-000010.png"));
  EXPECT_TRUE(natural_less("1_left", "1_right"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("99999999999999999999", "100000000000000000000"));
  EXPECT_FALSE(natural_less("a1", "a1"));
}

TEST(NaturalOrder, OrdersAllNamesInOneWay) {
  std::vector<std::string> names = {"a01", "a1", "a001", "a", "1", "01", "a1b2", "a1b10", ""};
  std::sort(names.begin(), names.end(), natural_less);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < names.size(); ++j) {
      EXPECT_EQ(natural_less(names[i], names[j]), i < j) << names[i] << " and " << names[j];
    }
  }
}

TEST(LowerCase, KeepsDigitsAndOtherBytes) {
  EXPECT_EQ(lower_case("IMG_1.JPG"), "img_1.jpg");
  EXPECT_EQ(lower_case("\xC3\x84"), "\xC3\x84");
  EXPECT_EQ(lower_case(""), "");
}

}  // namespace
}  // namespace mms
