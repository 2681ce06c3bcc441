#include "tests/architecture/include_rules.hpp"

#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::vector<std::string> faults_of(const TempFolder& tree) {
  return include_faults(tree.path(), arrows());
}

TEST(Architecture, TheTreeKeepsItsArrows) {
  std::string all;
  for (const std::string& fault : include_faults(MMS_SOURCE_DIR, arrows())) all += fault + "\n";
  EXPECT_TRUE(all.empty()) << all;
}

TEST(Architecture, EveryModuleOfTheTreeHasArrowsAndTheOtherWayRound) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(MMS_SOURCE_DIR "/mms")) {
    found.insert(entry.path().filename().string());
  }
  for (const auto& [module, targets] : arrows()) {
    EXPECT_TRUE(found.contains(module)) << module << " is gone";
    for (const std::string& target : targets) EXPECT_TRUE(arrows().contains(target)) << target;
  }
}

TEST(Architecture, ThePaperModulesNeverIncludeEachOther) {
  const std::set<std::string> paper = {"segmentation", "fusion", "localization", "mapping"};
  for (const std::string& from : paper) {
    for (const std::string& to : paper) EXPECT_FALSE(arrows().at(from).contains(to));
  }
}

TEST(Architecture, AnIncludeFromFusionToMappingIsCaught) {
  const TempFolder tree;
  tree.write("mms/mapping/static_map.hpp", "#pragma once\n#include \"mms/core/frame.hpp\"\n");
  tree.write("mms/fusion/fusion.cpp",
             "#include \"mms/fusion/fusion.hpp\"\n\n#include \"mms/core/frame.hpp\"\n"
             "#include \"mms/mapping/static_map.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0],
            "mms/fusion/fusion.cpp:4: includes \"mms/mapping/static_map.hpp\": arrow fusion -> "
            "mapping is forbidden, allowed are: core, geometry");
}

TEST(Architecture, CoreKnowsNobody) {
  const TempFolder tree;
  tree.write("mms/core/frame.cpp", "#include \"mms/geometry/se3.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("arrow core -> geometry is forbidden, allowed are: none", faults[0]);
}

TEST(Architecture, DetoursAroundTheRootAreCaught) {
  const TempFolder tree;
  tree.write("mms/fusion/a.cpp", "#include \"../mapping/static_map.hpp\"\n");
  tree.write("mms/fusion/b.cpp", "#  include <mms/mapping/static_map.hpp>\n");
  tree.write("mms/fusion/c.cpp", "#include \"mms/fusion/../mapping/static_map.hpp\"\n");
  tree.write("mms/fusion/d.cpp", "#include \"fusion.hpp\"\n");
  tree.write("mms/fusion/e.cpp", "#include <vector>\n// #include \"mms/mapping/x.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 4U);
  expect_in("a.cpp:1: includes \"../mapping/static_map.hpp\", allowed is \"mms/", faults[0]);
  expect_in("b.cpp:1: includes <mms/mapping/static_map.hpp>, project headers", faults[1]);
  expect_in("c.cpp:1: includes \"mms/fusion/../mapping", faults[2]);
  expect_in("d.cpp:1: includes \"fusion.hpp\"", faults[3]);
}

TEST(Architecture, AHeaderWithoutGuardIsCaught) {
  const TempFolder tree;
  tree.write("mms/io/bare.hpp", "int x();\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("mms/io/bare.hpp:1: a header without #pragma once", faults[0]);
}

TEST(Architecture, AModuleWithoutArrowsIsCaught) {
  const TempFolder tree;
  tree.write("mms/helpers/help.hpp", "#pragma once\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("module 'helpers' has no arrows", faults[0]);
}

}  // namespace
}  // namespace mms
