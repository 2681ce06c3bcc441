#include "mms/io/text/text_table.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
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

TEST(TextTable, HasHeaderOfFirstLine) {
  const testing::TempFolder folder;
  using Fields = std::vector<std::string_view>;
  const TextTable table(folder.write("a.csv", "#stamp, x\n# more\n1,2\n"));
  EXPECT_EQ(table.header(), (Fields{"stamp", "x"}));
  EXPECT_TRUE(TextTable(folder.write("b.csv", "1,2\n# stamp\n")).header().empty());
}

TEST(TextTable, RefusesOtherFiles) {
  const testing::TempFolder folder;
  std::string columns;
  for (int i = 0; i < 1001; ++i) columns += "1 ";
  const auto file = folder.write("t.txt", "1 2\n" + columns);
  testing::expect_in("t.txt:2: a text file has up to 1000 columns",
                     testing::message_of<DataError>([&] { TextTable table(file); }));
}

TEST(TextTable, EmptyFilesHaveNoLines) {
  const testing::TempFolder folder;
  EXPECT_TRUE(TextTable(folder.write("t.txt", "")).lines().empty());
}

}  // namespace
}  // namespace mms
