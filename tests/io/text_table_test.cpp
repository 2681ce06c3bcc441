#include "mms/io/text/text_table.hpp"

#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

TEST(TextTable, SplitsLinesAndKeepsLineNumbers) {
  const testing::TempFolder folder;
  const auto path = folder.write("t.txt", "\xEF\xBB\xBF# head\r\n\r\n1 a\tb\r\n  # more\n2,c , d");
  const TextTable table(path);
  ASSERT_EQ(table.lines().size(), 2U);
  using Fields = std::vector<std::string_view>;
  EXPECT_EQ(table.lines()[0].fields, (Fields{"1", "a", "b"}));
  EXPECT_EQ(table.lines()[1].fields, (Fields{"2", "c", "d"}));
  EXPECT_EQ(table.where(table.lines()[1]), path.string() + ":5");
}

TEST(TextTable, EmptyFilesHaveNoLines) {
  const testing::TempFolder folder;
  EXPECT_TRUE(TextTable(folder.write("t.txt", "")).lines().empty());
}

}  // namespace
}  // namespace mms
