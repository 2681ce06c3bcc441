#include "mms/report/plain_table.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

const PlainTable kTable{
    "Drift", {"method", "cm"}, {{"none", "12.8"}, {"a < b", "0.9"}}, "smaller is better"};

TEST(PlainTable, TextHasAlignedColumns) {
  EXPECT_EQ(text_of(kTable),
            "Drift\n"
            "method    cm\n"
            "none    12.8\n"
            "a < b    0.9\n"
            "smaller is better\n");
}

TEST(PlainTable, EscapesHtml) {
  const std::string html = html_of(kTable);
  EXPECT_NE(html.find("<td>a &lt; b</td><td>0.9</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("<th>method</th><th>cm</th>"), std::string::npos);
  EXPECT_NE(html.find("<p class=\"note\">smaller is better</p>"), std::string::npos);
}

}  // namespace
}  // namespace mms
