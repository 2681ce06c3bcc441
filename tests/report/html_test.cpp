#include "mms/report/html.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace mms {
namespace {

std::string base64_of(std::string_view text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(Html, EscapesMarkup) {
  EXPECT_EQ(escape_html("<b a=\"x\" b='y'>&"), "&lt;b a=&quot;x&quot; b=&#39;y&#39;&gt;&amp;");
}

TEST(Html, KeepsUtf8AndReplacesInvalidBytes) {
  EXPECT_EQ(escape_html("L\xC3\xA4ufer \xE2\x82\xAC"), "L\xC3\xA4ufer \xE2\x82\xAC");
  EXPECT_EQ(escape_html("\xFFx\xC3"), "\xEF\xBF\xBDx\xEF\xBF\xBD");
  EXPECT_EQ(escape_html(std::string_view("a\0b\n", 4)),
            "a\xEF\xBF\xBD"
            "b\n");
}

TEST(Html, Base64EqualsRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xFF, 0xFE, 0xFD}), "//79");
}

}  // namespace
}  // namespace mms
